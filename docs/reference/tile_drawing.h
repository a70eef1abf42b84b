#pragma once

#include <string>

namespace azulejo::reference {

/// The file tiles.svg: a wall of painted tiles, of paths, gradients, a clip and a group that is half transparent.
std::string tile_drawing();

}  // namespace azulejo::reference
