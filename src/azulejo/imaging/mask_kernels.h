#pragma once

#include <cstddef>

#include "azulejo/data/view.h"

namespace azulejo::kernels {

/// Each of `pixels` values of the type as often as there are channels, 2–4.
void repeat_values(PixelType type, const std::byte* values, std::size_t pixels, int channels, std::byte* result);

}  // namespace azulejo::kernels
