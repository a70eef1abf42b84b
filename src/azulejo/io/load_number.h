#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

namespace azulejo {

/// A number as it lies in a file, in the order of bytes given; any alignment.
template <class T>
T load_number(const std::byte* bytes, std::endian order) {
  std::array<std::byte, sizeof(T)> copy;
  std::memcpy(copy.data(), bytes, sizeof(T));
  if (order != std::endian::native) std::reverse(copy.begin(), copy.end());
  return std::bit_cast<T>(copy);
}

/// Puts a number where it will lie in a file.
template <class T>
void store_number(std::byte* bytes, T value, std::endian order) {
  auto copy = std::bit_cast<std::array<std::byte, sizeof(T)>>(value);
  if (order != std::endian::native) std::reverse(copy.begin(), copy.end());
  std::memcpy(bytes, copy.data(), sizeof(T));
}

}  // namespace azulejo
