#pragma once

#include "azulejo/rendering/shade.h"

namespace azulejo {

/// Fills in the surface of a batch from its material, the mesh's colours and texture coordinates: base colour, opacity,
/// and what else the material has; normal maps turn `normal`. Wants weights, with derivatives where there are textures.
/// uv  TEXCOORD_0 is wanted too
void make_surface(FragmentBatch& batch, bool uv);

}  // namespace azulejo
