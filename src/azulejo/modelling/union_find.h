#pragma once

#include <cstddef>
#include <cstdint>

#include "azulejo/data/array.h"

namespace azulejo {

/// Sets of numbers that grow together, each element with a parity beside its set's root. Cost of a call: nearly O(1).
class UnionFind {
 public:
  explicit UnionFind(std::size_t count) : parents_(count) {
    for (std::size_t i = 0; i < count; ++i) parents_[i] = static_cast<std::uint32_t>(i) << 1;
  }

  std::uint32_t root(std::uint32_t element) { return find(element) >> 1; }
  /// Whether its parity differs from its root's.
  bool odd(std::uint32_t element) { return (find(element) & 1U) != 0; }
  bool unite(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t x = find(a) >> 1;
    const std::uint32_t y = find(b) >> 1;
    if (x == y) return false;
    parents_[x > y ? x : y] = (x > y ? y : x) << 1;
    return true;
  }
  /// Unites the sets of two elements whose parities must differ or be the same; false if they can't.
  bool join(std::uint32_t a, std::uint32_t b, bool differ) {
    const std::uint32_t x = find(a);
    const std::uint32_t y = find(b);
    const std::uint32_t parity = (x ^ y ^ (differ ? 1U : 0U)) & 1U;
    if (x >> 1 == y >> 1) return parity == 0;
    // The lower one stays: roots don't depend on the order of the calls.
    const bool first_low = x < y;
    parents_[(first_low ? y : x) >> 1] = (first_low ? x : y) >> 1 << 1 | parity;
    return true;
  }

 private:
  /// The root · 2 + the element's parity against it. Halves the way.
  std::uint32_t find(std::uint32_t element) {
    std::uint32_t parity = 0;
    for (;;) {
      const std::uint32_t up = parents_[element];
      if (up >> 1 == element) return element << 1 | parity;
      const std::uint32_t above = parents_[up >> 1];
      if (above >> 1 != up >> 1) parents_[element] = above ^ (up & 1U);
      parity ^= up & 1U;
      element = up >> 1;
    }
  }

  Array<std::uint32_t> parents_;  ///< parent · 2 + parity against it
};

}  // namespace azulejo
