#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "azulejo/modelling/primitive_shapes.h"
#include "azulejo/modelling/surface_builder.h"
#include "azulejo/modelling/teapot_patches.h"

namespace azulejo {
namespace {

using Weights = std::array<double, 4>;

/// Bernstein's polynomials and their derivatives at i ÷ n. The same from both ends, to the bit: patches that share an
/// edge from opposite sides get the same points there.
struct Basis {
  Weights value;
  Weights slope;

  Basis(int i, int n) {
    const double t = static_cast<double>(i) / n;
    const double s = static_cast<double>(n - i) / n;
    value = {s * s * s, 3 * t * (s * s), 3 * s * (t * t), t * t * t};
    slope = {-3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t};
  }
};

template <class Points>
glm::dvec3 mix(const Weights& w, const Points& p) {
  return (w[0] * p[0] + w[3] * p[3]) + (w[1] * p[1] + w[2] * p[2]);
}

struct Patch {
  std::array<std::array<glm::dvec3, 4>, 4> points;  ///< rows

  glm::dvec3 at(const Weights& across, const Weights& down) const {
    std::array<glm::dvec3, 4> column;
    for (std::size_t row = 0; row < 4; ++row) column[row] = mix(across, points[row]);
    return mix(down, column);
  }

  /// Where an edge is drawn together in one point, one derivative vanishes there: the limit has the mixed one instead.
  glm::dvec3 normal(const Basis& u, const Basis& v, bool u_ends, bool v_ends) const {
    const glm::dvec3 along_u = at(u.slope, v.value);
    const glm::dvec3 along_v = at(u.value, v.slope);
    const glm::dvec3 mixed = at(u.slope, v.slope);
    constexpr double kNothing = 1e-9;
    glm::dvec3 across = glm::cross(along_u, along_v);
    if (glm::length(along_u) < kNothing) across = glm::cross(v_ends ? -mixed : mixed, along_v);
    if (glm::length(along_v) < kNothing) across = glm::cross(along_u, u_ends ? -mixed : mixed);
    return glm::normalize(across);
  }
};

/// y up; and the middle and length of the whole surface, from handle to spout.
glm::dvec3 turned_up(const glm::dvec3& p) { return {p.x, p.z, -p.y}; }
constexpr double kLength = 6.434001;
const glm::dvec3 kCenter{0.2170005, 1.575, 0};

Patch patch_of(std::size_t index) {
  Patch patch;
  for (std::size_t k = 0; k < 16; ++k) {
    const auto& point = kTeapotPoints[kTeapotPatches[index][k]];
    patch.points[k / 4][k % 4] = turned_up({point[0], point[1], point[2]});
  }
  return patch;
}

/// What |S_uu| + 2 |S_uv| + |S_vv| is at most: differences of the control points, 3 · 2 and 3 · 3 times.
double bend_of(const Patch& patch) {
  const auto& p = patch.points;
  double bend_u = 0;
  double bend_v = 0;
  double twist = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      if (j < 2) bend_u = std::max(bend_u, glm::length(p[i][j] - 2.0 * p[i][j + 1] + p[i][j + 2]));
      if (i < 2) bend_v = std::max(bend_v, glm::length(p[i][j] - 2.0 * p[i + 1][j] + p[i + 2][j]));
      if (i < 3 && j < 3) twist = std::max(twist, glm::length(p[i][j] - p[i][j + 1] - p[i + 1][j] + p[i + 1][j + 1]));
    }
  }
  return 6 * bend_u + 2 * 9 * twist + 6 * bend_v;
}

}  // namespace

double teapot_segments(const PrimitiveOptions& options) {
  double bend = 0;
  for (std::size_t p = 0; p < kTeapotPatches.size(); ++p) bend = std::max(bend, bend_of(patch_of(p)));
  const double scale = options.size / kLength;
  return std::max(std::ceil(std::sqrt(scale * bend / (8 * static_cast<double>(*options.tolerance)))), 2.0);
}

Mesh make_teapot(const PrimitiveOptions& options) {
  const int n = *options.segments;
  std::vector<Basis> steps;
  for (int i = 0; i <= n; ++i) steps.emplace_back(i, n);
  const double scale = options.size / kLength;
  SurfaceBuilder builder;
  PointWelder welder(builder);
  for (std::size_t p = 0; p < kTeapotPatches.size(); ++p) {
    const Patch patch = patch_of(p);
    const auto add_corner = [&](int i, int j) {
      const Basis& u = steps[static_cast<std::size_t>(j)];
      const Basis& v = steps[static_cast<std::size_t>(i)];
      builder.add_corner(welder.vertex(scale * (patch.at(u.value, v.value) - kCenter)),
                         patch.normal(u, v, j == n, i == n), {static_cast<double>(j) / n, static_cast<double>(i) / n});
    };
    add_squares(builder, n, add_corner);
  }
  return builder.finish(options.smooth);
}

}  // namespace azulejo
