#include "azulejo/imaging/grayscale_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/grayscale_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <cstring>
#include <limits>
#include <type_traits>

#include "azulejo/math/transfer_inl.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class D, class V>
HWY_INLINE V weighted(D d, V r, V g, V b, unsigned r_weight, unsigned g_weight, unsigned b_weight) {
  using T = hn::TFromD<D>;
  return hn::Add(
      hn::Add(hn::Mul(r, hn::Set(d, static_cast<T>(r_weight))), hn::Mul(g, hn::Set(d, static_cast<T>(g_weight)))),
      hn::Mul(b, hn::Set(d, static_cast<T>(b_weight))));
}

/// ⌊(299 R + 587 G + 114 B + 500) / 8⌋: of luma, what is then divided by 125.
template <class D, class V>
HWY_INLINE V luma_eighths(D d, V r, V g, V b) {
  const V half = hn::Set(d, 500);
  if constexpr (sizeof(hn::TFromD<D>) == 4)
    return hn::ShiftRight<3>(hn::Add(weighted(d, r, g, b, 299, 587, 114), half));
  // The sum in two parts that fit into 16 bits: 8 (37 R + 73 G + 14 B) + (3 R + 3 G + 2 B + 500).
  const V rg = hn::Add(r, g);
  const V rgb = hn::Add(rg, b);
  const V rest = hn::Add(hn::Add(hn::Add(rgb, rgb), rg), half);
  return hn::Add(weighted(d, r, g, b, 37, 73, 14), hn::ShiftRight<3>(rest));
}

/// ⌊v / 125⌋ of eighths: at most 31937 in lanes of 16 bits, at most 8191937 in lanes of 32.
template <class D, class V>
HWY_INLINE V over_125(D d, V v) {
  if constexpr (sizeof(hn::TFromD<D>) == 2) {
    // v · 33555 >> 22 for v up to 59074: 125 · 33555 exceeds 2²² by 71.
    return hn::ShiftRight<6>(hn::MulHigh(v, hn::Set(d, 33555)));
  } else {
    // Exact as floats. The nearest float to 1/125 is above it by 4.8 · 10⁻⁸ of its size, so a whole quotient stays at
    // least that; others are at least 1/125 below the next whole number, and the product is off by 0.0051 at most.
    const hn::RebindToSigned<D> di;
    const hn::RebindToFloat<D> df;
    const auto quotient = hn::Mul(hn::ConvertTo(df, hn::BitCast(di, v)), hn::Set(df, 0.008F));
    return hn::BitCast(d, hn::ConvertTo(di, quotient));
  }
}

struct Luma {
  template <class D, class V>
  HWY_INLINE V operator()(D d, V r, V g, V b, V) const {
    using T = hn::TFromD<D>;
    if constexpr (std::is_same_v<T, float>) {
      return hn::Add(hn::Add(hn::Mul(hn::Set(d, 0.299F), r), hn::Mul(hn::Set(d, 0.587F), g)),
                     hn::Mul(hn::Set(d, 0.114F), b));
    } else {
      // Even and odd pixels apart, in lanes twice as wide.
      constexpr int kBits = 8 * sizeof(T);
      const hn::RepartitionToWide<D> dw;
      const auto low = hn::Set(dw, std::numeric_limits<T>::max());
      const auto rw = hn::BitCast(dw, r);
      const auto gw = hn::BitCast(dw, g);
      const auto bw = hn::BitCast(dw, b);
      const auto even = over_125(dw, luma_eighths(dw, hn::And(rw, low), hn::And(gw, low), hn::And(bw, low)));
      const auto odd = over_125(
          dw, luma_eighths(dw, hn::ShiftRight<kBits>(rw), hn::ShiftRight<kBits>(gw), hn::ShiftRight<kBits>(bw)));
      return hn::BitCast(d, hn::Or(even, hn::ShiftLeft<kBits>(odd)));
    }
  }
};

template <class D, class V>
HWY_INLINE V luminance(D d, V r, V g, V b) {
  return hn::Add(hn::Add(hn::Mul(hn::Set(d, 0.2126F), r), hn::Mul(hn::Set(d, 0.7152F), g)),
                 hn::Mul(hn::Set(d, 0.0722F), b));
}

template <class DF, class V>
HWY_INLINE auto to_float(DF df, V v) {
  if constexpr (std::is_same_v<hn::TFromV<V>, float>) {
    return v;
  } else {
    return hn::ConvertTo(df, hn::PromoteTo(hn::RebindToSigned<DF>(), v));
  }
}

