#include "azulejo/imaging/color_space_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/imaging/color_space_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "azulejo/imaging/color_space_bytes_inl.h"
#include "azulejo/imaging/color_space_steps_inl.h"
#include "azulejo/imaging/stored_inl.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

using V = hn::Vec<FloatTag>;

constexpr std::size_t kAtOnce = 256;  // pixels: a multiple of all vectors' lanes; the planes stay in the cache

/// Pixels on their way from the source to the result.
template <class T>
struct Batch {
  const ColorPlan& plan;
  const T* source;
  T* result;
  int channels;
  std::size_t count;
  float* color;  ///< three planes, between two passes
  float* rest;   ///< of f32: 0, or NaN for a pixel that isn't finite
};

/// A pass over a batch: the first also loads, the last also rounds.
struct Pass {
  bool first;
  bool last;
};

/// A vector of stored values is as many vectors of floats: the parts, one of each lane's values from low to high bits.
template <class T>
constexpr std::size_t kParts = sizeof(float) / sizeof(T);

template <class T>
using Stored = hn::Vec<hn::ScalableTag<T>>;

/// The part as f32.
template <class T>
HWY_INLINE V PartOf(Stored<T> stored, std::size_t part) {
  if constexpr (std::is_same_v<T, float>) {
    return stored;
  } else {
    const hn::ScalableTag<std::uint32_t> du;
    const auto bits = hn::ShiftRightSame(hn::BitCast(du, stored), static_cast<int>(part * 8 * sizeof(T)));
    const auto value = hn::And(bits, hn::Set(du, std::numeric_limits<T>::max()));
    return hn::ConvertTo(FloatTag(), hn::BitCast(WholeTag(), value));
  }
}

/// Parts, rounded, as stored.
template <class T>
HWY_INLINE Stored<T> Joined(const V (&parts)[kParts<T>]) {
  if constexpr (std::is_same_v<T, float>) {
    return parts[0];
  } else {
    auto bits = Rounded<T>(parts[0]);
    for (std::size_t k = 1; k < kParts<T>; ++k) {
      bits = hn::Or(bits, hn::ShiftLeftSame(Rounded<T>(parts[k]), static_cast<int>(k * 8 * sizeof(T))));
    }
    return hn::BitCast(hn::ScalableTag<T>(), bits);
  }
}

/// The colors of pixels in parts.
template <class T>
struct Colors {
  V c0[kParts<T>];
  V c1[kParts<T>];
  V c2[kParts<T>];
};

/// What the first step gets of a part.
template <class T>
HWY_INLINE void Prepare(const Batch<T>& batch, V alpha, float* rest_of, V& c0, V& c1, V& c2) {
  const FloatTag d;
  if (batch.plan.premultiplied) {
    const auto hidden = hn::Eq(alpha, hn::Zero(d));
    c0 = hn::IfThenZeroElse(hidden, hn::Div(c0, alpha));
    c1 = hn::IfThenZeroElse(hidden, hn::Div(c1, alpha));
    c2 = hn::IfThenZeroElse(hidden, hn::Div(c2, alpha));
  }
  if (batch.plan.load_scale != 1.0F) {
    const V scale = hn::Set(d, batch.plan.load_scale);
    c0 = hn::Mul(c0, scale);
    c1 = hn::Mul(c1, scale);
    c2 = hn::Mul(c2, scale);
  }
  if constexpr (std::is_same_v<T, float>) {
    const V rest = hn::Add(hn::Add(hn::Sub(c0, c0), hn::Sub(c1, c1)), hn::Sub(c2, c2));
    hn::Store(rest, d, rest_of);
    const auto finite = hn::Eq(rest, hn::Zero(d));
    c0 = hn::IfThenElseZero(finite, c0);
    c1 = hn::IfThenElseZero(finite, c1);
    c2 = hn::IfThenElseZero(finite, c2);
  }
}

