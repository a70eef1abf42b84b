#pragma once

#include <string>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/frame.h"
#include "azulejo/io/image_io.h"

namespace azulejo {

/// Writes all layers of a frame into one OpenEXR file, beside `path` and renamed; "-" is standard output. Reading it
/// gives the color; `ReadOptions::layer` names another layer.
///
/// values    32-bit floats; sRGB becomes linear, straight alpha premultiplied, data stay as they are
/// color     channels R, G, B [A] or Y [A], without a prefix
/// depth     depth.Z
/// others    name.R, G, B [A] of colors; name.V, U V, X Y Z or X Y Z W of data
/// camera    as JSON, the text attribute "camera"
/// options   compression and tile
/// Throws    Error(Argument) for a frame without layers, for layers of different sizes or names that an OpenEXR file
///           can't keep apart; Error(Io)
AZULEJO_EXPORT void write_frame(const Frame& frame, const std::string& path, const WriteOptions& options = {},
                                const Run& run = {});

}  // namespace azulejo
