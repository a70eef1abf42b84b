#pragma once

#include <glm/mat3x2.hpp>
#include <limits>

#include "azulejo/data/drawing.h"
#include "azulejo/modelling/flat_path.h"

namespace azulejo {

struct FlattenOptions {
  float tolerance = 0.1F;  ///< of curves, where the matrix takes them: in pixels of a picture, in units of a page
  /// What of that is looked at: a curve that is wholly on one side of it becomes its chord.
  Box2 window{glm::vec2(-std::numeric_limits<float>::infinity()), glm::vec2(std::numeric_limits<float>::infinity())};
};

/// Appends a path as polylines, where the matrix takes it: a contour for each subpath, closed where that is.
///
/// Curves      become as many chords, at equal parameters, as keep each within the tolerance of its part of the curve
///             (and the rounding of floats); ends are exact. At most 1024 chords, so a curve that is larger than about ten
///             million tolerances leaves it; one with coordinates beyond 10¹⁸ becomes a line.
/// Not finite  segments with such a coordinate are left out, and a new contour begins behind them; so is a Move that nothing
///             follows. One that Close follows is a contour of one point.
/// Cost        O(points of the result)
/// Source      Wang's bound: Farin, Curves and Surfaces for CAGD, 5th ed., 6.3 (difference of curve and chord)
void flatten_path(const PathView& path, const glm::mat3x2& picture_from_path, const FlattenOptions& options,
                  FlatPath& result);

}  // namespace azulejo
