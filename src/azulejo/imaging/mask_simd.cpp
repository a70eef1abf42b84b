#include "azulejo/imaging/mask_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/mask_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class T>
void repeat(const T* values, std::size_t pixels, int channels, T* result) {
  const hn::ScalableTag<T> d;
  const std::size_t lanes = hn::Lanes(d);
  const auto step = static_cast<std::size_t>(channels);
  std::size_t x = 0;
  for (; x + lanes <= pixels; x += lanes) {
    const auto v = hn::LoadU(d, values + x);
    T* const to = result + x * step;
    if (channels == 2) hn::StoreInterleaved2(v, v, d, to);
    if (channels == 3) hn::StoreInterleaved3(v, v, v, d, to);
    if (channels == 4) hn::StoreInterleaved4(v, v, v, v, d, to);
  }
  for (; x < pixels; ++x) {
    for (std::size_t c = 0; c < step; ++c) result[x * step + c] = values[x];
  }
}

void RepeatValues(PixelType type, const std::byte* values, std::size_t pixels, int channels, std::byte* result) {
  visit_type(type, [&](auto zero) HWY_ATTR {
    using T = decltype(zero);
    repeat(reinterpret_cast<const T*>(values), pixels, channels, reinterpret_cast<T*>(result));
  });
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(RepeatValues);

void repeat_values(PixelType type, const std::byte* values, std::size_t pixels, int channels, std::byte* result) {
  HWY_DYNAMIC_DISPATCH(RepeatValues)(type, values, pixels, channels, result);
}

}  // namespace azulejo::kernels
#endif
