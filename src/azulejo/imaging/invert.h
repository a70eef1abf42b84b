#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"

namespace azulejo {

struct InvertOptions {};

/// The negative: v becomes full range − v.
///
/// source   any size, 1–4 channels, any pixel type; each color channel by itself
/// result   same shape and type; may be the source itself. Exact for integers: twice is the source
/// Alpha    is copied; premultiplied color becomes alpha − v, which is the negative of the color that it stands for
/// NaN      stays NaN; f32 outside 0–1 is mirrored at a half as the rest is
/// Cost     O(pixels), bound by memory
/// Source   Gonzalez & Woods, Digital Image Processing, 4th ed., 3.2 (3-3)
AZULEJO_EXPORT void invert(const ConstAnyView& source, const AnyView& result, const InvertOptions& options = {},
                           const Run& run = {});
AZULEJO_EXPORT Image invert(const Image& source, const InvertOptions& options = {}, const Run& run = {});

}  // namespace azulejo
