#pragma once

// For tests only: small scenes, and where their points land in a picture.

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

#include "azulejo/data/scene.h"
#include "azulejo/rendering/view.h"

namespace azulejo {

/// Corners of a box.
inline std::vector<glm::vec3> box_corners(const glm::vec3& lower, const glm::vec3& upper) {
  std::vector<glm::vec3> corners;
  for (unsigned c = 0; c < 8; ++c) {
    corners.emplace_back((c & 1U) != 0 ? upper.x : lower.x, (c & 2U) != 0 ? upper.y : lower.y,
                         (c & 4U) != 0 ? upper.z : lower.z);
  }
  return corners;
}

/// A scene of vertices without faces.
inline Scene scene_of_points(const std::vector<glm::vec3>& points, UpAxis up = UpAxis::Y) {
  Mesh mesh;
  mesh.positions.assign(points.begin(), points.end());
  mesh.space.up = up;
  return scene_of(std::move(mesh));
}

/// A closed box of 12 triangles, counter-clockwise seen from outside.
inline Mesh box_mesh(const glm::vec3& lower, const glm::vec3& upper) {
  Mesh mesh;
  const std::vector<glm::vec3> corners = box_corners(lower, upper);
  mesh.positions.assign(corners.begin(), corners.end());
  for (const unsigned corner : {0U, 2U, 1U, 1U, 2U, 3U, 4U, 5U, 6U, 5U, 7U, 6U, 0U, 1U, 4U, 1U, 5U, 4U,
                                2U, 6U, 3U, 3U, 6U, 7U, 0U, 4U, 2U, 2U, 4U, 6U, 1U, 3U, 5U, 3U, 7U, 5U}) {
    mesh.corners.push_back(corner);
  }
  return mesh;
}

/// Where a point lands: pixels from the top left of the picture, and w.
inline glm::dvec3 pixel_of(const View& view, const glm::vec3& point) {
  const glm::dvec4 clip = glm::dmat4(view.clip_from_view) * (glm::dmat4(view.view_from_world) * glm::dvec4(point, 1.0));
  const glm::dvec4 ndc = clip / clip.w;
  return {view.viewport.x + 0.5 * (1 + ndc.x) * view.viewport.width,
          view.viewport.y + 0.5 * (1 - ndc.y) * view.viewport.height, clip.w};
}

/// The depth that a z-buffer sees: 1 near, 0 far.
inline double depth_of(const View& view, const glm::vec3& point) {
  const glm::dvec4 clip = glm::dmat4(view.clip_from_view) * (glm::dmat4(view.view_from_world) * glm::dvec4(point, 1.0));
  return clip.z / clip.w;
}

}  // namespace azulejo
