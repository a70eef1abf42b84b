#include "azulejo/io/input.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fmt/format.h>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

constexpr std::size_t kBuffer = std::size_t{1} << 18;

Error system_error(const std::string& name, const char* what) {
  return Error(Error::Io, fmt::format("{}: {}: {}", name, what, std::strerror(errno)));
}

std::string folder_of(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  return folder.empty() ? "." : folder.string();
}

/// A file descriptor that is closed at the end.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  ~Descriptor() {
    if (number_ > STDERR_FILENO) close(number_);
  }
  int number() const { return number_; }

 private:
  int number_;
};

class FileInput final : public Input {
 public:
  FileInput(std::string name, Descriptor file, std::uint64_t size)
      : Input(name, folder_of(name)), file_(std::move(file)), size_(size) {}

  std::uint64_t size() const override { return size_; }

  std::size_t read(std::uint64_t offset, std::span<std::byte> bytes) const override {
    std::size_t done = 0;
    while (done < bytes.size() && offset + done < size_) {
      const ssize_t count =
          pread(file_.number(), bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) throw system_error(name(), "can't read");
      if (count == 0) break;
      done += static_cast<std::size_t>(count);
    }
    return done;
  }

 private:
  Descriptor file_;
  std::uint64_t size_;
};

class MemoryInput final : public Input {
 public:
  MemoryInput(std::string name, std::span<const std::byte> bytes) : Input(std::move(name)), bytes_(bytes) {}
  MemoryInput(std::string name, std::string folder, std::vector<std::byte> owned)
      : Input(std::move(name), std::move(folder)), owned_(std::move(owned)), bytes_(owned_) {}

  std::uint64_t size() const override { return bytes_.size(); }

  std::size_t read(std::uint64_t offset, std::span<std::byte> bytes) const override {
    if (offset >= bytes_.size()) return 0;
    const std::size_t count = std::min(bytes.size(), bytes_.size() - static_cast<std::size_t>(offset));
    if (count > 0) std::memcpy(bytes.data(), bytes_.data() + offset, count);
    return count;
  }

 private:
  std::vector<std::byte> owned_;
  std::span<const std::byte> bytes_;
};

/// What can't be read twice is kept.
std::vector<std::byte> read_to_end(int file, const std::string& name, std::int64_t limit) {
  std::vector<std::byte> bytes;
  std::size_t filled = 0;
  for (;;) {
    if (filled == bytes.size()) bytes.resize(std::max(kBuffer, filled * 2));
    const ssize_t count = ::read(file, bytes.data() + filled, bytes.size() - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw system_error(name, "can't read");
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
    if (filled > static_cast<std::uint64_t>(limit)) {
      throw Error(Error::Resource, fmt::format("{}: more than {} bytes to hold, the limit of memory", name, limit));
    }
  }
  bytes.resize(filled);
  return bytes;
}

}  // namespace

std::vector<std::byte> Input::read_all(std::int64_t limit) const {
  if (size() > static_cast<std::uint64_t>(limit)) {
    throw Error(Error::Resource, fmt::format("{}: {} bytes to hold, the limit of memory is {}", name(), size(), limit));
  }
  std::vector<std::byte> bytes(static_cast<std::size_t>(size()));
  bytes.resize(read(0, bytes));
  return bytes;
}

std::shared_ptr<const Input> open_input(const std::string& path, std::int64_t memory_limit) {
  const bool standard = path == "-";
  const std::string name = standard ? "standard input" : path;
  Descriptor file(standard ? STDIN_FILENO : open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.number() < 0) throw system_error(name, "can't open");
  struct stat status = {};
  if (fstat(file.number(), &status) != 0) throw system_error(name, "can't open");
  if (S_ISDIR(status.st_mode)) throw Error(Error::Io, fmt::format("{}: can't open: it is a folder", name));
  if (S_ISREG(status.st_mode) && !standard) {
    return std::make_shared<FileInput>(name, std::move(file), static_cast<std::uint64_t>(status.st_size));
  }
  return std::make_shared<MemoryInput>(name, standard ? "" : folder_of(path),
                                       read_to_end(file.number(), name, memory_limit));
}

std::shared_ptr<const Input> memory_input(std::span<const std::byte> bytes, std::string name) {
  return std::make_shared<MemoryInput>(std::move(name), bytes);
}

}  // namespace azulejo
