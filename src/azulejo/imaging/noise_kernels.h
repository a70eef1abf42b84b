#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "azulejo/data/view.h"
#include "azulejo/math/exponential.h"
#include "azulejo/math/normal.h"
#include "azulejo/math/random.h"

namespace azulejo::kernels {

/// Random words of a row: that of value i is word i % 4 of the block i / 4.
struct NoiseBits {
  std::uint32_t seed;
  std::uint32_t row;
  std::uint32_t first_block;
  std::size_t blocks;
};
constexpr std::size_t kNoiseRoom = 256;  ///< words that may be written behind the last block

void noise_bits(const NoiseBits& place, std::uint32_t* words);
inline void noise_bits_reference(const NoiseBits& place, std::uint32_t* words) {
  for (std::size_t b = 0; b < place.blocks; ++b) {
    const auto block = static_cast<std::uint32_t>(place.first_block + b);
    const auto four = philox({block, place.row, 0, 0}, {place.seed, 0});
    std::copy_n(four.data(), 4, words + 4 * b);
  }
}

/// Normal deviates of `count` words.
void noise_normal(const std::uint32_t* words, std::size_t count, float* deviates);
inline void noise_normal_reference(const std::uint32_t* words, std::size_t count, float* deviates) {
  for (std::size_t i = 0; i < count; ++i) deviates[i] = normal_deviate(words[i]);
}

/// A Poisson count of this mean: the one whose share contains that of the word.
inline double poisson_count(double mean, std::uint32_t word, float deviate) {
  if (mean < 32) {
    const double share = (static_cast<double>(word) + 0.5) * 0x1p-32;
    double probability = exp_deterministic(-mean);
    double below = probability;
    int count = 0;
    while (below < share && count < 200) {  // of a mean of 32, 200 is beyond any share
      ++count;
      probability *= mean / count;
      below += probability;
    }
    return count;
  }
  const double z = deviate;
  const double square = z * z;
  const double root = std::sqrt(mean);
  const double quantile = mean + root * z + (2 + square) / 6 - z * (2 + square) / (72 * root) +
                          ((square / 270 + 7.0 / 810) * square - 8.0 / 405) / mean;
  return std::max(0.0, std::floor(quantile));
}

/// A value in stored units as it is stored.
template <class T>
T noise_stored(float value, float top) {
  if constexpr (std::is_same_v<T, float>) return value;
  return static_cast<T>(std::clamp(value + 0.5F, 0.0F, top));
}

/// value + deviate · (base + factor · value), saturated at `top` in integers.
template <class T>
T noise_added(T value, float deviate, float base, float factor, float top) {
  const auto v = static_cast<float>(value);
  return noise_stored<T>(v + deviate * (base + factor * v), top);
}

/// A row of values; with a period other than 0, the last value of each is alpha, and is copied.
template <class T>
struct NoiseRow {
  const T* source;
  T* result;  ///< may be the source
  const float* deviates;
  std::size_t count;
  int period;
  float base;
  float factor;
};
void noise_add(const NoiseRow<std::uint8_t>& row);
void noise_add(const NoiseRow<std::uint16_t>& row);
void noise_add(const NoiseRow<float>& row);

template <class T>
void noise_add_reference(const NoiseRow<T>& row, std::size_t from = 0) {
  const float top = full_range(kPixelTypeOf<T>);
  for (std::size_t i = from; i < row.count; ++i) {
    const bool alpha = row.period > 0 && (i + 1) % static_cast<std::size_t>(row.period) == 0;
    row.result[i] = alpha ? row.source[i] : noise_added(row.source[i], row.deviates[i], row.base, row.factor, top);
  }
}

}  // namespace azulejo::kernels
