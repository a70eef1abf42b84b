#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/engine/border.h"
#include "azulejo/imaging/light.h"

namespace azulejo {

struct UnsharpMaskOptions {
  float sigma = 1.0F;              ///< standard deviation of the Gaussian in pixels, 0–1000
  float amount = 1.0F;             ///< how often the detail is added, 0–100
  float threshold = 0.0F;          ///< details smaller than this intensity stay as they are
  Border border = Border::Mirror;  ///< what lies outside the image
  float border_value = 0.0F;       ///< of Border::Constant, intensity 0–1 of every channel, alpha too
  Light light = Light::Encoded;    ///< what is smoothed: stored values, or linear light
};

/// Sharpens: what a Gaussian removes is added once more, `amount` times.
///
/// source   any size, 1–4 channels, any pixel type; each color channel by itself. Under alpha the surroundings of a color
///          are the mean of colors weighted by alpha: what is hidden never shows. Alpha is copied; where it is 0, so is
///          color
/// result   same shape and type, integers rounded once and saturated; must not overlap the source
/// Exact    as `gaussian`, whose result is not rounded to levels: to 1/64 of one for u8 up to sigma = 16 without alpha in
///          encoded light. A constant image stays to the last bit
/// NaN      spreads as far as the kernel reaches
/// Cost     O(pixels · sigma)
/// Throws   Error(Argument) for an option out of range
/// Source   Gonzalez & Woods, Digital Image Processing, 4th ed., 3.6 (3-63, 3-64); the mask is not rounded to levels
AZULEJO_EXPORT void unsharp_mask(const ConstAnyView& source, const AnyView& result,
                                 const UnsharpMaskOptions& options = {}, const Run& run = {});
AZULEJO_EXPORT Image unsharp_mask(const Image& source, const UnsharpMaskOptions& options = {}, const Run& run = {});

}  // namespace azulejo
