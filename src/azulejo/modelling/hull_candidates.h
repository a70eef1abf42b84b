#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "azulejo/core/run.h"

namespace azulejo {

/// Leaves out points that can't be corners of the convex hull, most of them as a rule: those strictly inside the hull of
/// a sample. Rising; all points where the sample's hull is flat or nearly so.
///
/// points  finite
/// How     the faces of a cube around the middle of the sample's hull have grids; a node knows how near the hull is in
///         its direction. One over that is a convex function on a face: it is largest at the corners of a cell
/// Cost    O(n), a few nanoseconds a point, on all threads
std::vector<std::uint32_t> hull_candidates(std::span<const glm::vec3> points, const Run& run);

}  // namespace azulejo
