#pragma once

#include "azulejo/core/run.h"
#include "azulejo/data/mesh.h"
#include "azulejo/io/model_io.h"
#include "azulejo/io/output.h"

namespace azulejo {

/// Binary, little endian, or text with options.ascii. Attributes get PLY's names where it has them (see PlyMesh), v of
/// TEXCOORD_0 is turned; others keep theirs, with _0, _1, … where they have several components. Corner attributes other
/// than TEXCOORD_0 are left out, with a warning; so are materials and morph targets.
void write_ply(Output& output, const Mesh& mesh, const ModelWriteOptions& options, const Run& run);

}  // namespace azulejo
