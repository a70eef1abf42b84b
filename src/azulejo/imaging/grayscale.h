#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/imaging/light.h"

namespace azulejo {

struct GrayscaleOptions {
  Light light = Light::Encoded;  ///< Encoded: luma of the stored values; Linear: luminance, encoded again
};

/// Makes one channel of gray out of three of color.
///
/// encoded  luma, 0.299 R + 0.587 G + 0.114 B of the stored values; of integers the exact sum, rounded once, half up
/// linear   luminance, 0.2126 R + 0.7152 G + 0.0722 B of linear light; sRGB is decoded before and encoded after,
///          premultiplied color is divided by its alpha before and multiplied after (alpha 0: gray 0)
/// An image of linear color becomes luminance under either light: luma is defined on encoded values alone.
///
/// source   any size and pixel type; 3 channels, or 4 with alpha; 1 channel, or 2 with alpha, come back as they are
/// result   1 channel, or 2 with the source's alpha; same type, color and alpha state
/// NaN      in any color channel makes the gray NaN
/// Cost     O(pixels); encoded light is bound by memory
/// Throws   Error(Argument) for 2 or 4 channels without alpha
/// Source   ITU-R BT.601-7, 2.5.1; ITU-R BT.709-6, 3.2; IEC 61966-2-1
AZULEJO_EXPORT void grayscale(const ConstAnyView& source, const AnyView& result, const GrayscaleOptions& options = {},
                              const Run& run = {});
AZULEJO_EXPORT Image grayscale(const Image& source, const GrayscaleOptions& options = {}, const Run& run = {});

}  // namespace azulejo
