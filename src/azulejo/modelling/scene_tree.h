#pragma once

#include <string>

#include "azulejo/core/export.h"
#include "azulejo/core/json.h"
#include "azulejo/data/scene.h"

namespace azulejo {

/// The nodes below the roots, a line each, children drawn in below their parents: name, mesh, camera, light, skin, and
/// how it is placed. What is deeper than 32 levels is drawn in by as much, with its depth in front.
/// Any depth. Cost O(nodes).
AZULEJO_EXPORT std::string scene_tree(const Scene& scene);

/// All nodes in order; "children" are numbers in this list, so it is flat however deep the scene is. As in glTF, what
/// a node doesn't have is left out: "mesh", "camera", "light", "skin", and the parts of its placement that do nothing.
AZULEJO_EXPORT Json nodes_json(const Scene& scene);
/// The numbers of its roots.
AZULEJO_EXPORT Json roots_json(const Scene& scene);

}  // namespace azulejo
