#include "azulejo/imaging/color_space_steps.h"

#include "azulejo/imaging/rows.h"

namespace azulejo {
namespace {

using color::Pixel;

ColorSpace parent(ColorSpace space) {
  switch (space) {
    case ColorSpace::Lch: return ColorSpace::Lab;
    case ColorSpace::Lab: return ColorSpace::Xyz;
    case ColorSpace::Xyz:
    case ColorSpace::Srgb: return ColorSpace::Linear;
    default: return ColorSpace::Srgb;
  }
}

int depth(ColorSpace space) { return space == ColorSpace::Linear ? 0 : depth(parent(space)) + 1; }

struct Extremes {
  explicit Extremes(const Pixel& p) {
    const float high = p.c0 > p.c1 ? p.c0 : p.c1;
    const float low = p.c0 < p.c1 ? p.c0 : p.c1;
    largest = high > p.c2 ? high : p.c2;
    smallest = low < p.c2 ? low : p.c2;
    range = largest - smallest;
  }
  float largest;
  float smallest;
  float range;
};

float hue_of(const Pixel& p, const Extremes& of, float full) {
  if (of.range == 0) return 0;
  const bool is_red = p.c0 == of.largest;
  const bool is_green = p.c1 == of.largest;
  const float difference = is_red ? p.c1 - p.c2 : is_green ? p.c2 - p.c0 : p.c0 - p.c1;
  const float corner = is_red ? (difference < 0 ? 6.0F : 0.0F) : is_green ? 2.0F : 4.0F;
  return (full * (difference + corner * of.range)) / (6.0F * of.range);
}

Pixel hsv_of_rgb(const Pixel& p, float full) {
  const Extremes of(p);
  return {hue_of(p, of, full), of.largest == 0 ? 0 : (full * of.range) / of.largest, of.largest};
}

Pixel hsl_of_rgb(const Pixel& p, float full) {
  const Extremes of(p);
  const float sum = of.largest + of.smallest;
  const float width = full - std::fabs(sum - full);
  return {hue_of(p, of, full), width == 0 ? 0 : (full * of.range) / width, 0.5F * sum};
}

/// The hue in sixths of a turn, 0–6.
float sixths(float hue, float full) {
  const float turns = hue / full;
  return 6.0F * (turns - std::floor(turns));
}

/// 0–1: how far the hue, in sixths of a turn, is from `ahead` sixths before it, a trapezoid.
float trapezoid(float hue, float ahead) {
  const float sum = hue + ahead;
  const float k = sum >= 6.0F ? sum - 6.0F : sum;
  const float rest = 4.0F - k;
  const float edge = k < rest ? k : rest;
  return edge > 0.0F ? (edge < 1.0F ? edge : 1.0F) : 0.0F;
}

Pixel rgb_of_hsv(const Pixel& p, float full) {
  const float hue = sixths(p.c0, full);
  const float range = (p.c2 * p.c1) / full;
  return {p.c2 - range * trapezoid(hue, 5), p.c2 - range * trapezoid(hue, 3), p.c2 - range * trapezoid(hue, 1)};
}

Pixel rgb_of_hsl(const Pixel& p, float full) {
  const float hue = sixths(p.c0, full);
  const float rest = full - p.c2;
  const float half = (p.c1 * (p.c2 < rest ? p.c2 : rest)) / full;
  const float high = p.c2 + half;
  const float range = 2.0F * half;
  return {high - range * trapezoid(hue, 5), high - range * trapezoid(hue, 3), high - range * trapezoid(hue, 1)};
}

Pixel ycbcr_of_rgb(const Pixel& p, float center) {
  const float red = 299.0F * p.c0;
  const float green = 587.0F * p.c1;
  const float blue = 114.0F * p.c2;
  return {(red + green + blue) * color::kPer1000, (1772.0F * center + 886.0F * p.c2 - red - green) * color::kPer1772,
          (1402.0F * center + 701.0F * p.c0 - green - blue) * color::kPer1402};
}

Pixel rgb_of_ycbcr(const Pixel& p, float center) {
  const float cb = p.c1 - center;
  const float cr = p.c2 - center;
  return {p.c0 + 1.402F * cr, p.c0 - 0.344136286F * cb - 0.714136286F * cr, p.c0 + 1.772F * cb};
}

Pixel product(const float (&m)[3][3], const Pixel& p) {
  return {m[0][0] * p.c0 + m[0][1] * p.c1 + m[0][2] * p.c2, m[1][0] * p.c0 + m[1][1] * p.c1 + m[1][2] * p.c2,
          m[2][0] * p.c0 + m[2][1] * p.c1 + m[2][2] * p.c2};
}

float lab_curve(float x) {
  return x > color::kLabKnee ? cbrt_deterministic(x) : color::kLabSlope * x + color::kLabOffset;
}

float lab_curve_back(float f) {
  return f > color::kLabKneeRoot ? (f * f) * f : (f - color::kLabOffset) * (1.0F / color::kLabSlope);
}

Pixel lab_of_xyz(const Pixel& p) {
  const float x = lab_curve(p.c0);
  const float y = lab_curve(p.c1);
  const float z = lab_curve(p.c2);
  return {1.16F * y - 0.16F, color::kAbScale * (x - y) + color::kCenter, color::kBScale * (y - z) + color::kCenter};
}

Pixel xyz_of_lab(const Pixel& p) {
  const float y = (p.c0 + 0.16F) * (1.0F / 1.16F);
  const float x = y + (p.c1 - color::kCenter) * (1.0F / color::kAbScale);
  const float z = y - (p.c2 - color::kCenter) * (1.0F / color::kBScale);
  return {lab_curve_back(x), lab_curve_back(y), lab_curve_back(z)};
}

Pixel lch_of_lab(const Pixel& p) {
  const float a = p.c1 - color::kCenter;
  const float b = p.c2 - color::kCenter;
  const float turns = color::kTurnOfRadian * atan2_deterministic(b, a);
  return {p.c0, color::kChromaOfAb * std::sqrt(a * a + b * b), turns < 0 ? turns + 1.0F : turns};
}

Pixel lab_of_lch(const Pixel& p) {
  const auto [sine, cosine] = sine_cosine_of_turns(p.c2 - std::floor(p.c2));
  const float chroma = p.c1 * (1.0F / color::kChromaOfAb);
  return {p.c0, color::kCenter + chroma * cosine, color::kCenter + chroma * sine};
}

}  // namespace

ColorPlan::ColorPlan(ColorSpace source_space, ColorSpace result_space, PixelType type, AlphaState alpha)
    : full(full_range(type)), center(128.0F * (full / 255.0F)), premultiplied(alpha == AlphaState::Premultiplied) {
  // Up from the source to the common ancestor, then down to the result.
  std::array<ColorStep, 4> down{};
  int downs = 0;
  ColorSpace from = source_space;
  ColorSpace to = result_space;
  while (from != to) {
    if (depth(from) >= depth(to)) {
      list[static_cast<std::size_t>(count++)] = {from, true};
      from = parent(from);
    } else {
      down[static_cast<std::size_t>(downs++)] = {to, false};
      to = parent(to);
    }
  }
  while (downs > 0) list[static_cast<std::size_t>(count++)] = down[static_cast<std::size_t>(--downs)];

  const float load_stored = is_light(source_space) ? 1.0F / full : 1.0F;
  const float store_stored = is_light(result_space) ? full : 1.0F;
  load_scale = premultiplied ? load_stored * full : load_stored;
  store_scale = premultiplied ? store_stored / full : store_stored;
  if (type == PixelType::U8 && !premultiplied) {
    bytes_in = source_space == ColorSpace::Srgb && is_light(result_space);
    bytes_out = result_space == ColorSpace::Srgb && is_light(source_space);
  }
}

Pixel color::apply_step(const ColorStep& step, const ColorPlan& plan, const Pixel& pixel) {
  const bool up = step.to_parent;
  switch (step.space) {
    case ColorSpace::Hsv: return up ? rgb_of_hsv(pixel, plan.full) : hsv_of_rgb(pixel, plan.full);
    case ColorSpace::Hsl: return up ? rgb_of_hsl(pixel, plan.full) : hsl_of_rgb(pixel, plan.full);
    case ColorSpace::Ycbcr: return up ? rgb_of_ycbcr(pixel, plan.center) : ycbcr_of_rgb(pixel, plan.center);
    case ColorSpace::Xyz: return product(up ? kRgbOfXyz : kXyzOfRgb, pixel);
    case ColorSpace::Lab: return up ? xyz_of_lab(pixel) : lab_of_xyz(pixel);
    case ColorSpace::Lch: return up ? lab_of_lch(pixel) : lch_of_lab(pixel);
    case ColorSpace::Srgb: break;
    case ColorSpace::Linear: return pixel;
  }
  const auto curve = [&](float value) {
    if (up && plan.bytes_in) return byte_curve().linear[static_cast<int>(value)];
    if (up) return srgb_to_linear(value / plan.full);
    if (plan.bytes_out) return static_cast<float>(encode_byte(byte_curve(), value));
    return linear_to_srgb(value) * plan.full;
  };
  return {curve(pixel.c0), curve(pixel.c1), curve(pixel.c2)};
}

}  // namespace azulejo
