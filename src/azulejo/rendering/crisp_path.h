#pragma once

#include <glm/mat3x2.hpp>

#include "azulejo/data/array.h"
#include "azulejo/data/drawing.h"
#include "azulejo/math/rect.h"
#include "azulejo/modelling/flat_path.h"
#include "azulejo/rendering/crisp_line.h"

namespace azulejo {

struct CrispOptions {
  float tolerance = 0.1F;  ///< of curves, in pixels
  Rect window;             ///< pixels of the picture; others are left out
};

/// Appends a path's line as it was drawn before there were grays: pixels that are covered or not, one wide whatever the
/// style's width, joins and caps.
///
/// Lines       from the pixel that a point is in to the next one's, as Bresenham has it. A pixel where two segments of a
///             subpath meet belongs to the later one, the last pixel of an open one is drawn: each once. A subpath that
///             stays in a pixel is that pixel
/// Dashes      are counted in pixels along the longer axis, as OpenGL counts a line's stipple, from the subpath's
///             beginning: pixel s of it is drawn where the pattern, at s + ½, is on. Lengths in the path's units are
///             multiplied by the square root of what the matrix does to areas
/// Far away    coordinates beyond ±10¹² pixels count as that; of a segment with a point beyond ±2²⁸ pixels the part within
///             is drawn, as a line from where it comes in
/// Cost        O(segments + dashes in the window)
/// Source      Bresenham, Algorithm for computer control of a digital plotter (1965)
void crisp_path(const PathView& path, const DrawingStyle& style, const glm::mat3x2& picture_from_path,
                const CrispOptions& options, FlatPath& scratch, Array<CrispLine>& result);

}  // namespace azulejo
