#include "azulejo/modelling/surface.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"
#include "azulejo/math/bspline.h"
#include "azulejo/math/rational_curve.h"
#include "azulejo/modelling/surface_builder.h"

namespace azulejo {
namespace {

constexpr double kLargest = 1e6;
constexpr double kMostSteps = 1024;
constexpr int kMostBezierPoints = 25;

[[noreturn]] void refuse(const SurfaceOptions& options, const std::string& what) {
  const std::string_view name = enum_names(options.kind)[static_cast<std::size_t>(options.kind)];
  throw Error(Error::Argument, fmt::format("{}: {}", name, what));
}

double weight_at(const SurfaceOptions& options, std::size_t index) {
  return options.weights.empty() ? 1.0 : static_cast<double>(options.weights[index]);
}

void check_weights(const SurfaceOptions& options, std::size_t points) {
  if (!options.weights.empty() && options.weights.size() != points) {
    refuse(options, fmt::format("{} weights, expected {}, one a point", options.weights.size(), points));
  }
}

NurbsSurface revolution_of(const SurfaceOptions& options) {
  const std::size_t count = options.points.size() / 2;
  if (options.points.size() % 2 != 0) {
    refuse(options, fmt::format("{} numbers in points, expected x and y of each", options.points.size()));
  }
  check_weights(options, count);
  if (count <= static_cast<std::size_t>(options.degree_v)) {
    refuse(options, fmt::format("{} points, expected {} or more for degree_v {}", count, options.degree_v + 1,
                                options.degree_v));
  }
  std::vector<glm::dvec3> profile;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec2 point(options.points[2 * i], options.points[2 * i + 1]);
    profile.push_back(homogeneous<glm::dvec2>(point, weight_at(options, i)));
  }
  return revolved(profile, clamped_knots(count, options.degree_v), options.degree_v);
}

NurbsSurface surface_of(const SurfaceOptions& options) {
  if (options.kind == SurfaceKind::Revolution) return revolution_of(options);
  const auto columns = static_cast<std::size_t>(options.columns);
  const std::size_t count = options.points.size() / 3;
  if (options.points.size() % 3 != 0 || count % columns != 0) {
    refuse(options,
           fmt::format("{} numbers in points, expected x, y and z of {} in each row", options.points.size(), columns));
  }
  check_weights(options, count);
  NurbsSurface made;
  made.columns = columns;
  made.rows = count / columns;
  const bool bezier = options.kind == SurfaceKind::Bezier;
  made.degree_u = bezier ? static_cast<int>(made.columns) - 1 : options.degree_u;
  made.degree_v = bezier ? static_cast<int>(made.rows) - 1 : options.degree_v;
  const auto check = [&](std::size_t points, int degree, const char* what) {
    if (points < 2 || points <= static_cast<std::size_t>(degree) || (bezier && points > kMostBezierPoints)) {
      refuse(options, fmt::format("{} {}, expected {} to {}", points, what, bezier ? 2 : degree + 1,
                                  bezier ? std::to_string(kMostBezierPoints) : std::string("any")));
    }
  };
  check(made.columns, made.degree_u, "columns");
  check(made.rows, made.degree_v, "rows");
  made.knots_u = clamped_knots(made.columns, made.degree_u);
  made.knots_v = clamped_knots(made.rows, made.degree_v);
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 point(options.points[3 * i], options.points[3 * i + 1], options.points[3 * i + 2]);
    made.controls.push_back(homogeneous<glm::dvec3>(point, weight_at(options, i)));
  }
  return made;
}

/// Even steps of `step` at most between different knots of the domain.
std::vector<double> parameters_of(std::span<const double> knots, int degree, std::size_t controls, double step) {
  std::vector<double> parameters{knots[static_cast<std::size_t>(degree)]};
  for (std::size_t k = static_cast<std::size_t>(degree); k < controls; ++k) {
    const double width = knots[k + 1] - knots[k];
    if (!(width > 0)) continue;
    const double count = std::max(std::ceil(width / step - 1e-9), 1.0);
    if (!(count + static_cast<double>(parameters.size()) <= kMostSteps)) {
      throw Error(Error::Argument,
                  fmt::format("tolerance: more than {:.0f} steps would be needed, expected a larger one", kMostSteps));
    }
    for (double i = 1; i < count; ++i) parameters.push_back(knots[k] + width * (i / count));
    parameters.push_back(knots[k + 1]);
  }
  return parameters;
}

