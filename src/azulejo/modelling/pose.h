#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/scene.h"

namespace azulejo {

/// Whether a mesh that the scene shows or hides is skinned, or morphed by a weight other than 0.
AZULEJO_EXPORT bool needs_pose(const Scene& scene);

/// The scene as its nodes stand now: skins (linear blend) and morph weights are applied, what remains is plain meshes.
///
/// morphed  nodes keep their place and get a mesh of their own
/// skinned  meshes are in world coordinates already: each moves to a new node at the root, of the same name, and its
///          old node keeps only what else it had. Weights are divided by their sum; a vertex without weights stays
/// Throws   Error(Data) where a vertex names a joint that its skin lacks; Error(Resource) beyond limits.memory_bytes
/// Source   glTF 2.0 specification, 3.7.2.2 and 3.7.3
AZULEJO_EXPORT Scene pose(const Scene& scene, const Run& run = {});

}  // namespace azulejo
