#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/engine/border.h"
#include "azulejo/imaging/light.h"

namespace azulejo {

struct GaussianOptions {
  float sigma = 1.0F;              ///< standard deviation in pixels, 0–1000; 0: a copy
  Border border = Border::Mirror;  ///< what lies outside the image
  float border_value = 0.0F;       ///< of Border::Constant, intensity 0–1 of every channel, alpha too
  Light light = Light::Encoded;    ///< what is weighted: stored values, or linear light
};

/// Smooths with a Gaussian kernel: g(k) ∝ exp(−k² / 2σ²), |k| ≤ ceil(4σ), sum 1, along columns and along rows.
///
/// source   any size, 1–4 channels, any pixel type. Colors are weighted by alpha: what is hidden under alpha 0 never
///          shows. Straight alpha comes back straight, with color 0 where alpha is 0
/// result   same shape and type; must not overlap the source
/// Exact    computed in f32 and rounded once: within (r + 4)2⁻²² of the exact sum, relative to the largest value, r
///          being the radius (6·10⁻⁶ at σ = 5), before rounding. u8 up to σ = 16, where stored values are weighted
///          (no alpha or premultiplied, encoded or no sRGB): in integers, by weights of 15 bits with a sum of exactly
///          1, and 1/64 of a level between columns and rows: within (r + 4)/128 of a level before rounding, whatever
///          the image (for each σ of 0.1, 0.2 … 16 at most 0.42; at σ = 1 0.035, at σ = 5 0.091). Equal values stay
///          equal to the last bit, mirrored images give mirrored results to the last bit
/// NaN      spreads as far as the kernel reaches, and so does an infinity, as itself or NaN; a NaN alpha makes colors
///          NaN
/// Cost     O(pixels · σ)
/// Throws   Error(Argument) for an option out of range
/// Source   Gonzalez & Woods, Digital Image Processing, 4th ed., 3.5 (3-45), cut at 4σ, not sampled at 6σ
AZULEJO_EXPORT void gaussian(const ConstAnyView& source, const AnyView& result, const GaussianOptions& options = {},
                             const Run& run = {});
AZULEJO_EXPORT Image gaussian(const Image& source, const GaussianOptions& options = {}, const Run& run = {});

}  // namespace azulejo
