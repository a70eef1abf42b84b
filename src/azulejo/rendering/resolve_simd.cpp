#include "azulejo/rendering/resolve.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/rendering/resolve_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "azulejo/math/transfer_inl.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;

struct Pixels {
  V channel[4];
};

HWY_INLINE Pixels blended(const glm::vec4* colors, const Resolve& resolve) {
  const D d;
  Pixels p;
  hn::LoadInterleaved4(d, &colors->x, p.channel[0], p.channel[1], p.channel[2], p.channel[3]);
  const V exposure = hn::Set(d, resolve.exposure);
  const V through = hn::Sub(hn::Set(d, 1.0F), p.channel[3]);
  for (int c = 0; c < 4; ++c) {
    const V drawn = c < 3 ? hn::Mul(p.channel[c], exposure) : p.channel[c];
    p.channel[c] = hn::MulAdd(hn::Set(d, resolve.background[c]), through, drawn);
  }
  return p;
}

/// x^(1/4) of x > 0 by two reciprocal square roots, each refined once.
HWY_INLINE V fourth_root(V x) {
  const D d;
  const auto square_root = [&](V v) HWY_ATTR {
    const V guess = hn::ApproximateReciprocalSqrt(v);
    const V half = hn::Mul(hn::Mul(v, hn::Set(d, 0.5F)), guess);
    const V refined = hn::Mul(guess, hn::NegMulAdd(half, guess, hn::Set(d, 1.5F)));
    return hn::Mul(v, refined);
  };
  return square_root(square_root(x));
}

/// sRGB of linear light in [0, 1], within 5·10⁻⁵: 1.055 q^(5/3) − 0.055 with q = x^(1/4), interpolated to the fourth
/// power at Chebyshev's nodes.
HWY_INLINE V quick_srgb(V x) {
  const D d;
  const V q = fourth_root(hn::Max(x, hn::Set(d, 0.001F)));
  V sum = hn::Set(d, 0.0764924975F);
  sum = hn::MulAdd(sum, q, hn::Set(d, -0.323431682F));
  sum = hn::MulAdd(sum, q, hn::Set(d, 1.11208961F));
  sum = hn::MulAdd(sum, q, hn::Set(d, 0.199953621F));
  sum = hn::MulAdd(sum, q, hn::Set(d, -0.0650813091F));
  return hn::IfThenElse(hn::Gt(x, hn::Set(d, 0.0031308F)), sum, hn::Mul(x, hn::Set(d, 12.92F)));
}

/// sRGB and straight, scaled to the full range and rounded.
HWY_INLINE hn::Vec<hn::RebindToSigned<D>> encoded(V straight, PixelType type) {
  const D d;
  // NaN becomes 0 here too.
  const V inside = hn::Min(hn::Max(straight, hn::Zero(d)), hn::Set(d, 1.0F));
  const V stored = hn::Min(type == PixelType::U8 ? quick_srgb(inside) : LinearToSrgb(d, inside), hn::Set(d, 1.0F));
  const V full = hn::Set(d, full_range(type));
  return hn::ConvertTo(hn::RebindToSigned<D>(), hn::MulAdd(stored, full, hn::Set(d, 0.5F)));
}

/// Lanes of pixels, of which `here` are written.
HWY_INLINE void resolve_lanes(const glm::vec4* from, std::size_t here, const Resolve& resolve, PixelType type,
                              std::byte* result) {
  const D d;
  const hn::RebindToSigned<D> di;
  const std::size_t n = hn::Lanes(d);
  const Pixels p = blended(from, resolve);
  if (type == PixelType::F32) {
    HWY_ALIGN float floats[64];
    hn::StoreInterleaved4(p.channel[0], p.channel[1], p.channel[2], p.channel[3], d, floats);
    std::copy_n(reinterpret_cast<const std::byte*>(floats), 16 * here, result);
    return;
  }
  const V one = hn::Set(d, 1.0F);
  const V alpha = hn::Min(p.channel[3], one);
  V inverse = one;
  if (!hn::AllTrue(d, hn::Eq(alpha, one))) {
    inverse = hn::IfThenElseZero(hn::Gt(alpha, hn::Zero(d)), hn::Div(one, alpha));
  }
  const auto r = encoded(hn::Mul(p.channel[0], inverse), type);
  const auto g = encoded(hn::Mul(p.channel[1], inverse), type);
  const auto b = encoded(hn::Mul(p.channel[2], inverse), type);
  const V full = hn::Set(d, full_range(type));
  const auto a = hn::ConvertTo(di, hn::MulAdd(hn::Max(alpha, hn::Zero(d)), full, hn::Set(d, 0.5F)));
  HWY_ALIGN std::int32_t packed[32];
  if (type == PixelType::U8) {
    const auto rg = hn::Or(r, hn::ShiftLeft<8>(g));
    const auto ba = hn::Or(hn::ShiftLeft<16>(b), hn::ShiftLeft<24>(a));
    hn::Store(hn::Or(rg, ba), di, packed);
    std::copy_n(reinterpret_cast<const std::byte*>(packed), 4 * here, result);
    return;
  }
  hn::Store(hn::Or(r, hn::ShiftLeft<16>(g)), di, packed);
  hn::Store(hn::Or(b, hn::ShiftLeft<16>(a)), di, packed + n);
  for (std::size_t i = 0; i < here; ++i, result += 8) {
    std::copy_n(reinterpret_cast<const std::byte*>(packed + i), 4, result);
    std::copy_n(reinterpret_cast<const std::byte*>(packed + n + i), 4, result + 4);
  }
}

/// Nothing was drawn on any lane.
HWY_INLINE bool all_zero(const glm::vec4* from) {
  const D d;
  const std::size_t n = hn::Lanes(d);
  const float* values = &from->x;
  const V any = hn::Or(hn::Or(hn::Load(d, values), hn::Load(d, values + n)),
                       hn::Or(hn::Load(d, values + 2 * n), hn::Load(d, values + 3 * n)));
  return hn::AllTrue(d, hn::Eq(any, hn::Zero(d)));
}

void ResolvePixels(const glm::vec4* colors, std::size_t stride, const Resolve& resolve, const AnyView& result) {
  const std::size_t n = hn::Lanes(D());
  const PixelType type = result.info.type;
  const std::size_t pixel_bytes = result.info.pixel_bytes();
  HWY_ALIGN glm::vec4 padded[16] = {};
  HWY_ALIGN std::byte nothing[16 * 16];
  resolve_lanes(padded, n, resolve, type, nothing);
  for (int y = 0; y < result.height(); ++y, colors += stride) {
    std::byte* to = result.row(y);
    const auto count = static_cast<std::size_t>(result.width());
    for (std::size_t x = 0; x < count; x += n, to += n * pixel_bytes) {
      const glm::vec4* from = colors + x;
      const std::size_t here = std::min(n, count - x);
      if (here < n) {
        std::copy(from, from + here, padded);
        std::fill(padded + here, padded + n, glm::vec4(0));
        from = padded;
      }
      if (all_zero(from)) {
        std::copy_n(nothing, here * pixel_bytes, to);
      } else {
        resolve_lanes(from, here, resolve, type, to);
      }
    }
  }
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(ResolvePixels);

void resolve_pixels(const glm::vec4* colors, std::size_t stride, const Resolve& resolve, const AnyView& result) {
  HWY_DYNAMIC_DISPATCH(ResolvePixels)(colors, stride, resolve, result);
}

}  // namespace azulejo::kernels
#endif
