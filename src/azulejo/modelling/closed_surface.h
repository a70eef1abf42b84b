#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/data/mesh.h"

namespace azulejo {

using SurfaceTriangle = std::array<glm::vec3, 3>;

/// The triangles of a mesh, and what closes them: every edge is run along as often in one direction as in the other by
/// both together.
struct ClosedSurface {
  std::vector<SurfaceTriangle> triangles;  ///< without those with a coordinate that isn't finite
  std::vector<SurfaceTriangle> lids;       ///< of vertices of the borders: few large ones, small ones along the borders
  std::size_t open_edges = 0;              ///< that are run along more often in one direction
};

/// Vertices at exactly equal positions are one. Faces are divided as `triangulate` does.
ClosedSurface closed_surface(const Mesh& mesh, const Run& run);

/// A box around each.
std::vector<Box3> boxes_of(std::span<const SurfaceTriangle> triangles, const Run& run);

}  // namespace azulejo
