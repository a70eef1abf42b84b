#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <tuple>
#include <vector>

#include "azulejo/data/mesh.h"

namespace azulejo {

/// Collects the faces of a surface that is known by formula, with a normal and a texture coordinate at each corner.
class SurfaceBuilder {
 public:
  std::uint32_t add_vertex(const glm::dvec3& position) {
    mesh_.positions.emplace_back(position);
    return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
  }
  void add_corner(std::uint32_t vertex, const glm::dvec3& normal, const glm::dvec2& uv);
  /// Of the corners since the last face. Those that repeat the vertex before them are left out, and so is a face that
  /// keeps fewer than three.
  void end_face();

  /// With TEXCOORD_0, and NORMAL: that of each face where it isn't smooth; one a vertex where none has two.
  Mesh finish(bool smooth);

 private:
  void drop_corner(std::size_t corner);
  void use_face_normals();
  bool unite_normals();

  Mesh mesh_;
  std::vector<glm::vec3> normals_;  ///< of corners
  std::vector<glm::vec2> uvs_;
  std::vector<std::uint32_t> face_offsets_{0};
  bool all_triangles_ = true;
};

/// A face for each of n × n squares of a grid: add_corner(i, j) adds the corner at a place of it, i first.
template <class AddCorner>
void add_squares(SurfaceBuilder& builder, int n, AddCorner add_corner) {
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      add_corner(i, j);
      add_corner(i, j + 1);
      add_corner(i + 1, j + 1);
      add_corner(i + 1, j);
      builder.end_face();
    }
  }
}

/// Gives points that are equal as floats one vertex.
class PointWelder {
 public:
  explicit PointWelder(SurfaceBuilder& builder) : builder_(builder) {}
  std::uint32_t vertex(const glm::dvec3& position) {
    const glm::vec3 rounded(position);
    const auto [at, is_new] = known_.try_emplace({rounded.x, rounded.y, rounded.z}, 0U);  // −0 equals 0
    if (is_new) at->second = builder_.add_vertex(position);
    return at->second;
  }

 private:
  SurfaceBuilder& builder_;
  std::map<std::tuple<float, float, float>, std::uint32_t> known_;
};

}  // namespace azulejo
