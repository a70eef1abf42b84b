#pragma once

#include <cstddef>
#include <cstdint>

namespace azulejo::kernels {

/// What becomes of a value s and its smoothed surroundings g: base · s + gain · d, where the detail d is s − g, or 0 if
/// |s − g| < threshold.
struct DetailWeights {
  float base = 1;
  float gain = 1;
  float threshold = 0;
};

/// The definition.
inline float detailed(float s, float g, const DetailWeights& weights) {
  const float difference = s - g;
  const float magnitude = difference < 0 ? -difference : difference;
  const float d = magnitude < weights.threshold ? 0.0F : difference;
  return weights.base * s + weights.gain * d;
}

/// f32: in place in `s`.
void detail_row(float* s, const float* g, std::size_t count, const DetailWeights& weights);
/// Bytes: g in 1/64 of a level; rounded half up, saturated.
void detail_row(const std::uint8_t* s, const std::int16_t* g, std::size_t count, const DetailWeights& weights,
                std::uint8_t* result);
/// Bytes to f32: times `scale`.
void detail_row(const std::uint8_t* s, const std::int16_t* g, std::size_t count, const DetailWeights& weights,
                float scale, float* result);

}  // namespace azulejo::kernels
