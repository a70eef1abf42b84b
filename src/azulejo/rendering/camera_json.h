#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/json.h"
#include "azulejo/data/mesh.h"
#include "azulejo/rendering/view.h"

namespace azulejo {

/// Intrinsics and extrinsics of a picture's camera, for those who compute with it.
///
/// fx, fy, cx, cy   pixels: u = fx·X/Z + cx, v = fy·Y/Z + cy in OpenCV's camera axes (of orthographic cameras without
///                  the /Z, fx and fy in pixels a unit). u and v count from the top left corner of the picture, so the
///                  centre of the first pixel is at (0.5, 0.5): programs that put it at (0, 0) subtract 0.5.
///                  Window and viewport are in these numbers.
/// opengl, opencv   camera_from_world and world_from_camera, 4×4 by rows: x right, y up, −z forward; x right, y down,
///                  z forward
/// near, far        units; far null: infinite
/// metres_per_unit  null: unknown
AZULEJO_EXPORT Json camera_json(const View& view, const Space& space);

}  // namespace azulejo
