#pragma once

#include <cstddef>

#include "azulejo/data/view.h"

namespace azulejo::kernels {

/// Stored values as intensities: divided by the full range.
void load_intensities(PixelType type, const std::byte* source, std::size_t count, float* row);
/// The way back: rounded half up, saturated; NaN is 0 in integers.
void store_intensities(PixelType type, const float* row, std::size_t count, std::byte* result);

/// Premultiplied pixels of 2 or 4 channels: each value divided by its alpha, 0 where that is 0. In place is allowed.
void divide_by_alpha(const float* row, std::size_t count, int channels, float* result);
/// Values times the alpha of `loaded`, 0 where that is 0, and alpha as it was.
/// saturate  values are cut to 0–1 before
void multiply_by_alpha(const float* loaded, std::size_t count, int channels, bool saturate, float* row);
/// Alpha as it was in `loaded`.
void keep_alpha(const float* loaded, std::size_t count, int channels, float* row);

}  // namespace azulejo::kernels
