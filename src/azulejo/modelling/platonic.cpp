// Cube and plane, the other Platonic solids, and the sphere that grows out of the icosahedron.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "azulejo/modelling/primitive_shapes.h"
#include "azulejo/modelling/surface_builder.h"

namespace azulejo {
namespace {

using Face = std::vector<std::uint32_t>;

struct Solid {
  std::vector<glm::dvec3> points;  ///< at distance 1
  std::vector<Face> faces;         ///< counter-clockwise from outside
};

std::vector<glm::dvec3> normalized(std::vector<glm::dvec3> points) {
  for (glm::dvec3& each : points) each = glm::normalize(each);
  return points;
}

glm::dvec3 center_of(const Solid& solid, const Face& face) {
  glm::dvec3 sum(0);
  for (const std::uint32_t each : face) sum += solid.points[each];
  return sum / static_cast<double>(face.size());
}

/// The solid whose faces are the triangles of points that lie nearest to each other.
Solid triangle_solid(std::vector<glm::dvec3> points) {
  Solid solid;
  solid.points = normalized(std::move(points));
  const auto& p = solid.points;
  double edge = 4;
  for (std::size_t i = 1; i < p.size(); ++i) edge = std::min(edge, glm::distance(p[0], p[i]));
  const auto joined = [&](std::uint32_t i, std::uint32_t j) { return glm::distance(p[i], p[j]) < 1.1 * edge; };
  const auto count = static_cast<std::uint32_t>(p.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    for (std::uint32_t j = i + 1; j < count; ++j) {
      for (std::uint32_t k = j + 1; k < count; ++k) {
        if (!joined(i, j) || !joined(j, k) || !joined(k, i)) continue;
        const bool outward = glm::dot(glm::cross(p[j] - p[i], p[k] - p[i]), p[i]) > 0;
        solid.faces.push_back(outward ? Face{i, j, k} : Face{i, k, j});
      }
    }
  }
  return solid;
}

/// A point for each face, a face for each point.
Solid dual(const Solid& solid) {
  Solid result;
  for (const Face& each : solid.faces) result.points.push_back(glm::normalize(center_of(solid, each)));
  for (std::uint32_t v = 0; v < solid.points.size(); ++v) {
    Face around;
    for (std::uint32_t f = 0; f < solid.faces.size(); ++f) {
      if (std::find(solid.faces[f].begin(), solid.faces[f].end(), v) != solid.faces[f].end()) around.push_back(f);
    }
    const glm::dvec3 axis = solid.points[v];
    const glm::dvec3 x = glm::normalize(result.points[around[0]] - axis * glm::dot(axis, result.points[around[0]]));
    const glm::dvec3 y = glm::cross(axis, x);
    const auto angle = [&](std::uint32_t f) {
      const double turned = std::atan2(glm::dot(result.points[f], y), glm::dot(result.points[f], x));
      return turned < -1e-9 ? turned + 2 * std::numbers::pi : turned;
    };
    std::sort(around.begin(), around.end(), [&](std::uint32_t a, std::uint32_t b) { return angle(a) < angle(b); });
    result.faces.push_back(std::move(around));
  }
  return result;
}

Solid icosahedron() {
  constexpr double kGolden = std::numbers::phi;
  std::vector<glm::dvec3> points;
  for (const double a : {1.0, -1.0}) {
    for (const double b : {kGolden, -kGolden}) {
      points.emplace_back(a, b, 0);
      points.emplace_back(0, a, b);
      points.emplace_back(b, 0, a);
    }
  }
  return triangle_solid(std::move(points));
}

Solid octahedron() { return triangle_solid({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}); }

/// By its corners ±1: bits 0, 1, 2 of an index are x, y, z. The first corner of a side is its lower left.
Solid cube() {
  Solid solid;
  for (int i = 0; i < 8; ++i) solid.points.emplace_back((i & 1) * 2 - 1, (i & 2) - 1, (i & 4) / 2 - 1);
  solid.faces = {{4, 5, 7, 6}, {1, 0, 2, 3}, {5, 1, 3, 7}, {0, 4, 6, 2}, {6, 7, 3, 2}, {0, 1, 5, 4}};
  return solid;
}

/// Where a face's corner lies on the texture: that of a regular polygon with its first side at the bottom.
glm::dvec2 uv_of(std::size_t corner, std::size_t count) {
  const double step = 2 * std::numbers::pi / static_cast<double>(count);
  const double angle = step * (static_cast<double>(corner) - 0.5) - std::numbers::pi / 2;
  const double reach = count == 4 ? std::numbers::sqrt2 / 2 : 0.5;  // a quad takes all of it
  const glm::dvec2 uv(0.5 + reach * std::cos(angle), 0.5 - reach * std::sin(angle));
  return glm::clamp(uv, 0.0, 1.0);
}

/// The faces of a solid, flat.
Mesh mesh_of(const Solid& solid, double scale) {
  SurfaceBuilder builder;
  for (const glm::dvec3& each : solid.points) builder.add_vertex(scale * each);
  for (const Face& face : solid.faces) {
    const glm::dvec3 normal = glm::normalize(center_of(solid, face));
    for (std::size_t i = 0; i < face.size(); ++i) builder.add_corner(face[i], normal, uv_of(i, face.size()));
    builder.end_face();
  }
  return builder.finish(true);
}

struct SphereTriangle {
  std::array<std::uint32_t, 3> corners;
  std::array<glm::dvec2, 3> uvs;
};

/// Cuts every triangle in four; the middle of an edge is one point for both of its sides.
void subdivide(std::vector<glm::dvec3>& points, std::vector<SphereTriangle>& triangles) {
  std::unordered_map<std::uint64_t, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const std::uint64_t edge = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    const auto [at, is_new] = middles.try_emplace(edge, static_cast<std::uint32_t>(points.size()));
    if (is_new) points.push_back(glm::normalize(points[a] + points[b]));
    return at->second;
  };
  std::vector<SphereTriangle> finer;
  finer.reserve(4 * triangles.size());
  for (const auto& [corner, uv] : triangles) {
    const std::uint32_t m[3] = {middle(corner[0], corner[1]), middle(corner[1], corner[2]),
                                middle(corner[2], corner[0])};
    const glm::dvec2 n[3] = {0.5 * (uv[0] + uv[1]), 0.5 * (uv[1] + uv[2]), 0.5 * (uv[2] + uv[0])};
    finer.push_back({{corner[0], m[0], m[2]}, {uv[0], n[0], n[2]}});
    finer.push_back({{m[0], corner[1], m[1]}, {n[0], uv[1], n[1]}});
    finer.push_back({{m[2], m[1], corner[2]}, {n[2], n[1], uv[2]}});
    finer.push_back({{m[0], m[1], m[2]}, {n[0], n[1], n[2]}});
  }
  triangles = std::move(finer);
}

/// The icosahedron's faces, each with a triangle of the texture: four rows of five.
std::vector<SphereTriangle> with_pieces_of_texture(const Solid& solid) {
  std::vector<SphereTriangle> triangles;
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    const std::size_t full_rows = f / 5;
    const auto column = static_cast<double>(f % 5);
    const auto row = static_cast<double>(full_rows);
    const Face& face = solid.faces[f];
    triangles.push_back({{face[0], face[1], face[2]},
                         {glm::dvec2(column / 5, (row + 1) / 4), glm::dvec2((column + 1) / 5, (row + 1) / 4),
                          glm::dvec2((column + 0.5) / 5, row / 4)}});
  }
  return triangles;
}

}  // namespace

