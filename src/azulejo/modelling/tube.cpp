// Tubes along curves: through points, and the torus knot.
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "azulejo/core/error.h"
#include "azulejo/math/bezier.h"
#include "azulejo/math/catmull_rom.h"
#include "azulejo/math/turns.h"
#include "azulejo/modelling/parametric_grid.h"
#include "azulejo/modelling/primitive_shapes.h"

namespace azulejo {
namespace {

/// A place of the tube's curve: the tube is around it, in the plane of x and y, which are unit vectors.
struct TubeRing {
  glm::dvec3 center;
  glm::dvec3 along;  ///< unit
  glm::dvec3 x;
  glm::dvec3 y;
};

/// v runs along the tube from its end to its beginning, so that textures stand upright on a tube that rises.
Mesh tube_mesh(const std::vector<TubeRing>& rings, const PrimitiveOptions& options, bool closed) {
  SurfaceBuilder builder;
  const auto last = static_cast<double>(rings.size() - 1);
  const ParametricGrid grid{
      .columns = *options.segments, .rows = static_cast<int>(rings.size()) - 1, .wrap_u = true, .wrap_v = closed};
  const GridVertices vertices = add_grid(builder, grid, [&](double u, double v) {
    const TubeRing& ring = rings[static_cast<std::size_t>(std::lround((1 - v) * last))];
    const Turn turn = turn_at(u);
    const glm::dvec3 out = turn.cosine * ring.x + turn.sine * ring.y;
    return SurfacePlace{ring.center + static_cast<double>(options.tube_radius) * out, out};
  });
  if (!closed) {
    const auto segments = static_cast<std::size_t>(*options.segments);
    for (const bool first : {false, true}) {
      const glm::dvec3 normal = first ? -rings.front().along : rings.back().along;
      for (std::size_t k = 0; k < segments; ++k) {
        const std::size_t i = first ? segments - 1 - k : k;
        const Turn turn = turn_of(static_cast<std::int64_t>(i), static_cast<std::int64_t>(segments));
        builder.add_corner(vertices[first ? vertices.size() - 1 : 0][i], normal,
                           {0.5 + 0.5 * turn.cosine, 0.5 + (first ? 0.5 : -0.5) * turn.sine});
      }
      builder.end_face();
    }
  }
  return builder.finish(options.smooth);
}

/// Any unit vector across another.
glm::dvec3 across(const glm::dvec3& along) {
  const glm::dvec3 other = std::abs(along.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return glm::normalize(glm::cross(along, other));
}

glm::dvec3 mirrored(const glm::dvec3& v, const glm::dvec3& by) {
  const double square = glm::dot(by, by);
  return square == 0 ? v : v - 2 * glm::dot(v, by) / square * by;
}

/// Carries x along the curve by two reflections from place to place, so that it doesn't turn about it.
void carry_frames(std::vector<TubeRing>& rings) {
  rings[0].x = across(rings[0].along);
  for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
    const glm::dvec3 step = rings[i + 1].center - rings[i].center;
    const glm::dvec3 along = mirrored(rings[i].along, step);
    const glm::dvec3 x = mirrored(mirrored(rings[i].x, step), rings[i + 1].along - along);
    rings[i + 1].x = glm::normalize(x - glm::dot(x, rings[i + 1].along) * rings[i + 1].along);
  }
  for (TubeRing& each : rings) each.y = glm::cross(each.along, each.x);
}

/// Spreads evenly the angle by which the frame comes back turned.
void close_frames(std::vector<TubeRing>& rings) {
  const TubeRing& first = rings.front();
  const TubeRing& last = rings.back();
  const double angle = std::atan2(glm::dot(last.x, first.y), glm::dot(last.x, first.x));
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const double part = -angle * static_cast<double>(i) / static_cast<double>(rings.size() - 1);
    const glm::dvec3 x = std::cos(part) * rings[i].x + std::sin(part) * rings[i].y;
    rings[i].y = glm::cross(rings[i].along, x);
    rings[i].x = x;
  }
}

std::vector<glm::dvec3> points_of(const PrimitiveOptions& options) {
  const std::size_t count = options.points.size() / 3;
  if (options.points.size() % 3 != 0 || count < 2) {
    throw Error(Error::Argument, fmt::format("primitive: tube: {} numbers in points, expected x, y and z of 2 or more",
                                             options.points.size()));
  }
  std::vector<glm::dvec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    points.emplace_back(options.points[3 * i], options.points[3 * i + 1], options.points[3 * i + 2]);
  }
  return points;
}

}  // namespace

Mesh make_tube(const PrimitiveOptions& options) {
  const auto pieces = catmull_rom<glm::dvec3>(points_of(options), options.closed, SplineTiming::Centripetal);
  if (pieces.empty() || (options.closed && pieces.size() < 3)) {
    throw Error(Error::Argument, fmt::format("primitive: tube: {} pieces between different points, expected {} or more",
                                             pieces.size(), options.closed ? 3 : 1));
  }
  std::vector<TubeRing> rings;
  const auto add = [&](const std::array<glm::dvec3, 4>& piece, double t) {
    const glm::dvec3 along = bezier_derivative<glm::dvec3>(piece, t);
    const bool stands = glm::length(along) < 1e-12 * glm::distance(piece[0], piece[3]);
    rings.push_back({bezier_point<glm::dvec3>(piece, t), glm::normalize(stands ? piece[3] - piece[0] : along), {}, {}});
  };
  for (const auto& piece : pieces) {
    for (int k = 0; k < *options.rings; ++k) add(piece, static_cast<double>(k) / *options.rings);
  }
  add(pieces.back(), 1);
  carry_frames(rings);
  if (options.closed) close_frames(rings);
  return tube_mesh(rings, options, options.closed);
}

/// On a torus whose tube is half as thick as its ring is wide; x points away from that tube's middle.
Mesh make_torus_knot(const PrimitiveOptions& options) {
  const double thick = 0.5 * options.radius;
  std::vector<TubeRing> rings;
  for (int k = 0; k <= *options.rings; ++k) {
    const double share = static_cast<double>(k) / *options.rings;
    const auto [c, s] = turn_at(share * options.around);
    const auto [tube_c, tube_s] = turn_at(share * options.through);
    const glm::dvec3 out(c, 0, -s);
    const glm::dvec3 on(-s, 0, -c);
    const double reach = options.radius + thick * tube_c;
    TubeRing ring;
    ring.center = reach * out + glm::dvec3(0, thick * tube_s, 0);
    ring.along = glm::normalize(options.around * reach * on +
                                options.through * thick * (-tube_s * out + glm::dvec3(0, tube_c, 0)));
    ring.x = tube_c * out + glm::dvec3(0, tube_s, 0);
    ring.y = glm::cross(ring.along, ring.x);
    rings.push_back(ring);
  }
  return tube_mesh(rings, options, true);
}

}  // namespace azulejo
