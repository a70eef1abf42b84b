#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>

#include "azulejo/core/run.h"

namespace azulejo {

/// A box with a center, right-handed axes of length 1 and sizes along them.
struct OrientedBox {
  glm::dvec3 center{0, 0, 0};
  std::array<glm::dvec3, 3> axes{glm::dvec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  glm::dvec3 size{0, 0, 0};
  double volume() const { return size.x * size.y * size.z; }
};

/// A small box around points: the smallest of those that have an edge along one of `directions` (of length 1), or across
/// one of the largest faces of the points' convex hull. For each of these it is the smallest, by rotating calipers around
/// the hull as seen along it; then the same is tried along the best one's own axes, as long as it helps. Of flat boxes the one with the smallest surface; without points all is 0.
///
/// points  finite
/// faces   500, fewer where the hull has more than 2000 corners; none where more than 100 000 points may be its corners
/// Cost    that of quick_hull, and 2 · 10⁶ looks at a corner
/// Source  Toussaint, Solving geometric problems with the rotating calipers, 1983; O'Rourke, Finding minimal enclosing
///         boxes, 1985, for what the smallest box of all would take
OrientedBox oriented_box(std::span<const glm::vec3> points, std::span<const glm::dvec3> directions, const Run& run);

}  // namespace azulejo
