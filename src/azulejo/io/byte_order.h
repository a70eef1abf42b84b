#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

namespace azulejo {

/// The number that lies at `bytes`, at any alignment.
template <class T>
T load_number(const std::byte* bytes, bool big_endian) {
  std::array<std::byte, sizeof(T)> copy;
  std::memcpy(copy.data(), bytes, sizeof(T));
  if (big_endian != (std::endian::native == std::endian::big)) std::reverse(copy.begin(), copy.end());
  return std::bit_cast<T>(copy);
}

}  // namespace azulejo
