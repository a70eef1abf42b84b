#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/drawing.h"
#include "azulejo/modelling/polygon.h"

namespace azulejo {

struct PathBooleanOptions {
  BooleanMode mode = BooleanMode::Union;
  float tolerance = 0.1F;  ///< of the drawings' unit: how far lines may be from curves
};

/// The union, intersection, difference or exclusive or of what two drawings fill, as one path: outlines and holes as
/// `boolean` of polygon.h gives them, which with y down turn clockwise and the other way. Page, unit and fill (of the
/// lowest filled path) are the first drawing's; a drawing that fills nothing is empty.
///
/// left out  strokes, points, clips: `run.warn` says so
/// Throws    as polygon.h; Error(Argument) for an option out of range
AZULEJO_EXPORT Drawing path_boolean(const Drawing& a, const Drawing& b, const PathBooleanOptions& options = {},
                                    const Run& run = {});

}  // namespace azulejo
