#include <cstring>

#include "azulejo/imaging/color_mapping.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/pseudo_color_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "azulejo/imaging/stored_inl.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

using V = hn::Vec<FloatTag>;

struct Colors {
  V r, g, b;
};

/// ColorMapping::at
HWY_INLINE Colors ColorsAt(const ColorMapping& mapping, V value) {
  const FloatTag d;
  const V one = hn::Set(d, 1.0F);
  const V share = hn::Mul(hn::Sub(value, hn::Set(d, mapping.low)), hn::Set(d, mapping.scale));
  V t = hn::IfThenElseZero(hn::Gt(share, hn::Zero(d)), hn::Min(share, one));
  if (mapping.levels > 0) {
    const V bands = hn::Set(d, static_cast<float>(mapping.levels));
    t = hn::Div(hn::Min(hn::Floor(hn::Mul(t, bands)), hn::Sub(bands, one)), hn::Sub(bands, one));
  }
  const V place = hn::Mul(t, hn::Set(d, static_cast<float>(mapping.segments)));
  const auto segment = hn::Min(Truncated(place), hn::Set(WholeTag(), mapping.segments - 1));
  const V rest = hn::Sub(place, hn::ConvertTo(d, segment));
  const auto missing = hn::IsNaN(value);
  const auto channel = [&](std::size_t c) HWY_ATTR {
    const V start = hn::GatherIndex(d, mapping.start[c], segment);
    const V slope = hn::GatherIndex(d, mapping.slope[c], segment);
    return hn::IfThenElse(missing, hn::Set(d, mapping.nan[c]), hn::Add(start, hn::Mul(slope, rest)));
  };
  return {channel(0), channel(1), channel(2)};
}

/// As many pixels as a vector of floats has lanes.
template <class T>
HWY_INLINE void MapGray(const ColorMapping& mapping, const T* source, T* result) {
  const FloatTag d;
  const V full = hn::Set(d, full_range(kPixelTypeOf<T>));
  const Colors colors = ColorsAt(mapping, hn::Div(LoadStored(source), full));
  hn::StoreInterleaved3(Narrowed<T>(hn::Mul(colors.r, full)), Narrowed<T>(hn::Mul(colors.g, full)),
                        Narrowed<T>(hn::Mul(colors.b, full)), hn::Rebind<T, FloatTag>(), result);
}

template <class T>
HWY_INLINE void MapGrayAlpha(const ColorMapping& mapping, bool premultiplied, const T* source, T* result) {
  const FloatTag d;
  const hn::Rebind<T, FloatTag> dt;
  hn::Vec<decltype(dt)> gray, alpha;
  hn::LoadInterleaved2(dt, source, gray, alpha);
  const V whole = premultiplied ? Widened(alpha) : hn::Set(d, full_range(kPixelTypeOf<T>));
  const auto hidden = hn::Eq(whole, hn::Zero(d));
  const Colors colors = ColorsAt(mapping, hn::Div(Widened(gray), whole));
  const auto stored = [&](V color) HWY_ATTR { return Narrowed<T>(hn::IfThenZeroElse(hidden, hn::Mul(color, whole))); };
  hn::StoreInterleaved4(stored(colors.r), stored(colors.g), stored(colors.b), alpha, dt, result);
}

/// Calls f for whole vectors of pixels, and for the rest through a buffer.
template <int kFrom, int kTo, class T, class F>
HWY_INLINE void ForVectorsOfPixels(const ConstAnyView& source, const AnyView& result, F f) {
  const std::size_t lanes = hn::Lanes(FloatTag());
  HWY_ALIGN T from[kFrom * HWY_MAX_BYTES / sizeof(float)] = {};
  HWY_ALIGN T to[kTo * HWY_MAX_BYTES / sizeof(float)];
  const auto width = static_cast<std::size_t>(result.info.width);
  for (int y = 0; y < result.info.height; ++y) {
    const T* const row = source.as<T>().row(y);
    T* const result_row = result.as<T>().row(y);
    std::size_t x = 0;
    for (; x + lanes <= width; x += lanes) f(row + kFrom * x, result_row + kTo * x);
    if (x == width) continue;
    std::memcpy(from, row + kFrom * x, kFrom * (width - x) * sizeof(T));
    f(from, to);
    std::memcpy(result_row + kTo * x, to, kTo * (width - x) * sizeof(T));
  }
}

void PseudoColor(const ConstAnyView& source, const AnyView& result, const ColorMapping& mapping) {
  visit_type(result.info.type, [&](auto zero) HWY_ATTR {
    using T = decltype(zero);
    if (source.info.channels == 1) {
      return ForVectorsOfPixels<1, 3, T>(source, result,
                                         [&](const T* from, T* to) HWY_ATTR { MapGray(mapping, from, to); });
    }
    const bool premultiplied = source.info.alpha == AlphaState::Premultiplied;
    ForVectorsOfPixels<2, 4, T>(source, result,
                                [&](const T* from, T* to) HWY_ATTR { MapGrayAlpha(mapping, premultiplied, from, to); });
  });
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(PseudoColor);

void pseudo_color(const ConstAnyView& source, const AnyView& result, const ColorMapping& mapping) {
  HWY_DYNAMIC_DISPATCH(PseudoColor)(source, result, mapping);
}

}  // namespace azulejo::kernels
#endif
