#include "azulejo/rendering/coverage_scan.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/rendering/coverage_scan_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using I = hn::CappedTag<std::int32_t, 4>;
using U = hn::RebindToUnsigned<I>;
using F = hn::RebindToFloat<I>;
using VI = hn::Vec<I>;

template <FillRule kRule>
std::int32_t sum(std::uint32_t* areas, std::int32_t carry, int count, std::int32_t* sums, float* coverage) {
  const I i;
  const U u;
  const F f;
  const auto one = hn::Set(u, 1U << 16);
  VI before = hn::Set(i, carry);
  for (int x = 0; x < count; x += 4) {
    VI v = hn::BitCast(i, hn::Load(u, areas + x));
    hn::Store(hn::Zero(u), u, areas + x);
    v = hn::Add(v, hn::ShiftLeftLanes<1>(i, v));
    v = hn::Add(v, hn::ShiftLeftLanes<2>(i, v));
    v = hn::Add(v, before);
    before = hn::Broadcast<3>(v);
    hn::Store(v, i, sums + x);
    auto size = hn::BitCast(u, hn::Abs(v));
    if constexpr (kRule == FillRule::EvenOdd) {
      size = hn::And(size, hn::Set(u, (2U << 16) - 1));
      size = hn::Min(size, hn::Sub(hn::Set(u, 2U << 16), size));
    } else {
      size = hn::Min(size, one);
    }
    hn::Store(hn::Mul(hn::ConvertTo(f, hn::BitCast(i, size)), hn::Set(f, 0x1p-16F)), f, coverage + x);
  }
  return hn::GetLane(before);
}

std::int32_t SumAreas(std::uint32_t* areas, std::int32_t carry, int count, FillRule rule, std::int32_t* sums,
                      float* coverage) {
  return rule == FillRule::NonZero ? sum<FillRule::NonZero>(areas, carry, count, sums, coverage)
                                   : sum<FillRule::EvenOdd>(areas, carry, count, sums, coverage);
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(SumAreas);

std::int32_t sum_areas(std::uint32_t* areas, std::int32_t carry, int count, FillRule rule, std::int32_t* sums,
                       float* coverage) {
  return HWY_DYNAMIC_DISPATCH(SumAreas)(areas, carry, count, rule, sums, coverage);
}

}  // namespace azulejo::kernels
#endif
