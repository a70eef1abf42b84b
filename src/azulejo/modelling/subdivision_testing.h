#pragma once

// Meshes to subdivide and to smooth.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <vector>

#include "azulejo/data/mesh.h"
#include "azulejo/modelling/primitive.h"

namespace azulejo::testing {

using Polygons = std::vector<std::vector<std::uint32_t>>;

inline Mesh mesh_of(const std::vector<glm::vec3>& positions, const Polygons& faces) {
  Mesh mesh;
  mesh.positions.assign(positions.begin(), positions.end());
  mesh.face_offsets = {0};
  bool triangles = true;
  for (const auto& face : faces) {
    mesh.corners.insert(mesh.corners.end(), face.begin(), face.end());
    mesh.face_offsets.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
    triangles = triangles && face.size() == 3;
  }
  if (triangles) mesh.face_offsets.clear();
  return mesh;
}

inline Polygons faces_of(const Mesh& mesh) {
  Polygons faces;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    faces.emplace_back(mesh.corners.begin() + static_cast<std::ptrdiff_t>(mesh.face_begin(f)),
                       mesh.corners.begin() + static_cast<std::ptrdiff_t>(mesh.face_end(f)));
  }
  return faces;
}

/// The shape alone.
inline Mesh bare(PrimitiveOptions options) {
  Mesh mesh = primitive(options);
  mesh.attributes.clear();
  return mesh;
}

/// An open sheet of n × n squares of side 1, or triangles, at z = 0.
inline Mesh sheet(int n, bool triangles) {
  std::vector<glm::vec3> positions;
  Polygons faces;
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) positions.emplace_back(x, y, 0);
  }
  const auto at = [&](int x, int y) { return static_cast<std::uint32_t>(y * (n + 1) + x); };
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      if (triangles) {
        faces.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
        faces.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
      } else {
        faces.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)});
      }
    }
  }
  return mesh_of(positions, faces);
}

inline void scatter(Mesh& mesh, float by, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> step(-by, by);
  for (glm::vec3& each : mesh.positions) each += glm::vec3(step(random), step(random), step(random));
}

/// Faces of 3 (or up to 6) vertices that are picked from few: nothing about them is regular.
inline Mesh soup(unsigned seed, bool triangles) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-1, 1);
  const std::size_t vertices = 3 + random() % 12;
  std::vector<glm::vec3> positions(vertices);
  for (glm::vec3& each : positions) each = {place(random), place(random), place(random)};
  Polygons faces(random() % 25);
  for (auto& face : faces) {
    face.resize(triangles ? 3 : 1 + random() % 6);
    for (std::uint32_t& each : face) each = static_cast<std::uint32_t>(random() % vertices);
  }
  return mesh_of(positions, faces);
}

/// Signed; faces of any number of corners as fans.
inline double volume_of(const Mesh& mesh) {
  double volume = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto point = [&](std::size_t c) { return glm::dvec3(mesh.positions[mesh.corners[c]]); };
    const std::size_t begin = mesh.face_begin(f);
    for (std::size_t c = begin + 1; c + 1 < mesh.face_end(f); ++c) {
      volume += glm::dot(point(begin), glm::cross(point(c), point(c + 1))) / 6;
    }
  }
  return volume;
}

inline double area_of(const Mesh& mesh) {
  double area = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto point = [&](std::size_t c) { return glm::dvec3(mesh.positions[mesh.corners[c]]); };
    const std::size_t begin = mesh.face_begin(f);
    glm::dvec3 normal(0);
    for (std::size_t c = begin + 1; c + 1 < mesh.face_end(f); ++c) {
      normal += glm::cross(point(c) - point(begin), point(c + 1) - point(begin));
    }
    area += glm::length(normal) / 2;
  }
  return area;
}

}  // namespace azulejo::testing
