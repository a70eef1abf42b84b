#pragma once

#include <glm/vec3.hpp>

#include "azulejo/core/export.h"

namespace azulejo {

/// Where a camera stands, what it looks at, and what is up in its picture.
struct CameraPose {
  glm::vec3 position{0, 0, 1};
  glm::vec3 target{0, 0, 0};
  glm::vec3 up{0, 1, 0};
};

/// Moves of a camera, as a hand on a mouse makes them. Angles in radians; where `up` and the view are parallel, an
/// axis is chosen. Positions and targets that coincide are taken to look along -z.

/// Around the target: by `azimuth` about `up`, counter-clockwise as seen from above; then by `elevation` over it,
/// which stops a hair before the poles. The distance stays.
AZULEJO_EXPORT CameraPose orbit(const CameraPose& pose, double azimuth, double elevation);
/// Sideways: position and target move to the right and up, in units.
AZULEJO_EXPORT CameraPose pan(const CameraPose& pose, double right, double up);
/// Towards the target: the distance is divided by `factor`, which must be positive. Error(Argument) if it isn't.
AZULEJO_EXPORT CameraPose dolly(const CameraPose& pose, double factor);
/// Turns the head: the target moves around the position, `yaw` to the left about `up`, `pitch` upwards, which stops a
/// hair before the poles.
AZULEJO_EXPORT CameraPose look_around(const CameraPose& pose, double yaw, double pitch);

}  // namespace azulejo
