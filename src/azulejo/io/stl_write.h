#pragma once

#include "azulejo/core/run.h"
#include "azulejo/data/mesh.h"
#include "azulejo/io/model_io.h"
#include "azulejo/io/output.h"

namespace azulejo {

/// Binary, or text with options.ascii; unit normals from the winding, 0 where a triangle has no area. Faces of more
/// than three corners become fans around their first, which is right for convex ones only; fewer than three are left
/// out, with a warning. Colours of faces (COLOR_0, u8) are kept in binary, 5 bits a channel, as VisCAM writes them.
void write_stl(Output& output, const Mesh& mesh, const ModelWriteOptions& options, const Run& run);

}  // namespace azulejo
