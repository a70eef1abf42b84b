#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"

namespace azulejo {

struct LevelSliceOptions {
  float low = 0.4F;    ///< intensity at which the band begins
  float high = 0.6F;   ///< intensity at which it ends; both belong to it
  float level = 1.0F;  ///< intensity that the band becomes
  bool keep = false;   ///< what is outside the band stays as it is; false: becomes 0
};

/// Shows a band of intensities: low ≤ v ≤ high becomes one level, the rest 0, or what it was.
///
/// source   any size, 1–4 channels, any pixel type; each color channel by itself
/// result   same shape and type; may be the source itself
/// Alpha    is copied; premultiplied color is divided by it before and multiplied after
/// NaN      is outside the band
/// Cost     O(pixels), u8 is looked up in a table
/// Throws   Error(Argument) for intensities outside 0–1, and low above high
/// Source   Gonzalez & Woods, Digital Image Processing, 4th ed., 3.2, intensity-level slicing (Fig. 3.11)
AZULEJO_EXPORT void level_slice(const ConstAnyView& source, const AnyView& result,
                                const LevelSliceOptions& options = {}, const Run& run = {});
AZULEJO_EXPORT Image level_slice(const Image& source, const LevelSliceOptions& options = {}, const Run& run = {});

}  // namespace azulejo