template <class T>
HWY_INLINE void Load(const Batch<T>& batch, std::size_t i, Colors<T>& colors) {
  const hn::ScalableTag<T> d;
  Stored<T> t0, t1, t2, alpha;
  if (batch.channels == 4) {
    hn::LoadInterleaved4(d, batch.source + 4 * i, t0, t1, t2, alpha);
  } else {
    hn::LoadInterleaved3(d, batch.source + 3 * i, t0, t1, t2);
    alpha = t2;
  }
  for (std::size_t k = 0; k < kParts<T>; ++k) {
    colors.c0[k] = PartOf<T>(t0, k);
    colors.c1[k] = PartOf<T>(t1, k);
    colors.c2[k] = PartOf<T>(t2, k);
    Prepare(batch, PartOf<T>(alpha, k), batch.rest + i, colors.c0[k], colors.c1[k], colors.c2[k]);
  }
}

/// What is stored of what the last step gave of a part, before rounding.
template <class T>
HWY_INLINE void Finish(const Batch<T>& batch, V alpha, const float* rest_of, V& c0, V& c1, V& c2) {
  const FloatTag d;
  if (batch.plan.store_scale != 1.0F) {
    const V scale = hn::Set(d, batch.plan.store_scale);
    c0 = hn::Mul(c0, scale);
    c1 = hn::Mul(c1, scale);
    c2 = hn::Mul(c2, scale);
  }
  if (batch.plan.premultiplied) {
    const auto hidden = hn::Eq(alpha, hn::Zero(d));
    c0 = hn::IfThenZeroElse(hidden, hn::Mul(c0, alpha));
    c1 = hn::IfThenZeroElse(hidden, hn::Mul(c1, alpha));
    c2 = hn::IfThenZeroElse(hidden, hn::Mul(c2, alpha));
  }
  if constexpr (std::is_same_v<T, float>) {
    const V rest = hn::Load(d, rest_of);
    c0 = hn::Add(c0, rest);
    c1 = hn::Add(c1, rest);
    c2 = hn::Add(c2, rest);
  }
}

template <class T>
HWY_INLINE void Store(const Batch<T>& batch, std::size_t i, Colors<T>& colors) {
  const hn::ScalableTag<T> d;
  Stored<T> alpha = hn::Zero(d);
  if (batch.channels == 4) {
    Stored<T> t0, t1, t2;
    hn::LoadInterleaved4(d, batch.source + 4 * i, t0, t1, t2, alpha);
  }
  for (std::size_t k = 0; k < kParts<T>; ++k) {
    Finish(batch, PartOf<T>(alpha, k), batch.rest + i, colors.c0[k], colors.c1[k], colors.c2[k]);
  }
  const Stored<T> t0 = Joined<T>(colors.c0);
  const Stored<T> t1 = Joined<T>(colors.c1);
  const Stored<T> t2 = Joined<T>(colors.c2);
  if (batch.channels == 4) {
    hn::StoreInterleaved4(t0, t1, t2, alpha, d, batch.result + 4 * i);
  } else {
    hn::StoreInterleaved3(t0, t1, t2, d, batch.result + 3 * i);
  }
}

template <class T, class Step>
HWY_INLINE void ForPixels(const Batch<T>& batch, Pass pass, const Step& step) {
  const FloatTag d;
  const std::size_t lanes = hn::Lanes(d);
  Colors<T> colors;
  for (std::size_t i = 0; i < batch.count; i += kParts<T> * lanes) {
    if (pass.first) Load(batch, i, colors);
    for (std::size_t k = 0; k < kParts<T>; ++k) {
      float* const plane = batch.color + i + k * lanes;
      if (!pass.first) {
        colors.c0[k] = hn::Load(d, plane);
        colors.c1[k] = hn::Load(d, plane + kAtOnce);
        colors.c2[k] = hn::Load(d, plane + 2 * kAtOnce);
      }
      step(colors.c0[k], colors.c1[k], colors.c2[k]);
      if (!pass.last) {
        hn::Store(colors.c0[k], d, plane);
        hn::Store(colors.c1[k], d, plane + kAtOnce);
        hn::Store(colors.c2[k], d, plane + 2 * kAtOnce);
      }
    }
    if (pass.last) Store(batch, i, colors);
  }
}

/// Two steps in one pass.
template <class First, class Second>
struct Both {
  First first;
  Second second;
  HWY_INLINE void operator()(V& c0, V& c1, V& c2) const {
    first(c0, c1, c2);
    second(c0, c1, c2);
  }
};

