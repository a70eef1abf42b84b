#pragma once

#include <glm/vec4.hpp>

namespace azulejo {

/// The colour of faces that have neither a material nor colours of their own, linear: a light gray.
inline constexpr glm::vec4 kNoMaterialColor{0.6F, 0.6F, 0.6F, 1.0F};

}  // namespace azulejo
