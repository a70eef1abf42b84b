#pragma once

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <string_view>

#include "azulejo/core/run.h"

namespace azulejo {

/// Turns the values of an attribute that holds directions, NORMAL or TANGENT, with the surface that they belong to, at
/// length 1; 0 stays 0. Normals stay outside, also where `linear` mirrors. What TANGENT says of handedness turns with
/// the surface, too. Values of other attributes stay.
void turn_directions(std::string_view attribute, int components, const glm::dmat3& linear, float* values,
                     std::size_t elements, const Run& run);

}  // namespace azulejo
