#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/mesh.h"
#include "azulejo/data/scene.h"

namespace azulejo {

/// One mesh of all that a scene shows, in world coordinates: its visible instances one after the other, in the order
/// of `walk`. What is skinned or morphed is posed first, with a warning.
///
/// mirrored    instances are turned inside out again: their faces have the other order, their tangents the other w
/// NORMAL      by the inverse transpose, unit length; TANGENT as a vector, unit length
/// attributes  those of all meshes; 0 where a mesh lacks one (COLOR_n: 1). Where they differ, the larger number of
///             components (new ones 0, the fourth of colors 1), f32 (u8 colors become linear), and one value a corner
/// NODE        u32, of each face: index of the scene's node that it comes from
/// material    of each face, an index into the scene's materials
/// Throws      Error(Resource) beyond run.limits.memory_bytes or 2^32 − 2 vertices or corners
/// Cost        O(vertices + corners) of all instances
AZULEJO_EXPORT Mesh flatten(const Scene& scene, const Run& run = {});

}  // namespace azulejo
