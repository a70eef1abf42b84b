#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/drawing.h"
#include "azulejo/modelling/polygon.h"

namespace azulejo {

struct OffsetOptions {
  float distance = 1;               ///< outwards; negative: inwards
  LineJoin join = LineJoin::Round;  ///< of corners that turn away
  float miter_limit = 4;            ///< a miter that reaches further than this times the distance becomes a bevel
  float tolerance = 0.1F;           ///< how far lines may be from round corners, and from curves of a drawing
};

/// What is within a distance of the inside of a polygon; with a negative one, what is further than that from the
/// outside. With round corners these are the exact sets, but for the tolerance; miters and bevels replace the rounds
/// only. Holes close, parts vanish or fall apart as they must. Rings as `simplified` gives them.
///
/// How     a rectangle along each side and a corner piece, as triangles, are united with the polygon or taken from it
/// Throws  as polygon.h; Error(Argument) for an option out of range
AZULEJO_EXPORT Polygon offset(const Polygon& polygon, const OffsetOptions& options, FillRule rule = FillRule::NonZero,
                              const Run& run = {});

/// The same with each path that a drawing fills, in units of its page; transformations and opacities of groups are
/// done. Lines, points and clips are left out (`run.warn` says so), fills and the order of painting are kept.
AZULEJO_EXPORT Drawing offset(const Drawing& drawing, const OffsetOptions& options = {}, const Run& run = {});

}  // namespace azulejo