Mesh make_cube(const PrimitiveOptions& options) { return mesh_of(cube(), 0.5 * options.size); }

Mesh make_platonic(const PrimitiveOptions& options) {
  switch (options.kind) {
    case PrimitiveKind::Tetrahedron:
      return mesh_of(triangle_solid({{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}}), options.radius);
    case PrimitiveKind::Octahedron: return mesh_of(octahedron(), options.radius);
    case PrimitiveKind::Dodecahedron: return mesh_of(dual(icosahedron()), options.radius);
    default: return mesh_of(icosahedron(), options.radius);
  }
}

Mesh make_plane(const PrimitiveOptions& options) {
  SurfaceBuilder builder;
  const auto columns = static_cast<std::uint32_t>(*options.segments);
  const auto rows = static_cast<std::uint32_t>(*options.rings);
  const auto uv = [&](std::uint32_t x, std::uint32_t z) {
    return glm::dvec2(static_cast<double>(x) / columns, static_cast<double>(z) / rows);
  };
  for (std::uint32_t z = 0; z <= rows; ++z) {
    for (std::uint32_t x = 0; x <= columns; ++x) {
      builder.add_vertex(static_cast<double>(options.size) * glm::dvec3(uv(x, z).x - 0.5, 0, uv(x, z).y - 0.5));
    }
  }
  const auto add_corner = [&](std::uint32_t x, std::uint32_t z) {
    builder.add_corner(z * (columns + 1) + x, {0, 1, 0}, uv(x, z));
  };
  for (std::uint32_t z = 0; z < rows; ++z) {
    for (std::uint32_t x = 0; x < columns; ++x) {
      add_corner(x, z + 1);
      add_corner(x + 1, z + 1);
      add_corner(x + 1, z);
      add_corner(x, z);
      builder.end_face();
    }
  }
  return builder.finish(true);
}

Mesh make_ico_sphere(const PrimitiveOptions& options) {
  Solid solid = icosahedron();
  std::vector<SphereTriangle> triangles = with_pieces_of_texture(solid);
  for (int i = 0; i < options.subdivisions; ++i) subdivide(solid.points, triangles);
  SurfaceBuilder builder;
  for (const glm::dvec3& each : solid.points) builder.add_vertex(static_cast<double>(options.radius) * each);
  for (const auto& [corners, uvs] : triangles) {
    for (std::size_t i = 0; i < 3; ++i) builder.add_corner(corners[i], solid.points[corners[i]], uvs[i]);
    builder.end_face();
  }
  return builder.finish(options.smooth);
}

}  // namespace azulejo
