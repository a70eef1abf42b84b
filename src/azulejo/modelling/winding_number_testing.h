#pragma once

// What winding numbers are compared with.

#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>

#include "azulejo/data/mesh.h"

namespace azulejo {

/// The definition: the sum of the triangles' solid angles.
inline double winding_by_definition(const Mesh& mesh, const glm::dvec3& point) {
  double sum = 0;
  for (std::size_t c = 0; c + 2 < mesh.corner_count(); c += 3) {
    const auto corner = [&](std::size_t i) { return glm::dvec3(mesh.positions[mesh.corners[c + i]]) - point; };
    const glm::dvec3 u = corner(0);
    const glm::dvec3 v = corner(1);
    const glm::dvec3 w = corner(2);
    const double lu = glm::length(u);
    const double lv = glm::length(v);
    const double lw = glm::length(w);
    sum += std::atan2(glm::dot(u, glm::cross(v, w)),
                      lu * lv * lw + glm::dot(u, v) * lw + glm::dot(v, w) * lu + glm::dot(w, u) * lv);
  }
  return sum / (2 * std::numbers::pi);
}

}  // namespace azulejo
