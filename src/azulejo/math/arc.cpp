#include "azulejo/math/arc.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "azulejo/math/turns.h"

namespace azulejo {
namespace {

double square(const glm::dvec2& v) { return v.x * v.x + v.y * v.y; }

glm::dvec2 normalized(const glm::dvec2& v) { return v / std::sqrt(square(v)); }

/// (cos, sin) of an angle in turns.
glm::dvec2 unit_at(double turns) {
  constexpr std::int64_t kWhole = std::int64_t{1} << 50;
  const double part = turns - std::floor(turns);
  const Turn turn = turn_of(std::llround(part * static_cast<double>(kWhole)), kWhole);
  return {turn.cosine, turn.sine};
}

/// A quarter of a turn back: across a chord of the unit circle it points to the middle of the arc that turns forward.
glm::dvec2 quarter_back(const glm::dvec2& v) { return {v.y, -v.x}; }

glm::dvec2 middle_of(const glm::dvec2& first, const glm::dvec2& last, bool forward) {
  const glm::dvec2 middle = normalized(quarter_back(last - first));
  return forward ? middle : -middle;
}

/// 2/27 sin⁶ ÷ cos² of a quarter of the angle whose half has these.
double cubic_error(double half_sine, double half_cosine) {
  const double sine2 = half_sine * half_sine / (2 * (1 + half_cosine));  // of the quarter, squared
  return 2.0 / 27 * sine2 * sine2 * sine2 / (1 - sine2);
}

}  // namespace

std::optional<EllipticalArc> arc_between(const glm::dvec2& from, const glm::dvec2& to, glm::dvec2 radii, double turns,
                                         bool large, bool forward) {
  if (!std::isfinite(turns)) return std::nullopt;
  const glm::dvec2 axis = unit_at(turns);
  radii = {std::abs(radii.x), std::abs(radii.y)};
  const glm::dvec2 half = (from - to) / 2.0;
  // In the ellipse's axes, where it is the unit circle, the ends are at ± this from their middle.
  glm::dvec2 end((axis.x * half.x + axis.y * half.y) / radii.x, (axis.x * half.y - axis.y * half.x) / radii.y);
  const double size = std::sqrt(square(end));
  if (!std::isfinite(size) || size == 0) return std::nullopt;
  if (size > 1) {
    radii *= size;
    end /= size;
  }
  const double away = std::sqrt(std::max(0.0, 1 / std::min(square(end), 1.0) - 1));
  const glm::dvec2 middle = glm::dvec2(end.y, -end.x) * (large == forward ? -away : away);
  EllipticalArc arc;
  arc.x = axis * radii.x;
  arc.y = glm::dvec2(-axis.y, axis.x) * radii.y;
  arc.center = (from + to) / 2.0 + arc.x * middle.x + arc.y * middle.y;
  arc.first = normalized(end - middle);
  arc.last = normalized(-end - middle);
  arc.forward = forward;
  if (!std::isfinite(square(arc.center) + square(arc.first) + square(arc.last))) return std::nullopt;
  return arc;
}

EllipticalArc arc_around(const glm::dvec2& center, const glm::dvec2& radii, double turns, double first, double sweep) {
  EllipticalArc arc;
  const glm::dvec2 axis = unit_at(turns);
  arc.center = center;
  arc.x = axis * radii.x;
  arc.y = glm::dvec2(-axis.y, axis.x) * radii.y;
  arc.forward = sweep >= 0;
  arc.whole = std::abs(sweep) >= 1;
  arc.first = unit_at(first);
  arc.last = arc.whole ? arc.first : unit_at(first + sweep);
  return arc;
}

std::vector<std::array<glm::dvec2, 4>> arc_to_cubics(const EllipticalArc& arc, double tolerance) {
  if (!arc.whole && arc.first == arc.last) return {};
  std::vector<glm::dvec2> ends{arc.first, arc.last};
  const glm::dvec2 middle = arc.whole ? -arc.first : middle_of(arc.first, arc.last, arc.forward);
  const glm::dvec2 sum = arc.first + arc.last;
  if (middle.x * sum.x + middle.y * sum.y <= 0) ends.insert(ends.begin() + 1, middle);  // half a turn or more
  constexpr std::size_t kMost = 64;
  double half_sine = 0;
  double half_cosine = 0;
  for (;;) {
    half_sine = std::min(0.5 * std::sqrt(square(ends[1] - ends[0])), 1.0);
    half_cosine = std::sqrt(1 - half_sine * half_sine);
    const double radius = std::sqrt(std::max(square(arc.x), square(arc.y)));
    if (radius * cubic_error(half_sine, half_cosine) <= tolerance || ends.size() > kMost) break;
    std::vector<glm::dvec2> finer;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      finer.push_back(ends[i]);
      finer.push_back(middle_of(ends[i], ends[i + 1], arc.forward));
    }
    finer.push_back(ends.back());
    ends = std::move(finer);
  }
  const double reach = 4.0 / 3 * half_sine / (1 + half_cosine) * (arc.forward ? 1 : -1);  // 4/3 tan(θ/4)
  const auto placed = [&](const glm::dvec2& unit) { return arc.center + arc.x * unit.x + arc.y * unit.y; };
  std::vector<std::array<glm::dvec2, 4>> pieces;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const glm::dvec2 a = ends[i];
    const glm::dvec2 b = ends[i + 1];
    pieces.push_back({placed(a), placed(a - reach * quarter_back(a)), placed(b + reach * quarter_back(b)), placed(b)});
  }
  return pieces;
}

}  // namespace azulejo
