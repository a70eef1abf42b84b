#pragma once

#include <cstddef>

#include "azulejo/core/export.h"
#include "azulejo/data/scene.h"

namespace azulejo {

/// The scene with its nodes placed as an animation has them at a time; before its first and after its last key they
/// stand still.
///
/// Throws  Error(Argument) for an animation that is not there or a time that is not finite; Error(Data) where keys and
///         values don't fit, or a matrix is animated
/// Source  glTF 2.0 specification, appendix C
AZULEJO_EXPORT Scene animate(const Scene& scene, std::size_t animation, float seconds);

}  // namespace azulejo