/// Where the derivatives span no plane, of a place inside.
glm::dvec3 normal_at(const NurbsSurface& surface, const glm::dvec2& at, const glm::dvec2& lower,
                     const glm::dvec2& upper) {
  constexpr double kInside = 1e-4;
  const glm::dvec2 middle = 0.5 * (lower + upper);
  for (const double share : {0.0, kInside, 100 * kInside}) {
    const glm::dvec2 place = at + share * (middle - at);
    const SurfacePoint point = surface_point(surface, place.x, place.y);
    const glm::dvec3 across = glm::cross(point.along_v, point.along_u);
    const double flat = 1e-9 * glm::length(point.along_v) * glm::length(point.along_u);
    const double length = glm::length(across);
    if (length > flat &&
        length > 1e-12 * (glm::dot(point.along_u, point.along_u) + glm::dot(point.along_v, point.along_v))) {
      return across / length;
    }
  }
  return {0, 0, 0};
}

std::vector<Value> run_surface(std::span<const Value>, const SurfaceOptions& options, const Run& run) {
  std::vector<Value> results;
  results.emplace_back(surface(options, run));
  return results;
}

}  // namespace

extern const Operation kSurface = with_examples(
    value_operation<SurfaceOptions>(
        "surface", "Makes a smooth surface of control points: Bézier, B-spline, NURBS, or a profile that is turned.",
        {}, {{"mesh", "the surface, as faces", ValueKind::Mesh}},
        {field("kind", &SurfaceOptions::kind, "what the points mean"),
         field("points", &SurfaceOptions::points, {-kLargest, kLargest}, "",
               "x, y and z of each, row by row; of a profile x and y, from the top down"),
         field("columns", &SurfaceOptions::columns, {2, 10000}, "", "points in a row"),
         field("weights", &SurfaceOptions::weights, {1e-3, 1e3}, "", "one a point; none: 1"),
         field("degree_u", &SurfaceOptions::degree_u, {1, 16}, "", "of bspline, along the rows"),
         field("degree_v", &SurfaceOptions::degree_v, {1, 16}, "", "of bspline from row to row, of a profile"),
         field("tolerance", &SurfaceOptions::tolerance, {1e-6, kLargest}, "",
               "how far faces are from the surface at most")},
        run_surface),
    {{"surface render", "A patch of 4 × 3 control points."},
     {"surface:kind=revolution,points=0.5,1,0.3,0.4,1.2,0.2,0.9,-0.6,0.3,-0.7,0.6,-1 render",
      "A vase: a B-spline of six points, turned."}});

Mesh tessellate_surface(const NurbsSurface& surface, double tolerance, const Run& run) {
  check_surface(surface, "surface");
  const SurfaceBends bends = surface_bends(surface);
  // ⅛ (uu h² + 2 uv h k + vv k²) with 2 h k ≤ h² + k²: half of the tolerance for each direction.
  const double h = std::sqrt(4 * tolerance / (bends.uu + bends.uv));
  const double k = std::sqrt(4 * tolerance / (bends.vv + bends.uv));
  const std::vector<double> us = parameters_of(surface.knots_u, surface.degree_u, surface.columns, h);
  const std::vector<double> vs = parameters_of(surface.knots_v, surface.degree_v, surface.rows, k);
  const double bytes = 300.0 * static_cast<double>(us.size()) * static_cast<double>(vs.size());
  if (bytes > static_cast<double>(run.limits.memory_bytes)) {
    throw Error(Error::Resource, fmt::format("surface: {} × {} places need about {:.0f} bytes, the limit is {}",
                                             us.size(), vs.size(), bytes, run.limits.memory_bytes));
  }
  const glm::dvec2 lower(us.front(), vs.front());
  const glm::dvec2 upper(us.back(), vs.back());
  struct Place {
    std::uint32_t vertex;
    glm::dvec3 normal;
    glm::dvec2 uv;
  };
  SurfaceBuilder builder;
  PointWelder welder(builder);
  std::vector<Place> places;
  for (const double v : vs) {
    check_cancelled(run);
    for (const double u : us) {
      const glm::dvec2 at(u, v);
      places.push_back({welder.vertex(surface_point(surface, u, v).position), normal_at(surface, at, lower, upper),
                        (at - lower) / (upper - lower)});
    }
  }
  const auto add_corner = [&](std::size_t i, std::size_t j) {
    const Place& place = places[j * us.size() + i];
    builder.add_corner(place.vertex, place.normal, place.uv);
  };
  for (std::size_t j = 0; j + 1 < vs.size(); ++j) {
    for (std::size_t i = 0; i + 1 < us.size(); ++i) {
      add_corner(i, j);
      add_corner(i, j + 1);
      add_corner(i + 1, j + 1);
      add_corner(i + 1, j);
      builder.end_face();
    }
  }
  return builder.finish(true);
}

Mesh surface(const SurfaceOptions& options, const Run& run) {
  kSurface.check(&options);
  Mesh mesh = tessellate_surface(surface_of(options), options.tolerance, run);
  mesh.name = "surface";
  return mesh;
}

}  // namespace azulejo
