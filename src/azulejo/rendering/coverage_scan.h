#pragma once

#include <cstdint>

#include "azulejo/data/array.h"
#include "azulejo/data/drawing.h"

namespace azulejo {

/// Pixels of a row are handled in blocks of so many.
inline constexpr int kBlock = 16;

/// A run of blocks in a row: pixels from first · kBlock to before last · kBlock.
struct CoverageRun {
  int first = 0;
  int last = 0;
  float value = 0;     ///< what part of each pixel is inside: the same for all
  bool mixed = false;  ///< it differs: it is in the row's coverage
};

namespace kernels {

/// Sums `count` signed areas (a multiple of 4) from left to right, beginning with `carry`, in units of 2⁻¹⁶, modulo 2³².
/// Writes the sums to `areas` and the part of each pixel that is inside to `coverage`, and clears the areas.
/// Result  the last sum
std::int32_t sum_areas(std::uint32_t* areas, std::int32_t carry, int count, FillRule rule, std::int32_t* sums,
                       float* coverage);

/// What is inside where windings sum up to `area`.
inline float inside_of(std::int32_t area, FillRule rule) {
  constexpr std::uint32_t kOne = 1U << 16;
  const auto bits = static_cast<std::uint32_t>(area);
  const std::uint32_t size = area < 0 ? 0U - bits : bits;
  if (rule == FillRule::NonZero) return static_cast<float>(size < kOne ? size : kOne) * 0x1p-16F;
  const std::uint32_t folded = size & (2 * kOne - 1);
  return static_cast<float>(folded <= kOne ? folded : 2 * kOne - folded) * 0x1p-16F;
}

}  // namespace kernels
}  // namespace azulejo
