#pragma once

#include "azulejo/core/run.h"
#include "azulejo/data/mesh.h"
#include "azulejo/io/model_io.h"
#include "azulejo/io/output.h"

namespace azulejo {

/// Text: OFF with C, N and ST before it where the vertices have COLOR_0 (u8), NORMAL and TEXCOORD_0 (v turned); colours
/// of faces behind their corners. Other attributes, lines and materials are left out, with a warning.
void write_off(Output& output, const Mesh& mesh, const ModelWriteOptions& options, const Run& run);

}  // namespace azulejo
