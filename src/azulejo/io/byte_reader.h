#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "azulejo/core/error.h"
#include "azulejo/io/input.h"

namespace azulejo {

/// Reads an Input from front to back through a buffer, for formats that are parsed byte by byte.
/// Numbers are little-endian. Past the end: Error(Data) naming the file and the place.
class ByteReader {
 public:
  explicit ByteReader(std::shared_ptr<const Input> input, std::uint64_t position = 0);

  std::uint8_t byte() {
    if (next_ == filled_) refill();
    return static_cast<std::uint8_t>(buffer_[next_++]);
  }
  std::uint16_t le16();
  std::uint32_t le32();
  /// Fills all of `bytes`.
  void read(std::span<std::byte> bytes);
  void read(std::span<std::uint8_t> bytes) { read(std::as_writable_bytes(bytes)); }
  void skip(std::uint64_t count) { seek(position() + count); }

  std::uint64_t position() const { return start_ + next_; }
  void seek(std::uint64_t position);
  std::uint64_t size() const { return size_; }
  bool at_end() const { return position() >= size_; }
  const std::string& name() const { return input_->name(); }
  /// An error at the byte that would be read next.
  Error error(Error::Kind kind, const std::string& what) const;

 private:
  void refill();

  std::shared_ptr<const Input> input_;
  std::uint64_t size_ = 0;
  std::uint64_t start_ = 0;  ///< of the buffer, in the file
  std::size_t next_ = 0;     ///< in the buffer
  std::size_t filled_ = 0;
  std::vector<std::byte> buffer_;
};

}  // namespace azulejo
