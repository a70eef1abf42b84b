#pragma once

#include <array>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"

namespace azulejo {

constexpr auto enum_names(PixelType) { return std::array<std::string_view, 3>{"u8", "u16", "f32"}; }

struct ConvertOptions {
  PixelType type = PixelType::U8;
  bool normalize = false;  ///< the smallest and the largest color become 0 and full range
};

/// Stores intensities in another pixel type: 255 of u8, 65535 of u16 and 1.0 of f32 are the same. The type alone
/// changes, not what colors mean: color and alpha state stay as they are.
///
/// source     any size, 1–4 channels, any pixel type
/// result     same shape, channels and states, of the type that is asked for
/// Rounding   half up, saturated; u8 to u16 and back is exact, u8 or u16 to f32 and back too
/// normalize  one stretch for all color channels, alpha is left alone; finite values of pixels whose alpha is not 0
///            count; a constant image becomes 0. Premultiplied color is divided by alpha before and multiplied after
///            (alpha 0: color 0)
/// NaN        0 in integers, NaN in f32
/// Cost       O(pixels), bound by memory; normalize reads the image once more
AZULEJO_EXPORT void convert(const ConstAnyView& source, const AnyView& result, const ConvertOptions& options = {},
                            const Run& run = {});
AZULEJO_EXPORT Image convert(const Image& source, const ConvertOptions& options = {}, const Run& run = {});

}  // namespace azulejo
