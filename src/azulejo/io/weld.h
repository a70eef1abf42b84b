#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "azulejo/core/run.h"
#include "azulejo/data/array.h"

namespace azulejo {

/// Positions that occur once, and which of them each corner has.
struct Welded {
  Array<glm::vec3> positions;
  Array<std::uint32_t> corners;
};

/// Makes one vertex of all corners at exactly equal positions. -0 equals 0; a position with a NaN equals none. Vertices
/// are in the order of their first corner and have its very bytes, for any number of threads.
/// At most 2³² − 2 corners.
///
/// Cost  O(corners) for any input, 32 bytes a corner beside the result
Welded weld_exactly(std::span<const glm::vec3> corners, const Run& run);

/// What positions are told apart by before they are compared; equal for -0 and 0.
std::uint64_t position_hash(const glm::vec3& position);

}  // namespace azulejo
