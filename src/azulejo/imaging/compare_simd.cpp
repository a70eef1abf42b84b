#include "azulejo/imaging/compare_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/compare_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::ScalableTag<float>;

/// result[i] = f(i) for whole vectors, the last one moved back; rows shorter than a vector go through padded copies.
template <class F>
void for_vectors(const float* const* sources, std::size_t source_count, std::size_t count, float* result, F f) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  if (count >= lanes) {
    // In place, the last vector would read results: it is computed before the others are stored.
    const auto last = f(sources, count - lanes);
    for (std::size_t i = 0; i + lanes <= count; i += lanes) hn::StoreU(f(sources, i), d, result + i);
    hn::StoreU(last, d, result + count - lanes);
    return;
  }
  HWY_ALIGN float padded[5][HWY_MAX_BYTES / sizeof(float)] = {};
  const float* rows[5] = {};
  for (std::size_t s = 0; s < source_count; ++s) {
    std::copy_n(sources[s], count, padded[s]);
    rows[s] = padded[s];
  }
  HWY_ALIGN float values[HWY_MAX_BYTES / sizeof(float)];
  hn::Store(f(static_cast<const float* const*>(rows), std::size_t{0}), d, values);
  std::copy_n(values, count, result);
}

void DivideRow(float* row, std::size_t count, float unit) {
  const Floats d;
  const float* const sources[] = {row};
  for_vectors(sources, 1, count, row, [&](const float* const* from, std::size_t i) HWY_ATTR {
    return hn::Div(hn::LoadU(d, from[0] + i), hn::Set(d, unit));
  });
}

void DifferenceRow(const float* a, const float* b, std::size_t count, float gain, float* result) {
  const Floats d;
  const float* const sources[] = {a, b};
  for_vectors(sources, 2, count, result, [&](const float* const* from, std::size_t i) HWY_ATTR {
    const auto x = hn::LoadU(d, from[0] + i);
    const auto y = hn::LoadU(d, from[1] + i);
    const auto same = hn::Or(hn::Eq(x, y), hn::And(hn::IsNaN(x), hn::IsNaN(y)));
    return hn::IfThenZeroElse(same, hn::Mul(hn::Abs(hn::Sub(x, y)), hn::Set(d, gain)));
  });
}

void ProductRow(const float* a, const float* b, std::size_t count, float* result) {
  const Floats d;
  const float* const sources[] = {a, b};
  for_vectors(sources, 2, count, result, [&](const float* const* from, std::size_t i) HWY_ATTR {
    return hn::Mul(hn::LoadU(d, from[0] + i), hn::LoadU(d, from[1] + i));
  });
}

void SimilarityRow(const float* const* means, std::size_t count, float* result) {
  const Floats d;
  const auto c1 = hn::Set(d, kSsimC1);
  const auto c2 = hn::Set(d, kSsimC2);
  for_vectors(means, 5, count, result, [&](const float* const* from, std::size_t i) HWY_ATTR {
    const auto x = hn::LoadU(d, from[0] + i);
    const auto y = hn::LoadU(d, from[1] + i);
    const auto xx = hn::Mul(x, x);
    const auto yy = hn::Mul(y, y);
    const auto xy = hn::Mul(x, y);
    const auto variances = hn::Add(hn::Sub(hn::LoadU(d, from[2] + i), xx), hn::Sub(hn::LoadU(d, from[3] + i), yy));
    const auto covariance = hn::Sub(hn::LoadU(d, from[4] + i), xy);
    const auto above = hn::Mul(hn::Add(hn::Add(xy, xy), c1), hn::Add(hn::Add(covariance, covariance), c2));
    const auto below = hn::Mul(hn::Add(hn::Add(xx, yy), c1), hn::Add(variances, c2));
    const auto ratio = hn::Div(above, below);
    const auto one = hn::Set(d, 1.0F);
    return hn::IfThenElse(hn::Gt(ratio, one), one, ratio);  // what rounding leaves
  });
}

WholeSums SumWhole(const float* row, std::size_t count, float steps) {
  const Floats d;
  const hn::RebindToUnsigned<Floats> du;
  const hn::Repartition<std::uint64_t, Floats> d64;
  const std::size_t lanes = hn::Lanes(d);
  WholeSums total;
  auto largest = hn::Zero(d);
  auto sums = hn::Zero(d64);
  auto squares = hn::Zero(d64);
  const auto add = [&](auto v) HWY_ATTR {
    largest = hn::Max(largest, v);
    total.different += lanes - hn::CountTrue(d, hn::Eq(v, hn::Zero(d)));
    const auto whole = hn::BitCast(
        du, hn::ConvertTo(hn::RebindToSigned<Floats>(), hn::Add(hn::Mul(v, hn::Set(d, steps)), hn::Set(d, 0.5F))));
    const auto odd = hn::ShiftRight<32>(hn::BitCast(d64, whole));
    const auto even = hn::And(hn::BitCast(d64, whole), hn::Set(d64, 0xFFFFFFFFU));
    sums = hn::Add(sums, hn::Add(even, odd));
    squares =
        hn::Add(squares, hn::Add(hn::MulEven(whole, whole), hn::MulEven(hn::BitCast(du, odd), hn::BitCast(du, odd))));
  };
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) add(hn::LoadU(d, row + i));
  if (i < count) {
    HWY_ALIGN float rest[HWY_MAX_BYTES / sizeof(float)] = {};
    std::copy_n(row + i, count - i, rest);
    add(hn::Load(d, rest));
  }
  total.largest = hn::GetLane(hn::MaxOfLanes(d, largest));
  total.sum = hn::GetLane(hn::SumOfLanes(d64, sums));
  total.squares = hn::GetLane(hn::SumOfLanes(d64, squares));
  return total;
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(DivideRow);
HWY_EXPORT(DifferenceRow);
HWY_EXPORT(ProductRow);
HWY_EXPORT(SimilarityRow);
HWY_EXPORT(SumWhole);

void divide_row(float* row, std::size_t count, float unit) { HWY_DYNAMIC_DISPATCH(DivideRow)(row, count, unit); }
void difference_row(const float* a, const float* b, std::size_t count, float gain, float* result) {
  HWY_DYNAMIC_DISPATCH(DifferenceRow)(a, b, count, gain, result);
}
void product_row(const float* a, const float* b, std::size_t count, float* result) {
  HWY_DYNAMIC_DISPATCH(ProductRow)(a, b, count, result);
}
void similarity_row(const float* const means[5], std::size_t count, float* result) {
  HWY_DYNAMIC_DISPATCH(SimilarityRow)(means, count, result);
}
WholeSums sum_whole(const float* row, std::size_t count, float steps) {
  return HWY_DYNAMIC_DISPATCH(SumWhole)(row, count, steps);
}

}  // namespace azulejo::kernels
#endif
