#pragma once

#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/engine/operation.h"
#include "azulejo/rendering/render.h"

namespace azulejo {

/// What the operation `render` gives, from a scene that is prepared already: for sequences of pictures.
/// The values are in the order of its outputs; layers that weren't drawn are empty.
///
/// onto  what is drawn on; null: nothing
AZULEJO_EXPORT std::vector<Value> rendered_values(const SceneRenderer& renderer, const RenderOptions& options,
                                                  const Image* onto, const Run& run);

}  // namespace azulejo
