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

/// sRGB and straight, scaled to `full` and rounded.
template <class DI>
HWY_INLINE hn::Vec<DI> encoded(DI, V value, V inverse_alpha, float full) {
  const D d;
  // NaN becomes 0 here too.
  const V straight = hn::Min(hn::Max(hn::Mul(value, inverse_alpha), hn::Zero(d)), hn::Set(d, 1.0F));
  const V stored = LinearToSrgb(d, straight);
  return hn::ConvertTo(DI(), hn::MulAdd(hn::Min(stored, hn::Set(d, 1.0F)), hn::Set(d, full), hn::Set(d, 0.5F)));
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
  const float full = type == PixelType::U8 ? 255.0F : 65535.0F;
  const V alpha = hn::Min(p.channel[3], hn::Set(d, 1.0F));
  const V inverse = hn::IfThenElseZero(hn::Gt(alpha, hn::Zero(d)), hn::Div(hn::Set(d, 1.0F), alpha));
  const auto r = encoded(di, p.channel[0], inverse, full);
  const auto g = encoded(di, p.channel[1], inverse, full);
  const auto b = encoded(di, p.channel[2], inverse, full);
  const auto a = hn::ConvertTo(di, hn::MulAdd(hn::Max(alpha, hn::Zero(d)), hn::Set(d, full), hn::Set(d, 0.5F)));
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
  V r, g, b, a;
  hn::LoadInterleaved4(d, &from->x, r, g, b, a);
  const V zero = hn::Zero(d);
  return hn::AllTrue(d, hn::And(hn::And(hn::Eq(r, zero), hn::Eq(g, zero)), hn::And(hn::Eq(b, zero), hn::Eq(a, zero))));
}

void ResolveRow(const glm::vec4* colors, std::size_t count, const Resolve& resolve, PixelType type, std::byte* result) {
  const std::size_t n = hn::Lanes(D());
  const std::size_t pixel_bytes = 4 * size_of(type);
  HWY_ALIGN glm::vec4 padded[16];
  HWY_ALIGN std::byte nothing[16 * 16];
  bool nothing_known = false;  ///< what lanes of background alone become, computed where it is first wanted
  for (std::size_t x = 0; x < count; x += n) {
    const glm::vec4* from = colors + x;
    const std::size_t here = std::min(n, count - x);
    if (here < n) {
      std::copy(from, from + here, padded);
      std::fill(padded + here, padded + n, glm::vec4(0));
      from = padded;
    }
    const bool untouched = all_zero(from);
    if (untouched && nothing_known) {
      std::copy_n(nothing, here * pixel_bytes, result + x * pixel_bytes);
      continue;
    }
    resolve_lanes(from, here, resolve, type, result + x * pixel_bytes);
    if (untouched && here == n) {
      std::copy_n(result + x * pixel_bytes, n * pixel_bytes, nothing);
      nothing_known = true;
    }
  }
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(ResolveRow);

void resolve_row(const glm::vec4* colors, std::size_t count, const Resolve& resolve, PixelType type,
                 std::byte* result) {
  HWY_DYNAMIC_DISPATCH(ResolveRow)(colors, count, resolve, type, result);
}

}  // namespace azulejo::kernels
#endif
