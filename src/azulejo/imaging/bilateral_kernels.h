#pragma once

#include <cstddef>
#include <vector>

#include "azulejo/engine/scratch.h"

namespace azulejo::kernels {

/// A pixel of the window and the one opposite of it. Of each such pair there is one: below, or to the right.
struct BilateralOffset {
  int dx;
  int dy;
  float distance;  ///< the exponent of its weight, over kBilateralPower
};

/// exp(−x) is (1 − t + t²/2 − t³/6)^64 with t = x / 64: for weights within 4·10⁻⁶.
constexpr int kBilateralPower = 64;
inline float bilateral_weight(float t) {
  const float least = t < 1.0F ? t : 1.0F;
  float power = ((least * (-1.0F / 6) + 0.5F) * least - 1.0F) * least + 1.0F;
  for (int i = 1; i < kBilateralPower; i *= 2) power = power * power;
  return power;
}

/// Channels, one below the other, scaled so that the square of a difference is the exponent over kBilateralPower.
///
/// For each pixel: sum = 1 and change = 0; for each offset, first the pixel opposite, then the pixel itself, adds its
/// weight to the sum, and times its difference from the pixel in the middle to the change of each channel.
struct BilateralPlanes {
  const float* values;  ///< channels × (height + 2 · radius) rows of `stride` values; the first pixel's row and column
                        ///< are `radius` and bilateral_margin(radius)
  std::ptrdiff_t stride;  ///< at least bilateral_stride(width, radius)
  int channels;
  int width;
  int height;
  int radius;
};
constexpr std::ptrdiff_t bilateral_margin(int radius) { return (radius + 15) / 16 * 32; }
constexpr std::ptrdiff_t bilateral_stride(int width, int radius) {
  return (width + 2 * bilateral_margin(radius) + 31) / 16 * 16;
}

/// changes  channels × height rows of `width` values, rounded up to 16 in memory: change ÷ sum
void bilateral_planes(const BilateralPlanes& planes, const std::vector<BilateralOffset>& offsets, float* changes,
                      std::ptrdiff_t changes_stride, Scratch& scratch);

}  // namespace azulejo::kernels
