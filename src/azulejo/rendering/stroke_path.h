#pragma once

#include <glm/mat3x2.hpp>
#include <limits>

#include "azulejo/data/drawing.h"
#include "azulejo/modelling/flat_path.h"
#include "azulejo/rendering/stroke_pen.h"

namespace azulejo {

struct StrokeOptions {
  float tolerance = 0.1F;  ///< of curves, round joins and round caps, in pixels
  /// What of the picture is looked at: outlines may be missing or wrong where they lie outside.
  Box2 window{glm::vec2(-std::numeric_limits<float>::infinity()), glm::vec2(std::numeric_limits<float>::infinity())};
};

/// Appends the outline of a path's line, in pixels of the picture: filled by the non-zero rule it is what the line covers,
/// within the tolerance.
///
/// Overlaps    all of the outline turns the same way, so where parts overlap the winding number only grows: a rasterizer
///             may add up in each pixel what the parts cover, to 1 (FlatPath::summed). That is exact but for pixels on a
///             border of one part and of another that overlap: where a line crosses itself, and inside of joins of
///             pieces that are so short that the join takes away more than 2/5 of one///
/// Line        the sweep of a segment of the style's width across the path's direction, in the path's coordinates: the
///             pen of a matrix that isn't a similarity is an ellipse. `fixed_stroke`: in the picture's coordinates.
/// Joins       where two segments meet, at the outer side; a miter beyond its limit becomes a bevel. Within a curve, at a
///             cusp, round. A closed subpath is joined at its start, an open one has caps.
/// Points      a subpath without length is a dot: a disk, or a square along the path's x axis; butt: nothing. Segments
///             without length count for nothing otherwise.
/// Thin lines  keep their area: a line of a quarter of a pixel covers at most a quarter of one, and fades.
///             Below 10⁻⁶ pixels there is none; widths beyond 10⁹ pixels count as that.
/// Dashes      each has the style's caps; those without length are dots, butt: nothing. A dash that goes on over the start
///             of a closed subpath is joined there. Every subpath begins the pattern anew. A pattern shorter than a
///             quarter of a pixel, or of more than 2²¹ dashes in a path, becomes a solid line, narrower by the share of
///             the length that its dashes, longer by their caps, cover: the mean coverage is kept.
/// Far away    ends of lines longer than 10¹² pixels are moved to ±10¹² pixels, whatever that does to their direction.
/// Not finite  segments with such a coordinate are left out, and the line is open there.
/// Cost        O(points), of dashes O(points + dashes) in the window
/// Source      SVG 2, 13.5.7 Computing the shape of the stroke
void stroke_path(const PathView& path, const DrawingStyle& style, const glm::mat3x2& picture_from_path,
                 const StrokeOptions& options, StrokeScratch& scratch, FlatPath& result);

}  // namespace azulejo
