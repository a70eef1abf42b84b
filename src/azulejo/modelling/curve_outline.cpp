#include "azulejo/modelling/curve_outline.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/math/arc.h"
#include "azulejo/math/bspline.h"
#include "azulejo/math/rational_curve.h"
#include "azulejo/math/turns.h"

namespace azulejo {
namespace {

constexpr std::size_t kMostBezierPoints = 65;
using Cubic = std::array<glm::dvec2, 4>;

[[noreturn]] void refuse(const CurveOptions& options, const std::string& what) {
  const std::string_view name = enum_names(options.kind)[static_cast<std::size_t>(options.kind)];
  throw Error(Error::Argument, fmt::format("{}: {}", name, what));
}

void add_cubic(Path& path, const Cubic& cubic) {
  if (path.commands.empty()) path.move_to(cubic[0]);
  path.cubic_to(cubic[1], cubic[2], cubic[3]);
}

Path polygon_of(const std::vector<glm::dvec2>& points, bool closed) {
  Path path;
  path.move_to(points[0]);
  for (std::size_t i = 1; i < points.size(); ++i) path.line_to(points[i]);
  if (closed) path.close();
  return path;
}

/// Of homogeneous points; as it is where the weights are equal and the degree is 3 at most.
void add_bezier(Path& path, std::span<const glm::dvec3> controls, double tolerance) {
  const auto at = [&](std::size_t i) { return glm::vec2(projected<glm::dvec2>(controls[i])); };
  const bool plain = std::all_of(controls.begin(), controls.end(), [&](const auto& p) { return p.z == controls[0].z; });
  if (path.commands.empty()) path.move_to(at(0));
  if (plain && controls.size() == 2) {
    path.line_to(at(1));
  } else if (plain && controls.size() == 3) {
    path.quadratic_to(at(1), at(2));
  } else if (plain && controls.size() == 4) {
    path.cubic_to(at(1), at(2), at(3));
  } else {
    simplify_rational<glm::dvec2>(controls, tolerance, cubic_of<glm::dvec2>,
                                  [&](const Cubic& cubic) { add_cubic(path, cubic); });
  }
}

std::vector<glm::dvec3> weighted_points(const CurveOptions& options, const std::vector<glm::dvec2>& points) {
  if (!options.weights.empty() && options.kind != CurveKind::Nurbs) {
    refuse(options, "weights are given, expected them with nurbs only");
  }
  if (!options.weights.empty() && options.weights.size() != points.size()) {
    refuse(options, fmt::format("{} weights, expected {}, one a point", options.weights.size(), points.size()));
  }
  std::vector<glm::dvec3> weighted;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double weight = options.weights.empty() ? 1.0 : static_cast<double>(options.weights[i]);
    weighted.push_back(homogeneous<glm::dvec2>(points[i], weight));
  }
  return weighted;
}

Path bezier_outline(const CurveOptions& options, const std::vector<glm::dvec2>& points) {
  if (points.size() > kMostBezierPoints) {
    refuse(options, fmt::format("{} points, expected {} at most", points.size(), kMostBezierPoints));
  }
  Path path;
  add_bezier(path, weighted_points(options, points), options.tolerance);
  if (options.closed) path.close();
  return path;
}

Path spline_outline(const CurveOptions& options, const std::vector<glm::dvec2>& points) {
  std::vector<glm::dvec3> controls = weighted_points(options, points);
  std::vector<double> knots(options.knots.begin(), options.knots.end());
  if (options.closed) {
    if (!knots.empty()) refuse(options, "knots are given, expected none where it is closed");
    for (std::size_t i = 0; i < static_cast<std::size_t>(options.degree); ++i) {
      controls.push_back(controls[i % points.size()]);
    }
    knots = even_knots(controls.size(), options.degree);
  } else {
    if (controls.size() <= static_cast<std::size_t>(options.degree)) {
      refuse(options, fmt::format("{} points, expected {} or more for degree {}", controls.size(), options.degree + 1,
                                  options.degree));
    }
    if (knots.empty()) knots = clamped_knots(controls.size(), options.degree);
  }
  check_knots(knots, options.degree, controls.size(), "knots");
  Path path;
  for (const auto& piece : bspline_to_beziers<glm::dvec3>(controls, knots, options.degree)) {
    add_bezier(path, piece, options.tolerance);
  }
  if (options.closed) path.close();
  return path;
}

Path catmull_rom_outline(const CurveOptions& options, const std::vector<glm::dvec2>& points) {
  Path path;
  for (const Cubic& cubic : catmull_rom<glm::dvec2>(points, options.closed, options.timing)) add_cubic(path, cubic);
  if (path.commands.empty()) refuse(options, "all points are the same, expected two others");
  if (options.closed) path.close();
  return path;
}

/// Angles that grow counter-clockwise as seen, on a page whose y points down.
Path arc_outline(const CurveOptions& options, glm::dvec2 radii, double sweep_turns) {
  const EllipticalArc arc = arc_around(options.center, {radii.x, -radii.y}, -options.rotation_deg / 360.0,
                                       options.first_deg / 360.0, sweep_turns);
  Path path;
  for (const Cubic& cubic : arc_to_cubics(arc, options.tolerance)) add_cubic(path, cubic);
  if (path.commands.empty()) refuse(options, "sweep_deg is 0, expected an arc");
  if (arc.whole) path.close();
  return path;
}

/// Counter-clockwise as seen; 0 is to the right.
glm::dvec2 direction(double turns) {
  const Turn turn = turn_at(turns);
  return {turn.cosine, -turn.sine};
}

/// Corners by turns on two circles, the first one on top.
Path star_outline(const CurveOptions& options, int corners, double inner) {
  const int steps = inner < 1 ? 2 * corners : corners;
  std::vector<glm::dvec2> points;
  for (int i = 0; i < steps; ++i) {
    const double radius = options.radii.x * (inner < 1 && i % 2 == 1 ? inner : 1);
    const double turns = 0.25 + options.rotation_deg / 360.0 + static_cast<double>(i) / steps;
    points.push_back(glm::dvec2(options.center) + radius * direction(turns));
  }
  return polygon_of(points, true);
}

Path rectangle_outline(const CurveOptions& options) {
  const glm::dvec2 x = direction(options.rotation_deg / 360.0);
  const glm::dvec2 y(-x.y, x.x);
  const glm::dvec2 half = options.radii;
  std::vector<glm::dvec2> points;
  for (const glm::dvec2& corner : {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, 1)}) {
    points.push_back(glm::dvec2(options.center) + x * (corner.x * half.x) + y * (corner.y * half.y));
  }
  return polygon_of(points, true);
}

