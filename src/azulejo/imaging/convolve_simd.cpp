// How it is fast. A vector of the source that was loaded serves all rows of results that read it: a kernel of
// 5 × 5 values and four rows loads 40 vectors for 100 products.
#include "azulejo/imaging/convolve_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/convolve_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::ScalableTag<float>;
using Floats = hn::Vec<FloatTag>;

/// Vectors of a row at once: as many sums as there are registers for.
constexpr int kVectors = HWY_MAX_BYTES == 64 ? 4 : 2;

/// kWide vectors of each of kRows rows, from value i on.
template <int kRows, int kWide>
HWY_INLINE void Block(const ConvolveTaps& taps, const float* const* HWY_RESTRICT source, const float* const* centers,
                      std::ptrdiff_t i, float* const* HWY_RESTRICT results) {
  const FloatTag d;
  const auto lanes = static_cast<std::ptrdiff_t>(hn::Lanes(d));
  Floats sum[kRows][kWide];
#pragma GCC unroll 4
  for (int r = 0; r < kRows; ++r) {
#pragma GCC unroll 4
    for (int v = 0; v < kWide; ++v) sum[r][v] = hn::Zero(d);
  }
  for (const ConvolveStep& step : taps.steps) {
    const float* const from = source[step.row] + i;
    Floats value[kWide];
#pragma GCC unroll 4
    for (int v = 0; v < kWide; ++v) value[v] = hn::LoadU(d, from + step.offset + v * lanes);
    if (step.mirror != step.offset) {
#pragma GCC unroll 4
      for (int v = 0; v < kWide; ++v) {
        const Floats other = hn::LoadU(d, from + step.mirror + v * lanes);
        value[v] = taps.opposed ? hn::Sub(other, value[v]) : hn::Add(other, value[v]);
      }
    }
#pragma GCC unroll 4
    for (int r = 0; r < kRows; ++r) {
      if (kRows > 1 && (step.outputs & (1U << r)) == 0) continue;
      const Floats weight = hn::Set(d, step.weights[r]);
#pragma GCC unroll 4
      for (int v = 0; v < kWide; ++v) sum[r][v] = hn::Add(sum[r][v], hn::Mul(weight, value[v]));
    }
  }
  const Floats scale = hn::Set(d, taps.scale);
  const Floats offset = hn::Set(d, taps.offset);
#pragma GCC unroll 4
  for (int r = 0; r < kRows; ++r) {
#pragma GCC unroll 4
    for (int v = 0; v < kWide; ++v) {
      if (centers != nullptr) sum[r][v] = hn::Add(sum[r][v], hn::LoadU(d, centers[r] + i + v * lanes));
      hn::StoreU(hn::Add(hn::Mul(sum[r][v], scale), offset), d, results[r] + i + v * lanes);
    }
  }
}

template <int kRows>
void Rows(const ConvolveTaps& taps, const float* const* source, const float* const* centers, std::ptrdiff_t count,
          float* const* results) {
  const auto lanes = static_cast<std::ptrdiff_t>(hn::Lanes(FloatTag()));
  if (count < lanes) {
    for (int r = 0; r < kRows; ++r) {
      for (std::ptrdiff_t i = 0; i < count; ++i) results[r][i] = convolved(taps, source, centers, r, i);
    }
    return;
  }
  std::ptrdiff_t i = 0;
  for (; i + kVectors * lanes <= count; i += kVectors * lanes) {
    Block<kRows, kVectors>(taps, source, centers, i, results);
  }
  for (; i + lanes <= count; i += lanes) Block<kRows, 1>(taps, source, centers, i, results);
  if (i < count) Block<kRows, 1>(taps, source, centers, count - lanes, results);
}

void ConvolveRows(const ConvolveTaps& taps, const float* const* source, const float* const* centers, int rows,
                  std::size_t count, float* const* results) {
  const auto values = static_cast<std::ptrdiff_t>(count);
  if (rows == 1) return Rows<1>(taps, source, centers, values, results);
  Rows<kConvolveRows>(taps, source, centers, values, results);
}

void SubtractRow(const float* minuend, const float* subtrahend, std::size_t count, float* differences) {
  const FloatTag d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    hn::StoreU(hn::Sub(hn::LoadU(d, minuend + i), hn::LoadU(d, subtrahend + i)), d, differences + i);
  }
  for (; i < count; ++i) differences[i] = minuend[i] - subtrahend[i];
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(ConvolveRows);
HWY_EXPORT(SubtractRow);

void convolve_rows(const ConvolveTaps& taps, const float* const* source, const float* const* centers, int rows,
                   std::size_t count, float* const* results) {
  HWY_DYNAMIC_DISPATCH(ConvolveRows)(taps, source, centers, rows, count, results);
}

void subtract_row(const float* minuend, const float* subtrahend, std::size_t count, float* differences) {
  HWY_DYNAMIC_DISPATCH(SubtractRow)(minuend, subtrahend, count, differences);
}

}  // namespace azulejo::kernels
#endif
