#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "azulejo/modelling/quick_hull.h"

namespace azulejo {

/// Polygons, one after the other; their corners are indices of points.
struct HullPolygons {
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> offsets{0};  ///< the first corner of each, and the end
  std::span<const std::uint32_t> operator[](std::size_t polygon) const {
    return {corners.data() + offsets[polygon], offsets[polygon + 1] - offsets[polygon]};
  }
};

/// The faces of a hull of dimension 3: triangles that lie in one plane united, points in the middle of edges and faces
/// left out, all by exact determinants. Counter-clockwise seen from outside. Cost O(facets)
HullPolygons hull_polygons(std::span<const glm::vec3> points, const QuickHull& hull);

}  // namespace azulejo
