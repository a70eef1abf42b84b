#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/data/scene.h"
#include "azulejo/io/obj_parse.h"

namespace azulejo {

/// Makes meshes and their nodes of what an OBJ file says, as obj.h tells. `materials`: of each of data.events, for
/// those that name one.
/// Throws Error(Resource) for more objects than memory may hold. The same for any number of threads.
void build_obj(ObjData data, const std::vector<std::uint32_t>& materials, const std::string& name, const Run& run,
               Scene& scene);

}  // namespace azulejo
