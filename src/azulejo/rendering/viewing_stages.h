#pragma once

#include <string>

#include "azulejo/core/run.h"
#include "azulejo/data/scene.h"
#include "azulejo/rendering/view.h"

namespace azulejo {

/// Reports the viewing transformation step by step to `run.stages`; does nothing where nobody looks.
///
/// step       name of the operation
/// world      the scene as one mesh; then the same mesh as each step leaves it:
/// view       seen from the camera, which looks along −z, y up
/// ndc        after the projection and the division by w: what is seen is in −1…1, y up; z is 1 near, 0 far. Vertices
///            behind the camera are NaN
/// viewport   x and y in pixels from the top left of the picture, y down
/// matrices   report: those of each step, row by row; the viewport's also as its two steps and the flip
void report_viewing(const Scene& scene, const View& view, const std::string& step, const Run& run);

}  // namespace azulejo
