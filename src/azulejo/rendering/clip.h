#pragma once

#include <array>
#include <glm/vec4.hpp>

#include "azulejo/rendering/screen.h"
#include "azulejo/rendering/vertex_stage.h"

namespace azulejo {

/// What is left of a triangle inside the near and far planes and the guard band: a convex polygon, in its own sense.
struct ClippedPolygon {
  static constexpr int kMost = 3 + 6;  ///< every plane adds at most a corner
  std::array<ScreenVertex, kMost> vertices;
  int count = 0;  ///< fewer than 3: nothing is left
};

/// Cuts a triangle in homogeneous space, in double precision. Every new corner is computed from the end inside to the
/// end outside, so both triangles at an edge get the same one: no cracks.
/// Anything not finite leaves nothing.
ClippedPolygon clip_triangle(const std::array<glm::vec4, 3>& corners, const ScreenTransform& transform);

/// The same for a segment: 0 or 2 vertices.
ClippedPolygon clip_segment(const std::array<glm::vec4, 2>& ends, const ScreenTransform& transform);

}  // namespace azulejo