struct DecodeRgb {
  float full;
  HWY_INLINE void operator()(V& c0, V& c1, V& c2) const {
    const FloatTag d;
    const V top = hn::Set(d, full);
    c0 = SrgbToLinear(d, hn::Div(c0, top));
    c1 = SrgbToLinear(d, hn::Div(c1, top));
    c2 = SrgbToLinear(d, hn::Div(c2, top));
  }
};

struct EncodeRgb {
  float full;
  HWY_INLINE void operator()(V& c0, V& c1, V& c2) const {
    const FloatTag d;
    const V top = hn::Set(d, full);
    c0 = hn::Mul(LinearToSrgb(d, c0), top);
    c1 = hn::Mul(LinearToSrgb(d, c1), top);
    c2 = hn::Mul(LinearToSrgb(d, c2), top);
  }
};

struct EncodeBytes {
  const ByteCurve& curve;
  HWY_INLINE void operator()(V& c0, V& c1, V& c2) const {
    c0 = hn::ConvertTo(FloatTag(), EncodeByte(curve, c0));
    c1 = hn::ConvertTo(FloatTag(), EncodeByte(curve, c1));
    c2 = hn::ConvertTo(FloatTag(), EncodeByte(curve, c2));
  }
};

/// Of whole numbers up to 255.
struct DecodeRgbBytes {
  DecodeBytes decode;
  HWY_INLINE void operator()(V& c0, V& c1, V& c2) const {
    c0 = decode(Truncated(c0));
    c1 = decode(Truncated(c1));
    c2 = decode(Truncated(c2));
  }
};

template <class T>
void ApplyCurve(bool decode, const Batch<T>& batch, Pass pass) {
  const ColorPlan& plan = batch.plan;
  if constexpr (sizeof(T) == 1) {
    if (decode && plan.bytes_in) return ForPixels(batch, pass, DecodeRgbBytes{DecodeBytes(byte_curve())});
    if (!decode && plan.bytes_out) return ForPixels(batch, pass, EncodeBytes{byte_curve()});
  }
  if (decode) return ForPixels(batch, pass, DecodeRgb{plan.full});
  ForPixels(batch, pass, EncodeRgb{plan.full});
}

/// A pass of `up` or of `down`.
template <class T, class Up, class Down>
HWY_INLINE void EitherWay(bool is_up, const Batch<T>& batch, Pass pass, const Up& up, const Down& down) {
  if (is_up) {
    ForPixels(batch, pass, up);
  } else {
    ForPixels(batch, pass, down);
  }
}

template <class T>
void ApplyStep(const ColorStep& step, const Batch<T>& batch, Pass pass) {
  const bool up = step.to_parent;
  const ColorPlan& plan = batch.plan;
  switch (step.space) {
    case ColorSpace::Linear: return;
    case ColorSpace::Srgb: return ApplyCurve(up, batch, pass);
    case ColorSpace::Hsv: return EitherWay(up, batch, pass, RgbOfHsv{plan.full}, HsvOfRgb{plan.full});
    case ColorSpace::Hsl: return EitherWay(up, batch, pass, RgbOfHsl{plan.full}, HslOfRgb{plan.full});
    case ColorSpace::Ycbcr: return EitherWay(up, batch, pass, RgbOfYcbcr{plan.center}, YcbcrOfRgb{plan.center});
    case ColorSpace::Xyz: return EitherWay(up, batch, pass, Product{color::kRgbOfXyz}, Product{color::kXyzOfRgb});
    case ColorSpace::Lab: return EitherWay(up, batch, pass, XyzOfLab{}, LabOfXyz{});
    case ColorSpace::Lch: return EitherWay(up, batch, pass, LabOfLch{}, LchOfLab{});
  }
}

/// A step from sRGB, of bytes, by itself.
template <class Step>
HWY_INLINE void ForBytes(const Batch<std::uint8_t>& batch, const Step& step) {
  const ByteTag d;
  for (std::size_t i = 0; i < batch.count; i += hn::Lanes(d)) {
    Bytes c0, c1, c2, alpha;
    if (batch.channels == 4) {
      hn::LoadInterleaved4(d, batch.source + 4 * i, c0, c1, c2, alpha);
      step(c0, c1, c2);
      hn::StoreInterleaved4(c0, c1, c2, alpha, d, batch.result + 4 * i);
    } else {
      hn::LoadInterleaved3(d, batch.source + 3 * i, c0, c1, c2);
      step(c0, c1, c2);
      hn::StoreInterleaved3(c0, c1, c2, d, batch.result + 3 * i);
    }
  }
}

