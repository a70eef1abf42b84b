#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"

namespace azulejo {

struct BrightnessContrastOptions {
  float brightness = 0.0F;  ///< intensity that is added, −1–1
  float contrast = 1.0F;    ///< factor around middle gray, 0–100
};

/// Scales intensities around middle gray, then adds: v becomes (v − ½) · contrast + ½ + brightness.
///
/// source   any size, 1–4 channels, any pixel type; stored values, each color channel by itself
/// result   same shape and type; may be the source itself. Integers are rounded once, half up, and saturate; f32 goes on
///          beyond 0–1
/// Alpha    is copied; premultiplied color is divided by it before and multiplied after
/// NaN      stays NaN
/// Cost     O(pixels); u8 is looked up in a table
/// Throws   Error(Argument) for an option out of range
AZULEJO_EXPORT void brightness_contrast(const ConstAnyView& source, const AnyView& result,
                                        const BrightnessContrastOptions& options = {}, const Run& run = {});
AZULEJO_EXPORT Image brightness_contrast(const Image& source, const BrightnessContrastOptions& options = {},
                                         const Run& run = {});

}  // namespace azulejo
