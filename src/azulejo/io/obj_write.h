#pragma once

#include <string>

#include "azulejo/io/model_codec.h"

namespace azulejo {

/// Writes all that is visible, in world coordinates, one `o` for each node with a mesh; mirrored nodes keep their
/// outsides. Floats have the fewest digits that read back the same. Colours of vertices stand behind their positions.
/// What OBJ has no place for is left out, with a warning. The same bytes for any number of threads.
void write_obj(Output& output, const Scene& scene, const std::string& folder, const std::string& stem,
               const ModelWriteOptions& options, const Run& run);

}  // namespace azulejo
