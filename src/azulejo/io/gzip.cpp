#include "azulejo/io/gzip.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/data/array.h"
#include "azulejo/io/load_number.h"

namespace azulejo {
namespace {

constexpr std::size_t kPacked = std::size_t{1} << 16;
constexpr std::size_t kFirst = std::size_t{1} << 18;

class UnpackedInput final : public Input {
 public:
  UnpackedInput(std::string name, Array<std::byte> bytes) : Input(std::move(name)), bytes_(std::move(bytes)) {}
  std::uint64_t size() const override { return bytes_.size(); }
  std::size_t read(std::uint64_t offset, std::span<std::byte> bytes) const override {
    if (offset >= bytes_.size()) return 0;
    const std::size_t count = std::min(bytes.size(), bytes_.size() - static_cast<std::size_t>(offset));
    if (count > 0) std::memcpy(bytes.data(), bytes_.data() + offset, count);
    return count;
  }

 private:
  Array<std::byte> bytes_;
};

/// zlib's state, fed from an Input.
class Inflater {
 public:
  explicit Inflater(const Input& input) : input_(input) {
    constexpr int kGzipWindow = 15 + 16;  // the largest window, in gzip's wrapping
    if (inflateInit2(&stream_, kGzipWindow) != Z_OK) throw Error(Error::Resource, input.name() + ": out of memory");
  }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() { inflateEnd(&stream_); }

  /// Fills `bytes`; returns how many there were until the end of the last part.
  std::size_t read(std::span<std::byte> bytes) {
    std::size_t done = 0;
    while (done < bytes.size() && !finished_) {
      if (stream_.avail_in == 0) refill();
      const std::size_t step = std::min<std::size_t>(bytes.size() - done, std::size_t{1} << 30);
      stream_.next_out = reinterpret_cast<Bytef*>(bytes.data() + done);
      stream_.avail_out = static_cast<uInt>(step);
      const int status = inflate(&stream_, Z_NO_FLUSH);
      done += step - stream_.avail_out;
      if (status == Z_STREAM_END) {
        next_part();
      } else if (status != Z_OK && status != Z_BUF_ERROR) {
        throw error(stream_.msg != nullptr ? stream_.msg : "can't be unpacked");
      }
    }
    return done;
  }

 private:
  Error error(const std::string& why) const {
    return Error(Error::Data, fmt::format("{}: byte {}: damaged gzip: {}", input_.name(), position(), why));
  }
  std::uint64_t position() const { return next_ - stream_.avail_in; }

  void refill() {
    const std::size_t count = input_.read(next_, packed_);
    if (count == 0) throw error("the file ends too early");
    next_ += count;
    stream_.next_in = reinterpret_cast<Bytef*>(packed_.data());
    stream_.avail_in = static_cast<uInt>(count);
  }

  /// A part has ended: another begins with the same signature; anything else is padding.
  void next_part() {
    std::array<std::byte, 2> head = {};
    const std::uint64_t at = position();
    finished_ = input_.read(at, head) < 2 || head[0] != std::byte{0x1F} || head[1] != std::byte{0x8B};
    if (!finished_ && inflateReset(&stream_) != Z_OK) throw error("can't be unpacked");
  }

  const Input& input_;
  z_stream stream_ = {};
  std::array<std::byte, kPacked> packed_;
  std::uint64_t next_ = 0;  ///< byte that is read next from the file
  bool finished_ = false;
};

/// How many bytes the last part says it holds: a first guess for all of them, which the file may well belie.
std::size_t guessed_size(const Input& input) {
  std::array<std::byte, 4> length = {};
  if (input.size() < length.size() || input.read(input.size() - length.size(), length) < length.size()) return kFirst;
  const std::uint64_t said = load_number<std::uint32_t>(length.data(), std::endian::little);
  constexpr std::uint64_t kBestRatio = 1032;
  return static_cast<std::size_t>(std::clamp<std::uint64_t>(said + 1, kFirst, input.size() * kBestRatio + kFirst));
}

}  // namespace

bool is_gzip(const Input& input) {
  std::array<std::byte, 2> head = {};
  return input.read(0, head) == 2 && head[0] == std::byte{0x1F} && head[1] == std::byte{0x8B};
}

std::shared_ptr<const Input> unpack_gzip(const Input& input, std::int64_t limit) {
  Inflater inflater(input);
  Array<std::byte> bytes;
  std::size_t filled = 0;
  const std::size_t most = static_cast<std::size_t>(std::max<std::int64_t>(limit, 0));
  for (std::size_t size = guessed_size(input);; size *= 2) {
    // One byte above the limit tells a file that just fits from one that doesn't.
    bytes.resize(std::min(size, most + 1));
    filled += inflater.read(std::span(bytes).subspan(filled));
    if (filled > most) {
      throw Error(Error::Resource,
                  fmt::format("{}: more than {} bytes when unpacked, the limit of memory", input.name(), limit));
    }
    if (filled < bytes.size()) break;
  }
  bytes.resize(filled);
  return std::make_shared<UnpackedInput>(input.name(), std::move(bytes));
}

std::vector<std::byte> unpack_gzip_head(const Input& input, std::size_t count) {
  std::vector<std::byte> bytes(count);
  try {
    bytes.resize(Inflater(input).read(bytes));
  } catch (const Error& error) {
    if (error.kind() != Error::Data) throw;
    bytes.clear();
  }
  return bytes;
}

}  // namespace azulejo
