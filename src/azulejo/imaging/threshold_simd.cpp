#include "azulejo/imaging/threshold_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/threshold_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class T>
void ThresholdRow(const T* source, T* result, std::size_t count, int period, T level, T above, T below) {
  const hn::ScalableTag<T> d;
  const std::size_t lanes = hn::Lanes(d);
  const auto cut = hn::Set(d, level);
  const auto yes = hn::Set(d, above);
  const auto no = hn::Set(d, below);
  std::size_t i = 0;
  if (period == 2 || period == 4) {
    HWY_ALIGN T pattern[HWY_MAX_BYTES / sizeof(T)];
    for (std::size_t k = 0; k < lanes; ++k) pattern[k] = static_cast<int>(k) % period == period - 1 ? T{1} : T{0};
    const auto is_alpha = hn::Eq(hn::Load(d, pattern), hn::Set(d, T{1}));
    for (; i + lanes <= count; i += lanes) {
      const auto v = hn::LoadU(d, source + i);
      hn::StoreU(hn::IfThenElse(is_alpha, v, hn::IfThenElse(hn::Gt(v, cut), yes, no)), d, result + i);
    }
  } else {
    for (; i + lanes <= count; i += lanes) {
      const auto v = hn::LoadU(d, source + i);
      hn::StoreU(hn::IfThenElse(hn::Gt(v, cut), yes, no), d, result + i);
    }
  }
  for (; i < count; ++i) {
    const bool alpha = period > 1 && static_cast<int>(i % static_cast<std::size_t>(period)) == period - 1;
    if (alpha) {
      result[i] = source[i];
    } else {
      result[i] = source[i] > level ? above : below;
    }
  }
}

void ThresholdU8(const std::uint8_t* s, std::uint8_t* r, std::size_t n, int p, std::uint8_t l, std::uint8_t a, std::uint8_t b) {
  ThresholdRow(s, r, n, p, l, a, b);
}
void ThresholdU16(const std::uint16_t* s, std::uint16_t* r, std::size_t n, int p, std::uint16_t l, std::uint16_t a, std::uint16_t b) {
  ThresholdRow(s, r, n, p, l, a, b);
}
void ThresholdF32(const float* s, float* r, std::size_t n, int p, float l, float a, float b) {
  ThresholdRow(s, r, n, p, l, a, b);
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(ThresholdU8);
HWY_EXPORT(ThresholdU16);
HWY_EXPORT(ThresholdF32);

void threshold_row(const std::uint8_t* source, std::uint8_t* result, std::size_t count, int period, std::uint8_t level,
                   std::uint8_t above, std::uint8_t below) {
  HWY_DYNAMIC_DISPATCH(ThresholdU8)(source, result, count, period, level, above, below);
}
void threshold_row(const std::uint16_t* source, std::uint16_t* result, std::size_t count, int period,
                   std::uint16_t level, std::uint16_t above, std::uint16_t below) {
  HWY_DYNAMIC_DISPATCH(ThresholdU16)(source, result, count, period, level, above, below);
}
void threshold_row(const float* source, float* result, std::size_t count, int period, float level, float above,
                   float below) {
  HWY_DYNAMIC_DISPATCH(ThresholdF32)(source, result, count, period, level, above, below);
}

}  // namespace azulejo::kernels
#endif