/// Rounded half up and saturated.
template <class D, class VF>
HWY_INLINE auto from_float(D d, VF v) {
  if constexpr (std::is_same_v<hn::TFromD<D>, float>) {
    return v;
  } else {
    const hn::RebindToFloat<hn::Rebind<std::int32_t, D>> df;
    const hn::RebindToSigned<decltype(df)> di;
    return hn::DemoteTo(d, hn::ConvertTo(di, hn::Add(v, hn::Set(df, 0.5F))));
  }
}

struct Luminance {
  template <class D, class V>
  HWY_INLINE V operator()(D d, V r, V g, V b, V) const {
    const hn::Rebind<float, D> df;
    return from_float(d, luminance(df, to_float(df, r), to_float(df, g), to_float(df, b)));
  }
};

struct LightLuminance {
  bool premultiplied;

  template <class D, class V>
  HWY_INLINE V operator()(D d, V r, V g, V b, V alpha) const {
    const hn::Rebind<float, D> df;
    const auto unit = premultiplied ? to_float(df, alpha) : hn::Set(df, full_range(kPixelTypeOf<hn::TFromD<D>>));
    const auto light = [&](V v) HWY_ATTR { return SrgbToLinear(df, hn::Div(to_float(df, v), unit)); };
    const auto gray = hn::Mul(LinearToSrgb(df, luminance(df, light(r), light(g), light(b))), unit);
    return from_float(d, hn::IfThenElse(hn::Eq(unit, hn::Zero(df)), hn::Zero(df), gray));
  }
};

/// The gray of a vector of pixels.
template <bool kAlpha, class D, class T, class Gray>
HWY_INLINE void gray_step(D d, const T* source, T* result, const Gray& gray) {
  hn::Vec<D> r, g, b;
  if constexpr (kAlpha) {
    hn::Vec<D> alpha;
    hn::LoadInterleaved4(d, source, r, g, b, alpha);
    hn::StoreInterleaved2(gray(d, r, g, b, alpha), alpha, d, result);
  } else {
    hn::LoadInterleaved3(d, source, r, g, b);
    hn::StoreU(gray(d, r, g, b, r), d, result);
  }
}

template <bool kAlpha, class D, class T, class Gray>
void gray_row(D d, const T* source, T* result, std::size_t count, const Gray& gray) {
  constexpr std::size_t kFrom = kAlpha ? 4 : 3;
  constexpr std::size_t kTo = kAlpha ? 2 : 1;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t x = 0;
  for (; x + lanes <= count; x += lanes) gray_step<kAlpha>(d, source + x * kFrom, result + x * kTo, gray);
  if (x < count) {
    HWY_ALIGN T from[HWY_MAX_BYTES / sizeof(T) * kFrom] = {};
    HWY_ALIGN T to[HWY_MAX_BYTES / sizeof(T) * kTo];
    std::memcpy(from, source + x * kFrom, (count - x) * kFrom * sizeof(T));
    gray_step<kAlpha>(d, from, to, gray);
    std::memcpy(result + x * kTo, to, (count - x) * kTo * sizeof(T));
  }
}

template <class D, class Gray>
void gray_rows(D d, const ConstAnyView& source, const AnyView& result, const Gray& gray) {
  using T = hn::TFromD<D>;
  const auto from = source.as<T>();
  const auto to = result.as<T>();
  const auto count = static_cast<std::size_t>(to.width);
  for (int y = 0; y < to.height; ++y) {
    if (from.channels == 4) {
      gray_row<true>(d, from.row(y), to.row(y), count, gray);
    } else {
      gray_row<false>(d, from.row(y), to.row(y), count, gray);
    }
  }
}

template <class T>
void gray_tile(const ConstAnyView& source, const AnyView& result, GrayRule rule) {
  const hn::ScalableTag<T> d;
  const hn::Rebind<T, hn::ScalableTag<float>> narrow;  // as many lanes as floats in a vector
  if (rule == GrayRule::Luma) {
    gray_rows(d, source, result, Luma{});
  } else if (rule == GrayRule::Luminance) {
    gray_rows(narrow, source, result, Luminance{});
  } else {
    gray_rows(narrow, source, result, LightLuminance{source.info.alpha == AlphaState::Premultiplied});
  }
}

void Grayscale(const ConstAnyView& source, const AnyView& result, GrayRule rule) {
  switch (source.info.type) {
    case PixelType::U8: return gray_tile<std::uint8_t>(source, result, rule);
    case PixelType::U16: return gray_tile<std::uint16_t>(source, result, rule);
    case PixelType::F32: return gray_tile<float>(source, result, rule);
  }
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(Grayscale);

void grayscale(const ConstAnyView& source, const AnyView& result, GrayRule rule) {
  HWY_DYNAMIC_DISPATCH(Grayscale)(source, result, rule);
}

}  // namespace azulejo::kernels
#endif
