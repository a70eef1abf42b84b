#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <span>

#include "azulejo/core/export.h"
#include "azulejo/data/drawing.h"
#include "azulejo/modelling/polygon.h"

namespace azulejo {

struct LineSegment2 {
  glm::vec2 from{0, 0};
  glm::vec2 to{0, 0};
  friend bool operator==(const LineSegment2&, const LineSegment2&) = default;
};

/// The part of a segment that lies in a window, its border included; nothing where there is none, or where a coordinate
/// isn't finite. It keeps its direction; ends inside are kept as they are, others are computed in doubles and rounded
/// once, within the rectangle.
///
/// Source  Liang, Barsky, A new concept and method for line clipping, 1984
AZULEJO_EXPORT std::optional<LineSegment2> clip(const LineSegment2& segment, const Box2& window);

/// The same by codes of the nine areas around the window: Cohen and Sutherland's method, as a second opinion (Newman,
/// Sproull, Principles of interactive computer graphics, 2nd ed., 5.2).
AZULEJO_EXPORT std::optional<LineSegment2> clip_by_codes(const LineSegment2& segment, const Box2& window);

/// The same in a convex ring that turns counter-clockwise with y up; of another ring the result means nothing. Nothing
/// for a ring without points.
/// Source  Cyrus, Beck, Generalized two- and three-dimensional clipping, 1978
AZULEJO_EXPORT std::optional<LineSegment2> clip(const LineSegment2& segment, std::span<const glm::vec2> convex_ring);

/// The rings of a polygon, clipped one by one: in the window the windings are what they were, elsewhere there are none.
/// Parts of a ring that are apart stay joined by lines along the sides of the window, there and back, which `simplified`
/// takes away. Points that aren't finite are left out, and rings of which fewer than three points are left.
///
/// Source  Sutherland, Hodgman, Reentrant polygon clipping, 1974
AZULEJO_EXPORT Polygon clip(const Polygon& polygon, const Box2& window);

}  // namespace azulejo
