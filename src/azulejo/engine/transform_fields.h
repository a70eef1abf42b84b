#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <vector>

#include "azulejo/engine/field.h"
#include "azulejo/engine/report.h"
#include "azulejo/math/transform_steps.h"

namespace azulejo {

/// The TransformOptions in an options' struct.
using TransformAccess = TransformOptions& (*)(void* options);

/// The fields that append to `steps`, in the order in which they are given: translate, rotate_deg, scale, shear,
/// reflect, matrix; those that are for the step before them: about, axis; and inverse, convention.
std::vector<Field> picture_transform_fields(TransformAccess access);
std::vector<Field> space_transform_fields(TransformAccess access);

/// What a transformation is: its class, matrix (rows), determinant, and what it decomposes into, angles in degrees.
/// Of pictures they are counter-clockwise as seen, with y down.
Report picture_transform_report(const glm::dmat3& target_from_source);
Report space_transform_report(const glm::dmat4& target_from_source);

}  // namespace azulejo
