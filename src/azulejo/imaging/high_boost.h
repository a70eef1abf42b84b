#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/engine/border.h"
#include "azulejo/imaging/light.h"

namespace azulejo {

struct HighBoostOptions {
  float boost = 2.0F;  ///< factor of the image, 1–100: at 1 only detail is left, at 2 the brightness stays
  float sigma = 1.0F;  ///< standard deviation of the Gaussian in pixels, 0–1000
  Border border = Border::Mirror;  ///< what lies outside the image
  float border_value = 0.0F;       ///< of Border::Constant, intensity 0–1 of every channel, alpha too
  Light light = Light::Encoded;    ///< what is smoothed: stored values, or linear light
};

/// High boost: `boost` · image − Gaussian of it, which is (`boost` − 1) · image + detail.
///
/// source   any size, 1–4 channels, any pixel type; each color channel by itself. Under alpha the surroundings of a color
///          are the mean of colors weighted by alpha: what is hidden never shows. Alpha is copied; where it is 0, so is
///          color
/// result   same shape and type, integers rounded once and saturated; must not overlap the source
/// Exact    as `gaussian`, whose result is not rounded to levels: to 1/64 of one for u8 up to sigma = 16 without alpha in
///          encoded light. A constant image becomes (boost − 1) times itself to the last bit
/// NaN      spreads as far as the kernel reaches
/// Cost     O(pixels · sigma)
/// Throws   Error(Argument) for an option out of range
/// Source   Gonzalez & Woods, Digital Image Processing, 3rd ed., 3.6.3; 4th ed., 3.6 (3-64) with k > 1 is unsharp_mask
AZULEJO_EXPORT void high_boost(const ConstAnyView& source, const AnyView& result, const HighBoostOptions& options = {},
                               const Run& run = {});
AZULEJO_EXPORT Image high_boost(const Image& source, const HighBoostOptions& options = {}, const Run& run = {});

}  // namespace azulejo
