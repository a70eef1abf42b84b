#pragma once

#include <vector>

#include "azulejo/engine/field.h"

namespace azulejo {

/// The options of CameraOptions, for operations that have one.
std::vector<Field> camera_fields();

}  // namespace azulejo
