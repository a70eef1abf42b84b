#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"

namespace azulejo {

struct ThresholdOptions {
  float level = 0.5F;   ///< intensity 0–1
  bool invert = false;  ///< foreground is what is not above the level
};

/// Marks what is brighter than a level: full range where a value is above it, 0 elsewhere.
///
/// source   any size, 1–4 channels, any pixel type; each color channel by itself, alpha is copied
/// result   same shape and type; may be the source itself
/// NaN      is not above any level
/// Cost     O(pixels), bound by memory
/// Throws   Error(Argument) for a level outside 0–1
/// Source   Gonzalez & Woods, Digital Image Processing, 4th ed., 10.3 (10-46)
AZULEJO_EXPORT void threshold(const ConstAnyView& source, const AnyView& result, const ThresholdOptions& options = {},
                              const Run& run = {});
AZULEJO_EXPORT Image threshold(const Image& source, const ThresholdOptions& options = {}, const Run& run = {});

}  // namespace azulejo
