#pragma once

#include "azulejo/core/run.h"
#include "azulejo/data/mesh.h"
#include "azulejo/modelling/subdivide.h"

namespace azulejo::subdivision {

/// The mesh that a scheme works on: without faces and corners that are degenerate, of triangles where it wants them,
/// without attributes that it drops. `face_offsets` are empty if all faces are triangles.
Mesh source_of(const Mesh& mesh, SubdivisionScheme scheme, const Run& run);

}  // namespace azulejo::subdivision
