#include "azulejo/data/pool.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <vector>

#include <fmt/format.h>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

constexpr std::size_t kAlignment = 64;
constexpr std::size_t kLargePage = std::size_t{2} << 20;
constexpr std::size_t kLarge = std::size_t{4} << 20;
constexpr std::size_t kPoolBytes = std::size_t{256} << 20;

/// Sizes are rounded up so that blocks fit again: to an eighth of their power of two.
std::size_t rounded(std::size_t bytes) {
  if (bytes <= 4096) return (bytes + kAlignment - 1) / kAlignment * kAlignment;
  const std::size_t step = std::bit_floor(bytes) / 8;
  return (bytes + step - 1) / step * step;
}

/// Blocks that were given back, by size; the least recently used go first when the pool is full.
class Pool {
 public:
  std::byte* take(std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    for (std::size_t i = free_.size(); i-- > 0;) {
      if (free_[i].size != bytes) continue;
      std::byte* block = free_[i].data;
      free_.erase(free_.begin() + static_cast<std::ptrdiff_t>(i));
      held_ -= bytes;
      return block;
    }
    return nullptr;
  }

  void give(std::byte* data, std::size_t bytes) noexcept {
    const std::lock_guard lock(mutex_);
    if (bytes > kPoolBytes / 2) return std::free(data);
    while (!free_.empty() && (held_ + bytes > kPoolBytes || free_.size() >= kBlocks)) drop_oldest();
    free_.push_back({data, bytes});  // never reallocates: see the constructor
    held_ += bytes;
  }

  void clear() noexcept {
    const std::lock_guard lock(mutex_);
    while (!free_.empty()) drop_oldest();
  }

  Pool() { free_.reserve(kBlocks); }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;
  ~Pool() { clear(); }

 private:
  struct Block {
    std::byte* data;
    std::size_t size;
  };
  static constexpr std::size_t kBlocks = 64;

  void drop_oldest() noexcept {
    std::free(free_.front().data);
    held_ -= free_.front().size;
    free_.erase(free_.begin());
  }

  std::mutex mutex_;
  std::vector<Block> free_;
  std::size_t held_ = 0;
};

Pool& pool() {
  static Pool* const instance = new Pool;  // outlives every static Image
  return *instance;
}

}  // namespace

std::byte* pool_allocate(std::size_t bytes) {
  const std::size_t size = rounded(bytes);
  std::byte* const reused = pool().take(size);
  if (reused != nullptr) return reused;
  const std::size_t alignment = size >= kLarge ? kLargePage : kAlignment;
  void* block = nullptr;
  if (size < bytes || posix_memalign(&block, alignment, size) != 0) {
    throw Error(Error::Resource, fmt::format("out of memory: {} bytes wanted", bytes));
  }
  if (size >= kLarge) madvise(block, size, MADV_HUGEPAGE);
  return static_cast<std::byte*>(block);
}

void pool_free(std::byte* data, std::size_t bytes) noexcept { pool().give(data, rounded(bytes)); }

Buffer::Buffer(std::size_t bytes) {
  if (bytes == 0) return;
  data_ = pool_allocate(bytes);
  size_ = rounded(bytes);
}

Buffer Buffer::in_temporary_file(std::size_t bytes, const std::string& folder) {
  std::string place = folder;
  if (place.empty()) {
    const char* const variable = std::getenv("TMPDIR");
    place = variable != nullptr && *variable != '\0' ? variable : "/tmp";
  }
  Buffer buffer;
  if (bytes == 0) return buffer;
  const auto fail = [&](const char* what) {
    return Error(Error::Io,
                 fmt::format("{}: {} {} bytes of temporary file: {}", place, what, bytes, std::strerror(errno)));
  };
  std::string name = place + "/azulejo-XXXXXX";
  const int file = mkostemp(name.data(), O_CLOEXEC);
  if (file < 0) throw fail("can't make");
  unlink(name.c_str());
  // Reserved now: a full disk is an error here and not a signal while pixels are written.
  const int refused = posix_fallocate(file, 0, static_cast<off_t>(bytes));
  void* const map = refused == 0 ? mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0) : MAP_FAILED;
  if (refused != 0) errno = refused;
  const Error failure = fail("can't reserve");
  close(file);
  if (map == MAP_FAILED) throw failure;
  buffer.data_ = static_cast<std::byte*>(map);
  buffer.size_ = bytes;
  buffer.mapped_ = true;
  return buffer;
}

Buffer::~Buffer() {
  if (data_ == nullptr) return;
  if (mapped_) {
    munmap(data_, size_);
  } else {
    pool().give(data_, size_);
  }
}

void Buffer::swap(Buffer& other) noexcept {
  std::swap(data_, other.data_);
  std::swap(size_, other.size_);
  std::swap(mapped_, other.mapped_);
}

void release_pool() { pool().clear(); }

}  // namespace azulejo
