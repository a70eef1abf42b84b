#pragma once

#include <optional>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/engine/border.h"
#include "azulejo/imaging/light.h"

namespace azulejo {

struct BilateralOptions {
  float sigma_space = 2.0F;        ///< standard deviation of the weight by distance, in pixels, 0.1–50
  float sigma_range = 0.1F;        ///< of the weight by difference, in intensity, 0.001–10
  std::optional<int> radius = {};  ///< of the round window, 0–100; left out: twice sigma_space, rounded up
  Border border = Border::Mirror;  ///< what lies outside the image
  float border_value = 0.0F;       ///< of Border::Constant, intensity 0–1 of every channel, alpha too
  Light light = Light::Encoded;    ///< what is weighted and compared: stored values, or linear light
};

/// Smooths and keeps edges: averages the pixels around that are alike, weighted by
/// exp(−distance² / 2 sigma_space²) · exp(−difference² / 2 sigma_range²).
///
/// source   any size, 1–4 channels, any pixel type. The difference is the Euclidean one over all channels together. Of
///          pixels with alpha it is that of colors multiplied by alpha, and alpha: what is hidden never shows
/// result   same shape and type; must not overlap the source. Color 0 where alpha is 0
/// Exact    in f32, weights within 4·10⁻⁶; rounded once
/// NaN      and infinities spread as far as the window
/// Cost     O(pixels · radius²)
/// Throws   Error(Argument) for an option out of range
/// Source   Tomasi & Manduchi, Bilateral filtering for gray and color images, ICCV 1998, 2
AZULEJO_EXPORT void bilateral(const ConstAnyView& source, const AnyView& result, const BilateralOptions& options = {},
                              const Run& run = {});
AZULEJO_EXPORT Image bilateral(const Image& source, const BilateralOptions& options = {}, const Run& run = {});

}  // namespace azulejo
