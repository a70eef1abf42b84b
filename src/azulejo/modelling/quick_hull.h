#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/data/array.h"

namespace azulejo {

/// The convex hull of points in space as a closed surface of triangles, exactly: no point is outside of any of them, by
/// the sign of exact determinants. Triangles may lie in one plane, and points in the middle of edges and faces may be
/// among the vertices.
struct QuickHull {
  /// Of the smallest plane, line or point that holds all: 3, 2, 1, 0; −1 without points.
  int dimension = -1;
  /// Affinely independent points, one more than `dimension`; of dimension 1 the two ends, of dimension 0 the first.
  std::vector<std::uint32_t> simplex;
  /// Of dimension 3: vertices counter-clockwise seen from outside, and the triangles across the edges that begin there.
  Array<std::array<std::uint32_t, 3>> facets;
  Array<std::array<std::uint32_t, 3>> neighbors;
};

/// points  finite; of points at the same place the first counts
/// Cost    O(n log n) for points as they come; about 100 bytes a facet and 16 a point
/// Source  Barber, Dobkin, Huhdanpaa, The quickhull algorithm for convex hulls, 1996, without its merging of facets:
///         what is seen from a point is decided exactly
QuickHull quick_hull(std::span<const glm::vec3> points, const Run& run);

}  // namespace azulejo
