#pragma once

#include <cstddef>
#include <limits>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#include "azulejo/data/pool.h"

namespace azulejo {

/// Aligned to 64 bytes. Gives large arrays memory from the recycling pool, and leaves new elements of trivial types undefined: filling
/// them twice, into fresh pages, costs more than most of what is done with them.
template <class T>
class ArrayAllocator {
 public:
  using value_type = T;
  ArrayAllocator() = default;
  template <class U>
  ArrayAllocator(const ArrayAllocator<U>&) noexcept {}

  T* allocate(std::size_t count) {
    if (count > std::numeric_limits<std::size_t>::max() / sizeof(T)) throw std::bad_array_new_length();
    if (count * sizeof(T) < kPooled) return static_cast<T*>(::operator new(count * sizeof(T), kAlignment));
    return reinterpret_cast<T*>(pool_allocate(count * sizeof(T)));
  }
  void deallocate(T* data, std::size_t count) noexcept {
    if (count * sizeof(T) < kPooled) return ::operator delete(data, kAlignment);
    pool_free(reinterpret_cast<std::byte*>(data), count * sizeof(T));
  }
  template <class U>
  void construct(U* place) noexcept(std::is_nothrow_default_constructible_v<U>) {
    ::new (static_cast<void*>(place)) U;
  }
  template <class U, class... Arguments>
  void construct(U* place, Arguments&&... arguments) {
    ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
  }
  template <class U>
  bool operator==(const ArrayAllocator<U>&) const noexcept {
    return true;
  }

 private:
  static constexpr std::align_val_t kAlignment{64};
  static constexpr std::size_t kPooled = std::size_t{64} << 10;
};

/// A std::vector for the elements of models. After `resize` the new elements are undefined.
template <class T>
using Array = std::vector<T, ArrayAllocator<T>>;

}  // namespace azulejo
