#pragma once

#include <array>
#include <optional>

#include "azulejo/math/rect.h"

namespace azulejo {

/// The option `viewport`, x, y, width and height, as pixels of a picture; nothing: all of it. Throws Error(Argument) for
/// parts of pixels, and for what isn't in the picture.
Rect viewport_rect(const std::optional<std::array<float, 4>>& viewport, int width, int height);

}  // namespace azulejo
