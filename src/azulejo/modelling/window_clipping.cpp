#include "azulejo/modelling/window_clipping.h"

#include <algorithm>
#include <cmath>

namespace azulejo {
namespace {

bool is_finite(const LineSegment2& segment) {
  return std::isfinite(segment.from.x) && std::isfinite(segment.from.y) && std::isfinite(segment.to.x) &&
         std::isfinite(segment.to.y);
}

/// The part of a segment that is left, in its parameter.
class Interval {
 public:
  /// Keeps where start + t · step ≥ 0.
  bool keep(double start, double step) {
    if (step == 0) return start >= 0;
    const double t = -start / step;
    if (step > 0) {
      first_ = std::max(first_, t);
    } else {
      last_ = std::min(last_, t);
    }
    return first_ <= last_;
  }
  LineSegment2 part_of(const LineSegment2& segment) const {
    const glm::dvec2 from(segment.from);
    const glm::dvec2 step = glm::dvec2(segment.to) - from;
    return {first_ > 0 ? glm::vec2(from + first_ * step) : segment.from,
            last_ < 1 ? glm::vec2(from + last_ * step) : segment.to};
  }

 private:
  double first_ = 0;
  double last_ = 1;
};

glm::vec2 clamped(const glm::vec2& point, const Box2& window) {
  return {std::clamp(point.x, window.lower.x, window.upper.x), std::clamp(point.y, window.lower.y, window.upper.y)};
}

enum Code : unsigned { kLeft = 1, kRight = 2, kBelow = 4, kAbove = 8 };

unsigned code_of(const glm::dvec2& point, const Box2& window) {
  return (point.x < double{window.lower.x} ? kLeft : 0U) | (point.x > double{window.upper.x} ? kRight : 0U) |
         (point.y < double{window.lower.y} ? kBelow : 0U) | (point.y > double{window.upper.y} ? kAbove : 0U);
}

/// Where the line through two points meets a side of the window.
glm::dvec2 meet(const glm::dvec2& a, const glm::dvec2& b, unsigned code, const Box2& window) {
  if ((code & (kLeft | kRight)) != 0) {
    const double x = (code & kLeft) != 0 ? window.lower.x : window.upper.x;
    return {x, a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y)};
  }
  const double y = (code & kBelow) != 0 ? window.lower.y : window.upper.y;
  return {a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x), y};
}

/// Keeps the part of a ring on one side of a line along an axis.
void keep_side(std::vector<glm::dvec2>& ring, int axis, double limit, bool above) {
  std::vector<glm::dvec2> kept;
  const auto inside = [&](const glm::dvec2& p) { return above ? p[axis] >= limit : p[axis] <= limit; };
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const glm::dvec2& from = ring[i];
    const glm::dvec2& to = ring[i + 1 == ring.size() ? 0 : i + 1];
    if (inside(from)) kept.push_back(from);
    if (inside(from) == inside(to)) continue;
    glm::dvec2 border(limit);
    const int other = 1 - axis;
    border[other] = from[other] + (limit - from[axis]) / (to[axis] - from[axis]) * (to[other] - from[other]);
    kept.push_back(border);
  }
  ring.swap(kept);
}

}  // namespace

std::optional<LineSegment2> clip(const LineSegment2& segment, const Box2& window) {
  if (!is_finite(segment) || window.empty()) return std::nullopt;
  const glm::dvec2 from(segment.from);
  const glm::dvec2 step = glm::dvec2(segment.to) - from;
  Interval interval;
  if (!interval.keep(from.x - double{window.lower.x}, step.x) ||
      !interval.keep(double{window.upper.x} - from.x, -step.x) ||
      !interval.keep(from.y - double{window.lower.y}, step.y) ||
      !interval.keep(double{window.upper.y} - from.y, -step.y)) {
    return std::nullopt;
  }
  const LineSegment2 part = interval.part_of(segment);
  return LineSegment2{clamped(part.from, window), clamped(part.to, window)};
}

std::optional<LineSegment2> clip_by_codes(const LineSegment2& segment, const Box2& window) {
  if (!is_finite(segment) || window.empty()) return std::nullopt;
  glm::dvec2 a(segment.from);
  glm::dvec2 b(segment.to);
  unsigned a_code = code_of(a, window);
  unsigned b_code = code_of(b, window);
  // Each turn moves an end to a side that it is beyond of: at most two of either end.
  for (int turns = 0; turns < 4 && (a_code | b_code) != 0; ++turns) {
    if ((a_code & b_code) != 0) return std::nullopt;
    if (a_code != 0) {
      a = meet(a, b, a_code, window);
      a_code = code_of(a, window);
    } else {
      b = meet(a, b, b_code, window);
      b_code = code_of(b, window);
    }
  }
  if ((a_code & b_code) != 0) return std::nullopt;
  return LineSegment2{clamped(a, window), clamped(b, window)};
}

std::optional<LineSegment2> clip(const LineSegment2& segment, std::span<const glm::vec2> convex_ring) {
  if (!is_finite(segment) || convex_ring.empty()) return std::nullopt;
  const glm::dvec2 from(segment.from);
  const glm::dvec2 step = glm::dvec2(segment.to) - from;
  Interval interval;
  for (std::size_t i = 0; i < convex_ring.size(); ++i) {
    const glm::dvec2 corner(convex_ring[i]);
    const glm::dvec2 side = glm::dvec2(convex_ring[i + 1 == convex_ring.size() ? 0 : i + 1]) - corner;
    const glm::dvec2 away = from - corner;
    if (!interval.keep(side.x * away.y - side.y * away.x, side.x * step.y - side.y * step.x)) return std::nullopt;
  }
  return interval.part_of(segment);
}

Polygon clip(const Polygon& polygon, const Box2& window) {
  Polygon result;
  if (window.empty()) return result;
  std::vector<glm::dvec2> ring;
  for (std::size_t r = 0; r < polygon.ring_count(); ++r) {
    ring.clear();
    for (const glm::vec2& point : polygon.ring(r)) {
      if (std::isfinite(point.x) && std::isfinite(point.y)) ring.emplace_back(point);
    }
    for (const int axis : {0, 1}) {
      keep_side(ring, axis, double{window.lower[axis]}, true);
      keep_side(ring, axis, double{window.upper[axis]}, false);
    }
    if (ring.size() >= 3) result.add_ring(std::vector<glm::vec2>(ring.begin(), ring.end()));
  }
  return result;
}

}  // namespace azulejo
