#pragma once

#include <glm/mat3x2.hpp>

#include "azulejo/core/run.h"
#include "azulejo/data/drawing.h"
#include "azulejo/modelling/polygon.h"

namespace azulejo {

/// A path's subpaths as closed rings, where the matrix takes them, as `flatten_path` makes them.
Polygon polygon_of(const PathView& path, const glm::mat3x2& page_from_path, float tolerance);

/// Closed subpaths, a ring each.
Path path_of(const Polygon& polygon);

/// All that a drawing fills, each path by its own rule, as rings by the non-zero rule. Clips and strokes count for
/// nothing: `run.warn` says so where there are any.
Polygon filled_area(const Drawing& drawing, float tolerance, const Run& run);

/// The style of a path that is taken out of its groups, into a drawing that has the same patterns: with the opacity of
/// the groups, gradients where the path is. Hatches and stipples stay as they are.
DrawingStyle placed_style(const Drawing& source, const PlacedPath& placed, Drawing& result);

/// Warns where a drawing has strokes or clips, of which only fills are taken; or clips alone.
void warn_of_unfilled(const Drawing& drawing, const Run& run);
void warn_of_clips(const Drawing& drawing, const Run& run);

}  // namespace azulejo
