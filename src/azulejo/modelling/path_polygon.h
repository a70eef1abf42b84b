#pragma once

#include <functional>
#include <glm/mat3x2.hpp>
#include <span>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/data/drawing.h"
#include "azulejo/modelling/polygon.h"

namespace azulejo {

/// A path's subpaths as closed rings, where the matrix takes them. Curves become lines that are `tolerance` from them at
/// most, after the matrix: all of the same step of the curve's parameter, at most 4096.
Polygon polygon_of(const PathView& path, const glm::mat3x2& page_from_path, double tolerance);

/// The same as lines, one a subpath, and whether it is closed; those without a line are left out.
void for_each_line(const PathView& path, const glm::mat3x2& page_from_path, double tolerance,
                   const std::function<void(std::span<const glm::vec2> points, bool closed)>& take);

/// Closed subpaths, a ring each.
Path path_of(const Polygon& polygon);

/// All that a drawing fills, each path by its own rule, as rings by the non-zero rule. Clips and strokes count for
/// nothing: `run.warn` says so where there are any.
Polygon filled_area(const Drawing& drawing, double tolerance, const Run& run);

/// The style of the filled path that is painted first; of none, the default.
DrawingStyle style_of_lowest_fill(const Drawing& drawing);

/// Warns where a drawing has strokes or clips, of which only fills are taken; or clips alone.
void warn_of_unfilled(const Drawing& drawing, const Run& run);
void warn_of_clips(const Drawing& drawing, const Run& run);

}  // namespace azulejo