/// Cubics with its ends and derivatives: they are off by h⁴ ÷ 384 of the fourth derivative, which is radius + 4 · growth
/// at most.
Path spiral_outline(const CurveOptions& options) {
  const double outer = options.radii.x;
  const double angle = 2 * std::numbers::pi * options.turns;
  const double growth = outer * (1 - options.inner) / angle;  // per radian
  const double step = std::min(std::sqrt(std::sqrt(384 * options.tolerance / (outer + 4 * growth))), 0.75);
  const auto count = static_cast<int>(std::ceil(angle / step));
  struct Place {
    glm::dvec2 point;
    glm::dvec2 along;
  };
  const auto place = [&](int i) -> Place {
    const double share = static_cast<double>(i) / count;
    const glm::dvec2 out = direction(options.rotation_deg / 360.0 + options.turns * share);
    const glm::dvec2 left(out.y, -out.x);
    const double radius = outer * options.inner + growth * angle * share;
    return {glm::dvec2(options.center) + radius * out, (angle / count / 3) * (growth * out + radius * left)};
  };
  Path path;
  Place from = place(0);
  for (int i = 1; i <= count; ++i) {
    const Place to = place(i);
    add_cubic(path, {from.point, from.point + from.along, to.point - to.along, to.point});
    from = to;
  }
  return path;
}

}  // namespace

bool has_points(CurveKind kind) { return kind <= CurveKind::CatmullRom; }

std::vector<glm::dvec2> control_points(const CurveOptions& options) {
  if (options.points.size() % 2 != 0) {
    refuse(options, fmt::format("{} numbers in points, expected x and y of each", options.points.size()));
  }
  if (options.points.size() < 4) {
    refuse(options, fmt::format("{} points, expected 2 or more", options.points.size() / 2));
  }
  std::vector<glm::dvec2> points;
  for (std::size_t i = 0; i < options.points.size(); i += 2) {
    points.emplace_back(options.points[i], options.points[i + 1]);
  }
  return points;
}

Path curve_outline(const CurveOptions& options) {
  const double radius = options.radii.x;
  switch (options.kind) {
    case CurveKind::Polyline: return polygon_of(control_points(options), options.closed);
    case CurveKind::Bezier: return bezier_outline(options, control_points(options));
    case CurveKind::BSpline:
    case CurveKind::Nurbs: return spline_outline(options, control_points(options));
    case CurveKind::CatmullRom: return catmull_rom_outline(options, control_points(options));
    case CurveKind::Arc: return arc_outline(options, options.radii, options.sweep_deg / 360.0);
    case CurveKind::Circle: return arc_outline(options, {radius, radius}, 1);
    case CurveKind::Ellipse: return arc_outline(options, options.radii, 1);
    case CurveKind::Rectangle: return rectangle_outline(options);
    case CurveKind::Polygon: return star_outline(options, options.corners, 1);
    case CurveKind::Star: return star_outline(options, options.corners, options.inner);
    case CurveKind::Spiral: return spiral_outline(options);
  }
  return {};
}

}  // namespace azulejo
