#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>

#include "azulejo/data/drawing.h"

namespace azulejo {
namespace {

void include(Box2& box, const glm::vec2& point) {
  box.lower = glm::min(box.lower, point);
  box.upper = glm::max(box.upper, point);
}

bool finite(const glm::vec2& point) { return std::isfinite(point.x) && std::isfinite(point.y); }

/// A line, quadratic or cubic in Bernstein form: `order` + 1 points.
struct Curve {
  std::array<glm::dvec2, 4> points;
  std::size_t order = 1;

  glm::dvec2 at(double t) const {
    std::array<glm::dvec2, 4> p = points;
    for (std::size_t n = order; n > 0; --n) {
      for (std::size_t i = 0; i < n; ++i) p[i] = (1 - t) * p[i] + t * p[i + 1];
    }
    return p[0];
  }
};

/// Where the derivative of one coordinate vanishes: roots of a + b t + c t², those in (0, 1).
void include_extrema(const Curve& curve, int axis, Box2& box) {
  std::array<double, 3> d{};  // of the derivative, in Bernstein form
  for (std::size_t i = 0; i < curve.order; ++i) d[i] = curve.points[i + 1][axis] - curve.points[i][axis];
  double a = d[0];
  double b = d[1] - d[0];
  double c = 0;
  if (curve.order == 3) {
    b = 2 * (d[1] - d[0]);
    c = d[0] - 2 * d[1] + d[2];
  }
  const auto include_at = [&](double t) {
    if (t > 0 && t < 1) include(box, glm::vec2(curve.at(t)));
  };
  // The form of the quadratic formula that doesn't cancel; where c is 0 its second root is that of the line.
  const double square = b * b - 4 * a * c;
  if (!(square >= 0)) return;
  const double q = -0.5 * (b + std::copysign(std::sqrt(square), b));
  if (c != 0) include_at(q / c);
  if (q != 0) include_at(a / q);
}

void include_curve(const Curve& curve, Box2& box) {
  include(box, glm::vec2(curve.points[0]));
  include(box, glm::vec2(curve.points[curve.order]));
  if (curve.order == 1) return;
  for (int axis = 0; axis < 2; ++axis) include_extrema(curve, axis, box);
}

}  // namespace

Box2 bounds(const PathView& path, const glm::mat3x2& page_from_path) {
  Box2 box;
  glm::vec2 here(0);
  glm::vec2 start(0);
  std::size_t at = 0;
  for (const PathCommand command : path.commands) {
    const std::size_t count = points_of(command);
    if (command == PathCommand::Move) {
      start = here = transformed(page_from_path, path.points[at]);
    } else if (command == PathCommand::Close) {
      here = start;
    } else {
      Curve curve;
      curve.order = count;
      curve.points[0] = here;
      bool all_finite = finite(here);
      for (std::size_t i = 0; i < count; ++i) {
        here = transformed(page_from_path, path.points[at + i]);
        curve.points[i + 1] = here;
        all_finite = all_finite && finite(here);
      }
      if (all_finite) include_curve(curve, box);
    }
    at += count;
  }
  return box;
}

Box2 bounds(const Drawing& drawing) {
  Box2 box;
  for (const PlacedPath& placed : walk(drawing)) {
    const Box2 each = bounds(drawing.view(drawing.paths[placed.path]), placed.page_from_path);
    if (each.empty()) continue;
    include(box, each.lower);
    include(box, each.upper);
  }
  return box;
}

}  // namespace azulejo
