#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "azulejo/data/view.h"

namespace azulejo::kernels {

/// The stored value of a level, counted from 0 to `last`.
template <class T>
T level_value(float level, float last) {
  const float value = level * full_range(kPixelTypeOf<T>) / last;
  if constexpr (std::is_same_v<T, float>) return value;
  return static_cast<T>(value + 0.5F);
}

/// The level of a place among levels, of which the highest is `last`: the one below it, or above where what is left
/// reaches the threshold, which is above 0 and below 1. NaN is not asked for.
inline float level_at(float place, float threshold, float last) {
  const float below = std::floor(place);
  return std::clamp(below + (place - below >= threshold ? 1.0F : 0.0F), 0.0F, last);
}

/// A row of values; with a period other than 0, the last value of each is alpha, and is copied.
template <class T>
struct QuantizeRow {
  const T* source;
  const float* thresholds;  ///< one a value: of what is below, the level above is taken
  T* result;                ///< may be the source
  std::size_t count;
  int period;
  float last;  ///< levels less one
};
void quantize_row(const QuantizeRow<std::uint8_t>& row);
void quantize_row(const QuantizeRow<std::uint16_t>& row);
void quantize_row(const QuantizeRow<float>& row);

/// What dithering makes of a byte: `low`, or `high` where its rank is above the threshold.
struct ByteQuantizer {
  bool binary = false;  ///< the rank of v is v, low is 0, high 255
  std::uint8_t rank[256];
  std::uint8_t low[256];
  std::uint8_t high[256];
};
/// thresholds  one a value, of ranks
void quantize_bytes(const ByteQuantizer& quantizer, const std::uint8_t* source, const std::uint8_t* thresholds,
                    std::size_t count, std::uint8_t* result);

/// A value's place among the levels: 0 to `last` over 0–1.
template <class T>
float place_of(T value, float last) {
  return static_cast<float>(value) * (last / full_range(kPixelTypeOf<T>));
}

template <class T>
T quantized(T value, float place, float threshold, float last) {
  return value != value ? value : level_value<T>(level_at(place, threshold, last), last);
}

template <class T>
void quantize_row_reference(const QuantizeRow<T>& row, std::size_t from = 0) {
  for (std::size_t i = from; i < row.count; ++i) {
    const bool alpha = row.period > 0 && (i + 1) % static_cast<std::size_t>(row.period) == 0;
    const T value = row.source[i];
    row.result[i] = alpha ? value : quantized(value, place_of(value, row.last), row.thresholds[i], row.last);
  }
}

}  // namespace azulejo::kernels
