#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/engine/border.h"
#include "azulejo/imaging/light.h"

namespace azulejo {

struct HighPassOptions {
  float sigma = 1.0F;              ///< standard deviation of the Gaussian in pixels, 0–1000
  Border border = Border::Mirror;  ///< what lies outside the image
  float border_value = 0.0F;       ///< of Border::Constant, intensity 0–1 of every channel, alpha too
  Light light = Light::Encoded;    ///< what is smoothed: stored values, or linear light
};

/// The detail of an image: image − Gaussian of it.
///
/// source   any size, 1–4 channels, any pixel type; each color channel by itself, multiplied by alpha
/// result   f32, as many channels as the source has colors, ColorState::Data, in units of full range
/// Exact    as `gaussian`, whose result is not rounded to levels: to 1/64 of one for u8 up to sigma = 16 without alpha in
///          encoded light. On constant areas 0 to the last bit
/// NaN      spreads as far as the kernel reaches
/// Cost     O(pixels · sigma)
/// Throws   Error(Argument) for an option out of range
/// Source   Gonzalez & Woods, Digital Image Processing, 4th ed., 3.7 (3-66)
AZULEJO_EXPORT void high_pass(const ConstAnyView& source, const AnyView& result, const HighPassOptions& options = {},
                              const Run& run = {});
AZULEJO_EXPORT Image high_pass(const Image& source, const HighPassOptions& options = {}, const Run& run = {});

}  // namespace azulejo
