#include "azulejo/imaging/spectrum_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/spectrum_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, 16>;
using Floats = hn::Vec<FloatTag>;

/// ln of x ≥ 1: x = 2ⁿ · m with m in [¾, 1½), ln m = 2 artanh((m − 1) / (m + 1)) by its series to the eleventh power.
HWY_INLINE Floats Log(Floats x) {
  const FloatTag d;
  const hn::RebindToSigned<FloatTag> di;
  // Bits count from those of ¾, so that the exponent changes there.
  const auto start = hn::Set(di, 0x3F400000);
  const auto above = hn::Sub(hn::BitCast(di, x), start);
  const Floats n = hn::ConvertTo(d, hn::ShiftRight<23>(above));
  const Floats m = hn::BitCast(d, hn::Add(hn::And(above, hn::Set(di, 0x007FFFFF)), start));
  const Floats one = hn::Set(d, 1.0F);
  const Floats t = hn::Div(hn::Sub(m, one), hn::Add(m, one));
  const Floats square = hn::Mul(t, t);
  Floats sum = hn::Set(d, 2.0F / 11);
  for (const float coefficient : {2.0F / 9, 2.0F / 7, 2.0F / 5, 2.0F / 3, 2.0F}) {
    sum = hn::Add(hn::Mul(sum, square), hn::Set(d, coefficient));
  }
  return hn::Add(hn::Mul(n, hn::Set(d, 0.693147181F)), hn::Mul(sum, t));
}

void LogMagnitudes(float* re, const float* im, std::size_t count) {
  const FloatTag d;
  const Floats most = hn::Set(d, 3e38F);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const Floats x = hn::LoadU(d, re + i);
    const Floats y = hn::LoadU(d, im + i);
    const Floats length = hn::Sqrt(hn::Add(hn::Mul(x, x), hn::Mul(y, y)));
    const Floats value = Log(hn::Add(length, hn::Set(d, 1.0F)));
    hn::StoreU(hn::IfThenElse(hn::Le(length, most), value, hn::NaN(d)), d, re + i);
  }
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(LogMagnitudes);

void log_magnitudes(float* re, const float* im, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(LogMagnitudes)(re, im, count);
}

}  // namespace azulejo::kernels
#endif
