#include "azulejo/math/nurbs_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/math/bspline.h"
#include "azulejo/math/rational_curve.h"

namespace azulejo {
namespace {

using Row = std::vector<glm::dvec4>;

std::span<const double> without_ends(std::span<const double> knots) { return knots.subspan(1, knots.size() - 2); }

/// The control points of derivatives along u and v, rows of them.
std::vector<Row> along_u(const std::vector<Row>& net, std::span<const double> knots, int degree) {
  std::vector<Row> result;
  for (const Row& row : net) result.push_back(bspline_hodograph<glm::dvec4>(row, knots, degree));
  return result;
}
std::vector<Row> transposed(const std::vector<Row>& net) {
  std::vector<Row> result(net.empty() ? 0 : net[0].size());
  for (const Row& row : net) {
    for (std::size_t i = 0; i < row.size(); ++i) result[i].push_back(row[i]);
  }
  return result;
}
std::vector<Row> along_v(const std::vector<Row>& net, std::span<const double> knots, int degree) {
  return transposed(along_u(transposed(net), knots, degree));
}

/// The largest lengths of the points and of the weights.
struct Largest {
  double point = 0;
  double weight = 0;
};
Largest largest_of(const std::vector<Row>& net) {
  Largest largest;
  for (const Row& row : net) {
    for (const glm::dvec4& each : row) {
      largest.point = std::max(largest.point, glm::length(glm::dvec3(each)));
      largest.weight = std::max(largest.weight, std::abs(each.w));
    }
  }
  return largest;
}

}  // namespace

void check_surface(const NurbsSurface& surface, const char* what) {
  check_knots(surface.knots_u, surface.degree_u, surface.columns, what);
  check_knots(surface.knots_v, surface.degree_v, surface.rows, what);
  if (surface.controls.size() != surface.columns * surface.rows) {
    throw Error(Error::Argument, fmt::format("{}: {} control points, expected {} × {}", what, surface.controls.size(),
                                             surface.columns, surface.rows));
  }
}

SurfacePoint surface_point(const NurbsSurface& surface, double u, double v) {
  const auto p = static_cast<std::size_t>(surface.degree_u);
  const auto q = static_cast<std::size_t>(surface.degree_v);
  u = std::clamp(u, surface.knots_u[p], surface.knots_u[surface.columns]);
  v = std::clamp(v, surface.knots_v[q], surface.knots_v[surface.rows]);
  const std::size_t span_v = knot_span(surface.knots_v, surface.degree_v, v);
  // Points of the curves along v at this u, and their derivatives by u.
  Row across(surface.rows);
  Row across_u(surface.rows);
  for (std::size_t j = span_v - q; j <= span_v; ++j) {
    const std::span<const glm::dvec4> row(surface.controls.data() + j * surface.columns, surface.columns);
    across[j] = bspline_point<glm::dvec4>(row, surface.knots_u, surface.degree_u, u);
    across_u[j] = bspline_derivative<glm::dvec4>(row, surface.knots_u, surface.degree_u, u);
  }
  const glm::dvec4 at = bspline_point<glm::dvec4>(across, surface.knots_v, surface.degree_v, v);
  const glm::dvec4 by_u = bspline_point<glm::dvec4>(across_u, surface.knots_v, surface.degree_v, v);
  const glm::dvec4 by_v = bspline_derivative<glm::dvec4>(across, surface.knots_v, surface.degree_v, v);
  return {projected<glm::dvec3>(at), projected_derivative<glm::dvec3>(at, by_u),
          projected_derivative<glm::dvec3>(at, by_v)};
}

SurfaceBends surface_bends(const NurbsSurface& surface) {
  glm::dvec3 lower(std::numeric_limits<double>::infinity());
  glm::dvec3 upper = -lower;
  double weight = std::numeric_limits<double>::infinity();
  for (const glm::dvec4& each : surface.controls) {
    const glm::dvec3 point = projected<glm::dvec3>(each);
    for (int k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], point[k]);
      upper[k] = std::max(upper[k], point[k]);
    }
    weight = std::min(weight, each.w);
  }
  const glm::dvec3 middle = 0.5 * (lower + upper);
  std::vector<Row> net(surface.rows);
  double radius = 0;
  for (std::size_t i = 0; i < surface.controls.size(); ++i) {
    const glm::dvec4& each = surface.controls[i];
    const glm::dvec3 about = glm::dvec3(each) - each.w * middle;
    radius = std::max(radius, glm::length(about) / each.w);
    net[i / surface.columns].emplace_back(about, each.w);
  }
  const int p = surface.degree_u;
  const int q = surface.degree_v;
  const std::span<const double> knots_u = surface.knots_u;
  const std::span<const double> knots_v = surface.knots_v;
  const std::vector<Row> net_u = along_u(net, knots_u, p);
  const std::vector<Row> net_v = along_v(net, knots_v, q);
  const Largest u = largest_of(net_u);
  const Largest v = largest_of(net_v);
  const Largest uv = largest_of(along_v(net_u, knots_v, q));
  const Largest uu = p < 2 ? Largest() : largest_of(along_u(net_u, without_ends(knots_u), p - 1));
  const Largest vv = q < 2 ? Largest() : largest_of(along_v(net_v, without_ends(knots_v), q - 1));
  // S = A ÷ w: S_u = (A_u − w_u S) ÷ w, S_uv = (A_uv − w_u S_v − w_v S_u − w_uv S) ÷ w, and |S| is at most the radius.
  // A weight that is the same everywhere has no derivatives but those of rounding.
  const double first_u = (u.point + u.weight * radius) / weight;
  const double first_v = (v.point + v.weight * radius) / weight;
  return {(uu.point + 2 * u.weight * first_u + uu.weight * radius) / weight,
          (uv.point + u.weight * first_v + v.weight * first_u + uv.weight * radius) / weight,
          (vv.point + 2 * v.weight * first_v + vv.weight * radius) / weight};
}

NurbsSurface revolved(const std::vector<glm::dvec3>& profile, const std::vector<double>& knots, int degree) {
  // A square around the circle, whose corners weigh √½.
  constexpr std::array<std::array<double, 2>, 9> kSquare = {
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}}};
  NurbsSurface surface;
  surface.degree_u = 2;
  surface.degree_v = degree;
  surface.columns = kSquare.size();
  surface.rows = profile.size();
  surface.knots_u = {0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1};
  surface.knots_v = knots;
  for (const glm::dvec3& each : profile) {
    for (std::size_t i = 0; i < kSquare.size(); ++i) {
      const double weight = i % 2 == 0 ? 1 : std::sqrt(0.5);
      surface.controls.emplace_back(weight * each.x * kSquare[i][0], weight * each.y, -weight * each.x * kSquare[i][1],
                                    weight * each.z);
    }
  }
  return surface;
}

}  // namespace azulejo
