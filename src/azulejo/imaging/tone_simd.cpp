#include <algorithm>

#include "azulejo/imaging/tone_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/tone_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "azulejo/imaging/rows_inl.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

void LoadIntensities(PixelType type, const std::byte* source, std::size_t count, float* row) {
  visit_type(type, [&](auto zero) HWY_ATTR {
    using T = decltype(zero);
    const V top = hn::Set(D(), full_range(type));
    ForVectors(reinterpret_cast<const T*>(source), row, count,
               [&](const T* from, float* to) HWY_ATTR { hn::StoreU(hn::Div(LoadStored(from), top), D(), to); });
  });
}

void StoreIntensities(PixelType type, const float* row, std::size_t count, std::byte* result) {
  visit_type(type, [&](auto zero) HWY_ATTR {
    using T = decltype(zero);
    const V top = hn::Set(D(), full_range(type));
    ForVectors(row, reinterpret_cast<T*>(result), count,
               [&](const float* from, T* to) HWY_ATTR { StoreRounded(hn::Mul(hn::LoadU(D(), from), top), to); });
  });
}

template <int kChannels>
void divide_pixels(const float* row, std::size_t count, float* result) {
  const AlphaOf<kChannels> alpha_of;
  ForVectors(row, result, count, [&](const float* from, float* to) HWY_ATTR {
    const V value = hn::LoadU(D(), from);
    const V alpha = alpha_of(value);
    hn::StoreU(hn::IfThenZeroElse(hn::Eq(alpha, hn::Zero(D())), hn::Div(value, alpha)), D(), to);
  });
}

void DivideByAlpha(const float* row, std::size_t count, int channels, float* result) {
  return channels == 2 ? divide_pixels<2>(row, count, result) : divide_pixels<4>(row, count, result);
}

/// Calls f(loaded, alpha of each, value) for the values of a row; alpha itself stays as it was loaded.
template <int kChannels, class F>
HWY_INLINE void finish_pixels(const float* loaded, std::size_t count, float* row, F f) {
  const AlphaOf<kChannels> alpha_of;
  const std::size_t lanes = hn::Lanes(D());
  const auto finish = [&](const float* from, float* to) HWY_ATTR {
    const V before = hn::LoadU(D(), from);
    hn::StoreU(hn::IfThenElse(alpha_of.is_alpha, before, f(alpha_of(before), hn::LoadU(D(), to))), D(), to);
  };
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) finish(loaded + i, row + i);
  if (i == count) return;
  HWY_ALIGN float from[HWY_MAX_BYTES / 4] = {};
  HWY_ALIGN float to[HWY_MAX_BYTES / 4] = {};
  std::copy(loaded + i, loaded + count, from);
  std::copy(row + i, row + count, to);
  finish(from, to);
  std::copy_n(to, count - i, row + i);
}

template <int kChannels>
void multiply_pixels(const float* loaded, std::size_t count, bool saturate, float* row) {
  finish_pixels<kChannels>(loaded, count, row, [&](V alpha, V value) HWY_ATTR {
    const D d;
    // NaN becomes 0, as it does where integers are stored.
    const V cut = hn::IfThenElseZero(hn::Gt(value, hn::Zero(d)), hn::Min(value, hn::Set(d, 1.0F)));
    const V product = hn::Mul(saturate ? cut : value, alpha);
    return hn::IfThenZeroElse(hn::Eq(alpha, hn::Zero(d)), product);
  });
}

void MultiplyByAlpha(const float* loaded, std::size_t count, int channels, bool saturate, float* row) {
  return channels == 2 ? multiply_pixels<2>(loaded, count, saturate, row)
                       : multiply_pixels<4>(loaded, count, saturate, row);
}

void KeepAlpha(const float* loaded, std::size_t count, int channels, float* row) {
  const auto same = [](V, V value) HWY_ATTR { return value; };
  return channels == 2 ? finish_pixels<2>(loaded, count, row, same) : finish_pixels<4>(loaded, count, row, same);
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(LoadIntensities);
HWY_EXPORT(StoreIntensities);
HWY_EXPORT(DivideByAlpha);
HWY_EXPORT(MultiplyByAlpha);
HWY_EXPORT(KeepAlpha);

void load_intensities(PixelType type, const std::byte* source, std::size_t count, float* row) {
  HWY_DYNAMIC_DISPATCH(LoadIntensities)(type, source, count, row);
}
void store_intensities(PixelType type, const float* row, std::size_t count, std::byte* result) {
  HWY_DYNAMIC_DISPATCH(StoreIntensities)(type, row, count, result);
}
void divide_by_alpha(const float* row, std::size_t count, int channels, float* result) {
  HWY_DYNAMIC_DISPATCH(DivideByAlpha)(row, count, channels, result);
}
void multiply_by_alpha(const float* loaded, std::size_t count, int channels, bool saturate, float* row) {
  HWY_DYNAMIC_DISPATCH(MultiplyByAlpha)(loaded, count, channels, saturate, row);
}
void keep_alpha(const float* loaded, std::size_t count, int channels, float* row) {
  HWY_DYNAMIC_DISPATCH(KeepAlpha)(loaded, count, channels, row);
}

}  // namespace azulejo::kernels
#endif
