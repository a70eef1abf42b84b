#pragma once

#include <cstddef>
#include <glm/vec4.hpp>

#include "azulejo/data/view.h"

namespace azulejo {

/// How linear light becomes the picture.
struct Resolve {
  glm::vec4 background{0, 0, 0, 0};  ///< linear, premultiplied
  float exposure = 1;                ///< factor of what was drawn, not of the background
};

namespace kernels {

/// A row of pixels: linear premultiplied colours laid over the background, as u8 or u16 RGBA (sRGB, straight) or f32
/// RGBA (linear, premultiplied).
void resolve_row(const glm::vec4* colors, std::size_t count, const Resolve& resolve, PixelType type, std::byte* result);

}  // namespace kernels
}  // namespace azulejo
