#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include "azulejo/core/run.h"
#include "azulejo/math/viewport.h"
#include "azulejo/rendering/camera_basis.h"
#include "azulejo/rendering/framing.h"
#include "azulejo/rendering/view.h"

namespace azulejo {

/// How a camera projects.
struct Lens {
  bool perspective = true;
  double fov_y = 0.6;  ///< whole vertical angle, radians
  double height = 2;   ///< of orthographic cameras: what is seen from bottom to top, units
  double aspect = 1;   ///< width ÷ height
  double near = 0;     ///< distances; 0: to be chosen
  double far = 0;      ///< 0: to be chosen, unless infinite
  bool infinite = false;
  double zoom = 1;
  Window window = {};  ///< of the whole picture's −1…1: what fills the viewport
};

/// Sets the near and far planes that are not set, around the points.
void choose_depth_range(Lens& lens, const ScenePoints& points, const CameraBasis& basis, const Run& run);

/// Throws Error(Argument) for a window without area.
View view_through(const Lens& lens, const CameraBasis& basis, const glm::ivec2& size, const Rect& viewport);

}  // namespace azulejo
