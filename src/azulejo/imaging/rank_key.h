#pragma once

#include <bit>
#include <cstdint>
#include <type_traits>

namespace azulejo {

/// Values as integers in the same order, for filters that rank. Bytes and 16-bit values are their own keys. Of floats, −0
/// is below 0, and any NaN above infinity: it comes back as the NaN with bits 0x7FFFFFFF.
template <class T>
using RankKey = std::conditional_t<std::is_same_v<T, float>, std::int32_t, T>;

template <class T>
RankKey<T> rank_key(T value) {
  if constexpr (std::is_same_v<T, float>) {
    const auto bits = std::bit_cast<std::int32_t>(value);
    if ((bits & 0x7FFFFFFF) > 0x7F800000) return 0x7FFFFFFF;
    return bits ^ ((bits >> 31) & 0x7FFFFFFF);
  } else {
    return value;
  }
}

template <class T>
T ranked_value(RankKey<T> key) {
  if constexpr (std::is_same_v<T, float>) {
    return std::bit_cast<float>(key ^ ((key >> 31) & 0x7FFFFFFF));
  } else {
    return key;
  }
}

}  // namespace azulejo
