#pragma once

#include <cstddef>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/data/pool.h"

namespace azulejo {

/// Memory for the duration of one tile, handed out by moving a pointer. One thread's own.
class AZULEJO_EXPORT Scratch {
 public:
  /// `count` values of T, aligned to 64 bytes, with at least 128 readable and writable bytes before and behind:
  /// kernels may read and write whole vectors across the ends. Contents are undefined.
  template <class T>
  T* take(std::size_t count) {
    return reinterpret_cast<T*>(take_bytes(count * sizeof(T)));
  }
  /// Everything taken since is free again (the memory is kept).
  struct Mark {
    std::size_t block;
    std::size_t used;
  };
  Mark mark() const { return {block_, used_}; }
  void release(const Mark& mark) {
    block_ = mark.block;
    used_ = mark.used;
  }

 private:
  std::byte* take_bytes(std::size_t bytes);

  std::vector<Buffer> blocks_;
  std::size_t block_ = 0;  ///< index of the block in use
  std::size_t used_ = 0;   ///< bytes of it handed out
};

}  // namespace azulejo
