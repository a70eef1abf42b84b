#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <span>

#include "azulejo/core/export.h"
#include "azulejo/data/drawing.h"

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

}  // namespace azulejo
