#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace azulejo {

/// A point of a triangle, and the square of its distance.
struct ClosestPoint {
  glm::dvec3 point{0, 0, 0};
  double squared = 0;
};

/// The point of a triangle that is nearest to p: above the triangle the foot on its plane, else the nearest on its
/// edges. The triangle may be a segment or a point. Coordinates of the size of floats neither overflow nor vanish.
/// The vectors of nearest_triangle_simd.cpp do the same in the same order.
inline ClosestPoint closest_point(const glm::dvec3& p, const std::array<glm::dvec3, 3>& triangle) {
  const std::array<glm::dvec3, 3> corner{triangle[0] - p, triangle[1] - p, triangle[2] - p};
  const glm::dvec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  ClosestPoint found;
  bool inside = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3& from = corner[i];
    const glm::dvec3 edge = corner[(i + 1) % 3] - from;
    const double length = std::max(glm::dot(edge, edge), 1e-300);
    const double along = std::min(std::max(-glm::dot(from, edge) / length, 0.0), 1.0);
    const glm::dvec3 place = from + edge * along;
    const double squared = glm::dot(place, place);
    if (i == 0 || squared < found.squared) found = {place, squared};
    inside = inside && glm::dot(glm::cross(normal, edge), from) < 0;
  }
  if (inside) {
    const double size = glm::dot(normal, normal);
    const double height = glm::dot(normal, corner[0]);
    found = {normal * (height / size), height * height / size};
  }
  found.point += p;
  return found;
}

}  // namespace azulejo
