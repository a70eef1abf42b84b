#include <algorithm>

#include "azulejo/rendering/draw_layer.h"
#include "azulejo/rendering/draw_paint.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "azulejo/rendering/draw_paint_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "azulejo/math/transfer_inl.h"

HWY_BEFORE_NAMESPACE();
namespace azulejo::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, kBlock>;
using VF = hn::Vec<F>;

HWY_INLINE VF constant(float value) { return hn::Set(F(), value); }

/// The offset at a point seen from the center of the first circle; NaN where no circle passes.
HWY_INLINE VF radial_offset(const GradientField& field, VF x, VF y) {
  const F f;
  const VF zero = hn::Zero(f);
  const VF nan = hn::NaN(f);
  const float dx = field.distance_x;
  const float dy = field.distance_y;
  const float square = dx * dx + dy * dy - field.growth * field.growth;
  const VF half =
      hn::Add(hn::Add(hn::Mul(x, constant(dx)), hn::Mul(y, constant(dy))), constant(field.radius * field.growth));
  const VF rest = hn::Sub(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), constant(field.radius * field.radius));
  const auto with_radius = [&](VF t) {
    const VF radius = hn::Add(constant(field.radius), hn::Mul(t, constant(field.growth)));
    return hn::Ge(radius, zero);
  };
  // The two circles touch inside: the equation is linear.
  if (std::abs(square) < 1e-6F) {
    const VF t = hn::Div(rest, hn::Mul(constant(2.0F), half));
    return hn::IfThenElse(with_radius(t), t, nan);
  }
  const VF inside = hn::Sub(hn::Mul(half, half), hn::Mul(constant(square), rest));
  const VF root = hn::Sqrt(hn::Max(inside, zero));
  const VF a = hn::Div(hn::Add(half, root), constant(square));
  const VF b = hn::Div(hn::Sub(half, root), constant(square));
  const VF larger = hn::Max(a, b);
  const VF smaller = hn::Min(a, b);
  const VF t = hn::IfThenElse(with_radius(larger), larger, hn::IfThenElse(with_radius(smaller), smaller, nan));
  return hn::IfThenElse(hn::Ge(inside, zero), t, nan);
}

HWY_INLINE VF spread_offset(GradientSpread spread, VF t) {
  const F f;
  const VF one = constant(1.0F);
  if (spread == GradientSpread::Repeat) {
    t = hn::Sub(t, hn::Floor(t));
  } else if (spread == GradientSpread::Reflect) {
    const VF folded = hn::Sub(t, hn::Mul(constant(2.0F), hn::Floor(hn::Mul(t, constant(0.5F)))));
    t = hn::Min(folded, hn::Sub(constant(2.0F), folded));
  }
  return hn::Min(hn::Max(t, hn::Zero(f)), one);
}

HWY_INLINE void color_pixels(const GradientField& field, VF offset, float* result) {
  const F f;
  const VF zero = hn::Zero(f);
  const auto known = hn::Eq(offset, offset);
  const VF t = spread_offset(field.spread, hn::IfThenElse(known, offset, zero));
  VF color[4];
  for (int c = 0; c < 4; ++c) color[c] = constant(field.first[c]);
  for (const GradientStep& step : field.steps) {
    const VF behind = hn::Sub(t, constant(step.offset));
    const VF part = step.scale > 0 ? hn::Min(hn::Max(hn::Mul(behind, constant(step.scale)), zero), constant(1.0F))
                                   : hn::IfThenElseZero(hn::Ge(behind, zero), constant(1.0F));
    for (int c = 0; c < 4; ++c) color[c] = hn::Add(color[c], hn::Mul(part, constant(step.change[c])));
  }
  const VF alpha = hn::IfThenElseZero(known, hn::Min(hn::Max(color[3], zero), constant(1.0F)));
  for (int c = 0; c < 3; ++c) {
    VF mixed = hn::Min(hn::Max(color[c], zero), constant(1.0F));
    if (field.linear) mixed = SrgbToLinear(f, mixed);
    hn::Store(hn::Mul(mixed, alpha), f, result + c * kBlock);
  }
  hn::Store(alpha, f, result + 3 * kBlock);
}

void GradientColors(const GradientField& field, int first, int last, int y, float* result) {
  const F f;
  const hn::RebindToSigned<F> i;
  const double row = y + 0.5;
  const auto at = [&](const std::array<double, 3>& line, int x, VF lane) {
    const double start = line[0] * (x + 0.5) + line[1] * row + line[2];
    return hn::Add(constant(static_cast<float>(start)), hn::Mul(lane, constant(static_cast<float>(line[0]))));
  };
  for (int block = first; block < last; ++block, result += kBlockFloats) {
    for (std::size_t x = 0; x < kBlock; x += hn::Lanes(f)) {
      // From the block's start: the same for all widths of vectors.
      const VF lane = hn::ConvertTo(f, hn::Iota(i, static_cast<std::int32_t>(x)));
      const VF along = at(field.along, block * kBlock, lane);
      const VF offset = field.radial ? radial_offset(field, at(field.across, block * kBlock, lane), along) : along;
      color_pixels(field, offset, result + x);
    }
  }
}

}  // namespace azulejo::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace azulejo::kernels {

HWY_EXPORT(GradientColors);

void gradient_colors(const GradientField& field, int first, int last, int y, float* result) {
  HWY_DYNAMIC_DISPATCH(GradientColors)(field, first, last, y, result);
}

}  // namespace azulejo::kernels
#endif
