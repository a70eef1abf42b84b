#include "azulejo/io/byte_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace azulejo {
namespace {
constexpr std::size_t kBufferBytes = std::size_t{1} << 16;
}

ByteReader::ByteReader(std::shared_ptr<const Input> input, std::uint64_t position)
    : input_(std::move(input)),
      size_(input_->size()),
      start_(position),
      buffer_(static_cast<std::size_t>(std::min<std::uint64_t>(kBufferBytes, std::max<std::uint64_t>(size_, 1)))) {}

Error ByteReader::error(Error::Kind kind, const std::string& what) const {
  return Error(kind, fmt::format("{}: byte {}: {}", name(), position(), what));
}

void ByteReader::refill() {
  start_ += next_;
  next_ = filled_ = 0;
  filled_ = start_ < size_ ? input_->read(start_, buffer_) : 0;
  if (filled_ == 0) throw error(Error::Data, "the file ends too early");
}

std::uint16_t ByteReader::le16() {
  const unsigned low = byte();
  return static_cast<std::uint16_t>(low | unsigned{byte()} << 8);
}

std::uint32_t ByteReader::le32() {
  const std::uint32_t low = le16();
  return low | std::uint32_t{le16()} << 16;
}

void ByteReader::read(std::span<std::byte> bytes) {
  while (!bytes.empty()) {
    if (next_ == filled_) refill();
    const std::size_t count = std::min(bytes.size(), filled_ - next_);
    std::memcpy(bytes.data(), buffer_.data() + next_, count);
    next_ += count;
    bytes = bytes.subspan(count);
  }
}

void ByteReader::seek(std::uint64_t position) {
  if (position >= start_ && position <= start_ + filled_) {
    next_ = static_cast<std::size_t>(position - start_);
    return;
  }
  // Who goes back goes back again: rows from the bottom up.
  const std::uint64_t before = position < start_ ? std::min<std::uint64_t>(position, buffer_.size() / 2) : 0;
  start_ = position - before;
  next_ = filled_ = 0;
  if (before > 0 && start_ < size_) {
    refill();
    next_ = std::min(static_cast<std::size_t>(before), filled_);
  }
}

}  // namespace azulejo