/// True if it was all that there is to do, and is done.
bool ApplyToBytes(const Batch<std::uint8_t>& batch) {
  const auto steps = batch.plan.steps();
  if (steps.size() != 1 || steps[0].to_parent || batch.plan.premultiplied) return false;
  switch (steps[0].space) {
    case ColorSpace::Hsv: ForBytes(batch, HsvOfBytes{}); return true;
    case ColorSpace::Hsl: ForBytes(batch, HslOfBytes{}); return true;
    case ColorSpace::Ycbcr: ForBytes(batch, YcbcrOfBytes{}); return true;
    default: return false;
  }
}

/// Between light and Lab, two steps are one pass.
bool AreOnePass(const ColorStep& step, const ColorStep& next) {
  if (step.to_parent) return step.space == ColorSpace::Lab && next.space == ColorSpace::Xyz;
  return step.space == ColorSpace::Xyz && next.space == ColorSpace::Lab;
}

template <class T>
void ConvertBatch(const Batch<T>& batch) {
  if constexpr (sizeof(T) == 1) {
    if (ApplyToBytes(batch)) return;
  }
  const auto steps = batch.plan.steps();
  for (std::size_t s = 0; s < steps.size(); ++s) {
    const bool two = s + 1 < steps.size() && AreOnePass(steps[s], steps[s + 1]);
    const Pass pass{s == 0, s + (two ? 2 : 1) == steps.size()};
    if (two) {
      EitherWay(steps[s].to_parent, batch, pass, Both<XyzOfLab, Product>{{}, {color::kRgbOfXyz}},
                Both<Product, LabOfXyz>{{color::kXyzOfRgb}, {}});
      ++s;
    } else {
      ApplyStep(steps[s], batch, pass);
    }
  }
}

template <class T>
void ConvertTile(const ImageView<const T>& source, const ImageView<T>& result, const ColorPlan& plan) {
  HWY_ALIGN float color[3 * kAtOnce];
  HWY_ALIGN float rest[kAtOnce];
  HWY_ALIGN T last[4 * HWY_MAX_BYTES / sizeof(T)] = {};
  const std::size_t lanes = hn::Lanes(hn::ScalableTag<T>());
  const auto channels = static_cast<std::size_t>(result.channels);
  const auto width = static_cast<std::size_t>(result.width);
  for (int y = 0; y < result.height; ++y) {
    const T* const from = source.row(y);
    T* const to = result.row(y);
    std::size_t x = 0;
    while (width - x >= lanes) {
      const std::size_t count = std::min(kAtOnce, (width - x) / lanes * lanes);
      ConvertBatch(Batch<T>{plan, from + x * channels, to + x * channels, result.channels, count, color, rest});
      x += count;
    }
    if (x == width) continue;
    const std::size_t bytes = (width - x) * channels * sizeof(T);
    std::memcpy(last, from + x * channels, bytes);
    ConvertBatch(Batch<T>{plan, last, last, result.channels, lanes, color, rest});
    std::memcpy(to + x * channels, last, bytes);
  }
}

void ConvertColors(const ConstAnyView& source, const AnyView& result, const ColorPlan& plan) {
  switch (result.info.type) {
    case PixelType::U8: return ConvertTile<std::uint8_t>(source.as<std::uint8_t>(), result.as<std::uint8_t>(), plan);
    case PixelType::U16:
      return ConvertTile<std::uint16_t>(source.as<std::uint16_t>(), result.as<std::uint16_t>(), plan);
    case PixelType::F32: return ConvertTile<float>(source.as<float>(), result.as<float>(), plan);
  }
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(ConvertColors);

void color_space(const ConstAnyView& source, const AnyView& result, const ColorPlan& plan) {
  HWY_DYNAMIC_DISPATCH(ConvertColors)(source, result, plan);
}

}  // namespace azulejo::kernels
#endif
