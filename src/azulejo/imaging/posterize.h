#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"

namespace azulejo {

struct PosterizeOptions {
  int levels = 4;  ///< 2–65536, of each channel
};

/// Leaves few intensities: v becomes the nearest of `levels` that divide 0–1 evenly, black and white among them.
///
/// source   any size, 1–4 channels, any pixel type; stored values, each color channel by itself
/// result   same shape and type; may be the source itself. Off by half a step at most; what lies between two levels goes
///          up. f32 outside 0–1 becomes black or white
/// Alpha    is copied; premultiplied color is divided by it before and multiplied after
/// NaN      stays NaN
/// Cost     O(pixels); u8 is looked up in a table
/// Throws   Error(Argument) for levels out of range
AZULEJO_EXPORT void posterize(const ConstAnyView& source, const AnyView& result, const PosterizeOptions& options = {},
                              const Run& run = {});
AZULEJO_EXPORT Image posterize(const Image& source, const PosterizeOptions& options = {}, const Run& run = {});

}  // namespace azulejo
