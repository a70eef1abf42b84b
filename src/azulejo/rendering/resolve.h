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

/// Rows of pixels: linear premultiplied colours laid over the background, as u8 or u16 RGBA (sRGB, straight) or f32
/// RGBA (linear, premultiplied). `result` says how many; `stride` is from a row of colours to the next. sRGB of u8 is
/// within 0.52 of a level, of u16 within 0.6.
void resolve_pixels(const glm::vec4* colors, std::size_t stride, const Resolve& resolve, const AnyView& result);

}  // namespace kernels
}  // namespace azulejo
