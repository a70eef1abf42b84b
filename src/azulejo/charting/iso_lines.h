#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/data/view.h"

namespace azulejo {

/// Polylines, one behind the other.
struct IsoLines {
  std::vector<glm::vec2> points;
  std::vector<std::size_t> starts{0};  ///< of each line, and the number of points
  std::vector<std::uint8_t> closed;    ///< of each line: the last point is joined to the first, which isn't repeated

  std::size_t size() const { return closed.size(); }
};

/// Lines along which a field has a value.
///
/// field   samples on a grid, between which values run linearly along its lines; one channel
/// Result  places in samples: (0, 0) is the first one. What is above the level (or has it) is on the left, as seen with
///         y down. In the order of their uppermost, then leftmost cells; each line is closed, or ends at the edge of the
///         field or of samples that are not finite
/// Saddles are decided by the bilinear value in the cell's middle of the saddle
/// Error   of a smooth field: at most a quarter of its second derivative ÷ slope, in samples (linear interpolation)
/// Cost    O(samples + points), a byte a sample
/// Source  W. Lorensen, H. Cline, Marching cubes, 1987, in two dimensions; G. Nielson, B. Hamann, The asymptotic decider,
///         1991
AZULEJO_EXPORT IsoLines iso_lines(const ImageView<const float>& field, float level);

}  // namespace azulejo
