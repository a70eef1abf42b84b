#pragma once

#include <glm/mat3x2.hpp>

#include "azulejo/data/drawing.h"
#include "azulejo/modelling/flat_path.h"

namespace azulejo {

/// Appends a mark at each point of a path where a segment begins or ends, in pixels of the picture: to be filled by the
/// non-zero rule. All are `summed`.
///
/// Shapes      as wide as style.point_size: a circle (a polygon within the tolerance), a square, a diamond on its corner, a
///             triangle as high as wide that points up, a plus and a cross with bars of a quarter of the width; the
///             cross is the plus turned by an eighth, and as wide
/// Left out    points that are not finite, a Move that nothing follows, marks that lie wholly outside of the window
/// Once        where a closed subpath begins
/// Cost        O(points)
void point_marks(const PathView& path, const DrawingStyle& style, const glm::mat3x2& picture_from_path, float tolerance,
                 const Box2& window, FlatPath& result);

}  // namespace azulejo
