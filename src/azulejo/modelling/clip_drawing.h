#pragma once

#include <glm/vec4.hpp>
#include <optional>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/drawing.h"

namespace azulejo {

struct ClipOptions {
  std::optional<glm::vec4> window;  ///< left, top, right, bottom, in units of the page; none: the page
  float tolerance = 0.1F;           ///< of the drawing's unit: how far lines may be from curves
};

/// What of a drawing is in a window. Fills become new outlines along the window's sides, parts that are apart rings of
/// their own, as `simplified` of polygon.h gives them; lines end there and get no line along the sides.
///
/// paths        of a path that is filled and has a line two paths, the line on top; both have its id. Transformations of
///              groups are done: widths of lines and dashes are scaled by the square root of the area's scale, and dashes
///              go on where they were
/// left out     marks at points; clips of the drawing (`run.warn` says so); what is empty then
/// not finite   a line to or from such a point is left out; of an outline, the point is
/// Throws       Error(Argument) for a window whose left isn't below its right, or top below bottom; as polygon.h
AZULEJO_EXPORT Drawing clip(const Drawing& drawing, const ClipOptions& options = {}, const Run& run = {});

}  // namespace azulejo
