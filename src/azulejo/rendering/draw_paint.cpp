#include "azulejo/rendering/draw_paint.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "azulejo/math/sine.h"
#include "azulejo/math/transfer.h"
#include "azulejo/rendering/draw_layer.h"

namespace azulejo {
namespace {

/// The inverse of an affine matrix, as the rows of x and y; none: it is singular.
using Rows = std::array<std::array<double, 3>, 2>;
std::optional<Rows> inverted(const glm::mat3x2& m) {
  const double a = m[0].x;
  const double b = m[1].x;
  const double c = m[0].y;
  const double d = m[1].y;
  const double determinant = a * d - b * c;
  const double scale = 1 / determinant;
  if (!std::isfinite(scale)) return std::nullopt;
  Rows rows{{{d * scale, -b * scale, 0}, {-c * scale, a * scale, 0}}};
  for (std::array<double, 3>& row : rows) {
    row[2] = -(row[0] * m[2].x + row[1] * m[2].y);
    for (const double number : row) {
      if (!std::isfinite(number)) return std::nullopt;
    }
  }
  return rows;
}

/// ∫ from 0 to u of what is 1 within width ÷ 2 of each whole number, width ≤ 1.
double line_integral(double u, double width) {
  const double whole = std::floor(u + 0.5);
  return whole * width + std::clamp(u - whole, -0.5 * width, 0.5 * width);
}

/// And the integral of that.
double line_integral_twice(double u, double width) {
  const double whole = std::floor(u + 0.5);
  const double t = u - whole;
  const double half = 0.5 * width;
  const double rest = std::abs(t) <= half ? 0.5 * t * t : half * (std::abs(t) - 0.5 * half);
  return whole * width * (0.5 * whole + t) + rest;
}

/// What a paint without pattern becomes: of a gradient without extent the last stop is everywhere.
glm::vec4 last_color(const Gradient& gradient, const glm::vec4& tint) {
  glm::vec4 color = gradient.stops.back().color;
  color.w *= tint.w;
  return color;
}

}  // namespace

glm::vec4 premultiplied(const glm::vec4& straight, bool linear) {
  glm::vec4 color = straight;
  for (int c = 0; c < 3; ++c) color[c] = (linear ? srgb_to_linear(straight[c]) : straight[c]) * straight.w;
  return color;
}

DrawPaint::DrawPaint(const PaintPattern& pattern, const glm::vec4& tint, const glm::mat3x2& picture_from_path,
                     bool linear, bool exact)
    : linear_(linear), exact_(exact), color_(premultiplied(tint, linear)) {
  if (const auto* gradient = std::get_if<Gradient>(&pattern)) prepare(*gradient, tint, picture_from_path);
  if (const auto* hatch = std::get_if<Hatch>(&pattern)) prepare(*hatch, picture_from_path);
  if (const auto* stipple = std::get_if<Stipple>(&pattern)) stipple_ = *stipple;
}

void DrawPaint::prepare(const Gradient& gradient, const glm::vec4& tint, const glm::mat3x2& picture_from_path) {
  if (gradient.stops.empty()) {
    plain_ = glm::vec4(0);
    return;
  }
  const glm::dvec2 distance = glm::dvec2(gradient.to) - glm::dvec2(gradient.from);
  const double square = distance.x * distance.x + distance.y * distance.y;
  const double growth = double{gradient.to_radius} - gradient.from_radius;
  const double unit = std::max({std::sqrt(square), double{gradient.from_radius}, double{gradient.to_radius}});
  const bool no_extent = gradient.radial ? square == 0 && growth == 0 : square == 0;
  if (gradient.stops.size() == 1 || no_extent) {
    plain_ = premultiplied(last_color(gradient, tint), linear_);
    return;
  }
  const std::optional<Rows> inverse = inverted(combined(picture_from_path, gradient.path_from_gradient));
  if (!inverse) {
    plain_ = glm::vec4(0);
    return;
  }
  GradientField field;
  field.radial = gradient.radial;
  field.spread = gradient.spread;
  field.linear = linear_;
  for (std::size_t i = 0; i < 3; ++i) {
    const double x = (*inverse)[0][i] - (i == 2 ? gradient.from.x : 0.0F);
    const double y = (*inverse)[1][i] - (i == 2 ? gradient.from.y : 0.0F);
    field.across[i] = gradient.radial ? x / unit : 0;
    field.along[i] = gradient.radial ? y / unit : (x * distance.x + y * distance.y) / square;
  }
  field.distance_x = static_cast<float>(distance.x / unit);
  field.distance_y = static_cast<float>(distance.y / unit);
  field.radius = static_cast<float>(gradient.from_radius / unit);
  field.growth = static_cast<float>(growth / unit);
  const auto tinted = [&](const GradientStop& stop) {
    return glm::vec4(stop.color.x, stop.color.y, stop.color.z, stop.color.w * tint.w);
  };
  field.first = tinted(gradient.stops.front());
  for (std::size_t i = 0; i + 1 < gradient.stops.size(); ++i) {
    const float length = gradient.stops[i + 1].offset - gradient.stops[i].offset;
    const float scale = 1 / length;
    const bool jumps = !(length > 0) || !std::isfinite(scale);
    field.steps.push_back(
        {gradient.stops[i].offset, jumps ? 0 : scale, tinted(gradient.stops[i + 1]) - tinted(gradient.stops[i])});
  }
  gradient_ = std::move(field);
}

void DrawPaint::prepare(const Hatch& hatch, const glm::mat3x2& picture_from_path) {
  const std::optional<Rows> inverse = inverted(picture_from_path);
  if (!inverse) {
    plain_ = glm::vec4(0);
    return;
  }
  constexpr double kTurn = 6.283185307179586;
  const auto turns = static_cast<float>(std::fmod(double{hatch.angle}, kTurn) / kTurn);
  const SineCosine direction = sine_cosine_of_turns(turns);
  const auto add = [&](double normal_x, double normal_y) {
    const auto along = [&](std::size_t i) {
      return (normal_x * (*inverse)[0][i] + normal_y * (*inverse)[1][i]) / double{hatch.spacing};
    };
    lines_.push_back({along(0), along(1), along(2), std::min(1.0, double{hatch.width} / double{hatch.spacing})});
  };
  add(direction.sine, direction.cosine);
  if (hatch.crossed) add(direction.cosine, -double{direction.sine});
}

double DrawPaint::Lines::covered(double at, bool exact) const {
  if (!exact) return at - std::floor(at + 0.5) < 0.5 * width && at - std::floor(at + 0.5) >= -0.5 * width ? 1 : 0;
  // A pixel seen along the lines is a trapezoid: the sum of two lengths.
  const double wide = std::max(std::abs(x), std::abs(y));
  const double narrow = std::min(std::abs(x), std::abs(y));
  if (!(wide < 1e6)) return width;
  if (narrow < 1e-4 * wide) {
    const double half = 0.5 * wide;
    return (line_integral(at + half, width) - line_integral(at - half, width)) / wide;
  }
  const double outer = 0.5 * (wide + narrow);
  const double inner = 0.5 * (wide - narrow);
  // Near 0, where squares of whole numbers cost no digits.
  at -= std::floor(at + 0.5);
  const double sum = line_integral_twice(at + outer, width) - line_integral_twice(at + inner, width) -
                     line_integral_twice(at - inner, width) + line_integral_twice(at - outer, width);
  return sum / (wide * narrow);
}

float DrawPaint::hatch_part(double x, double y) const {
  double free = 1;
  for (const Lines& lines : lines_) free *= 1 - lines.covered(lines.x * x + lines.y * y + lines.start, exact_);
  return static_cast<float>(std::clamp(1 - free, 0.0, 1.0));
}

void DrawPaint::colors(int first, int last, int y, float* result) const {
  if (gradient_) return kernels::gradient_colors(*gradient_, first, last, y, result);
  for (int block = first; block < last; ++block, result += kBlockFloats) {
    for (int i = 0; i < kBlock; ++i) {
      const int x = block * kBlock + i;
      float part = 1;
      if (stipple_) {
        part = static_cast<float>(stipple_->rows[static_cast<std::size_t>(y & 31)] >> (31 - (x & 31)) & 1U);
      } else if (!lines_.empty()) {
        part = hatch_part(x + 0.5, y + 0.5);
      }
      for (int c = 0; c < 4; ++c) result[c * kBlock + i] = part * color_[c];
    }
  }
}

}  // namespace azulejo
