#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "azulejo/core/run.h"

namespace azulejo {

/// The corners of the convex hull of points in a plane, counter-clockwise with y up, from the one with the least x (of
/// those, the least y). Exact for floats: no three of them are collinear, no point is outside. Of points at the same
/// place the first counts. All on a line: its two ends; all at one place: one; none: none.
///
/// points  finite
/// Cost    O(n log n); sorting is on all threads
/// Source  Andrew, Another efficient algorithm for convex hulls in two dimensions, 1979
std::vector<std::uint32_t> plane_hull(std::span<const glm::vec2> points, const Run& run);

}  // namespace azulejo
