#pragma once

#include <map>
#include <string>

#include "azulejo/data/image.h"

namespace azulejo::reference {

/// The rendered samples by the names of their files, 480×320.
using StillLife = std::map<std::string, Image>;

/// painter  the program azulejos, which paints the tiles; it writes into the current folder
StillLife paint_still_life(const std::string& painter);

}  // namespace azulejo::reference
