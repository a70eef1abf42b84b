#pragma once

#include <cstddef>
#include <span>

namespace azulejo::kernels {

/// Rows of results computed at once: they share what they read.
constexpr int kConvolveRows = 4;

/// A place of the source that is read, and what it is weighted with.
struct ConvolveStep {
  std::ptrdiff_t offset = 0;  ///< values from the result's place in its row
  std::ptrdiff_t mirror = 0;  ///< a second place with the same weight; as `offset`: there is none
  int row = 0;                ///< of the source, counted from the first that the first result row reads
  unsigned outputs = 0;       ///< bit r: result row r reads it
  float weights[kConvolveRows] = {};
};

/// What is summed. For result row r, value i, over the steps that it reads, in their order, from 0 on,
/// sum of weight · (b + a), a = source[step.row][i + step.offset] and b that at step.mirror (`opposed`: b − a; without
/// a mirror: a), and a center if there are any; the result is that · scale + offset.
struct ConvolveTaps {
  std::span<const ConvolveStep> steps;
  bool opposed = false;
  float scale = 1;
  float offset = 0;
};

/// Rows of f32. Reads nothing but what the steps say, writes `count` values a row.
/// rows     result rows, 1 or kConvolveRows
/// source   a pointer to each row of the source
/// centers  a row for each result row, which is added to the sum; null: none
void convolve_rows(const ConvolveTaps& taps, const float* const* source, const float* const* centers, int rows,
                   std::size_t count, float* const* results);

/// differences[i] = minuend[i] − subtrahend[i]
void subtract_row(const float* minuend, const float* subtrahend, std::size_t count, float* differences);

/// The scalar definition, for value i of row r.
inline float convolved(const ConvolveTaps& taps, const float* const* source, const float* const* centers, int r,
                       std::ptrdiff_t i) {
  float sum = 0;
  for (const ConvolveStep& step : taps.steps) {
    if ((step.outputs >> r & 1U) == 0) continue;
    float value = source[step.row][i + step.offset];
    if (step.mirror != step.offset) {
      const float other = source[step.row][i + step.mirror];
      value = taps.opposed ? other - value : other + value;
    }
    sum = sum + step.weights[r] * value;
  }
  if (centers != nullptr) sum = sum + centers[r][i];
  return sum * taps.scale + taps.offset;
}

}  // namespace azulejo::kernels
