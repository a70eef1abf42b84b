#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "azulejo/core/export.h"

namespace azulejo {

/// Bytes aligned to 64, from a bounded recycling pool: fresh page faults cost more than most filters.
/// Contents are undefined at first. Blocks of 4 MiB and more are advised to use large pages.
class AZULEJO_EXPORT Buffer {
 public:
  Buffer() = default;
  /// Throws Error(Resource) where the machine has no memory left.
  explicit Buffer(std::size_t bytes);
  /// A buffer backed by an unlinked temporary file in `folder`: the kernel can write its pages back.
  /// Throws Error(Io) where the file can't be made that large.
  static Buffer in_temporary_file(std::size_t bytes, const std::string& folder);

  Buffer(Buffer&& other) noexcept { swap(other); }
  Buffer& operator=(Buffer&& other) noexcept {
    Buffer(std::move(other)).swap(*this);
    return *this;
  }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;
  ~Buffer();

  std::byte* data() const { return data_; }
  std::size_t size() const { return size_; }
  void swap(Buffer& other) noexcept;

 private:
  std::byte* data_ = nullptr;
  std::size_t size_ = 0;
  bool mapped_ = false;  ///< a temporary file's mapping, not the pool's
};

/// For allocators: bytes from the pool as Buffer takes them, and back with the same number of bytes.
AZULEJO_EXPORT std::byte* pool_allocate(std::size_t bytes);
AZULEJO_EXPORT void pool_free(std::byte* data, std::size_t bytes) noexcept;

/// Gives the bytes that the pool holds for reuse back to the system.
AZULEJO_EXPORT void release_pool();

}  // namespace azulejo
