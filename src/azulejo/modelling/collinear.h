#pragma once

#include <glm/vec3.hpp>

#include "azulejo/math/predicates.h"

namespace azulejo {

/// Whether three points lie on one line: exactly, as their shadows along all three axes do.
inline bool collinear(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    if (orient2d({a[u], a[v]}, {b[u], b[v]}, {c[u], c[v]}) != 0) return false;
  }
  return true;
}

}  // namespace azulejo
