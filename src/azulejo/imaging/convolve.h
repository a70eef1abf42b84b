#pragma once

#include <string>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/engine/border.h"
#include "azulejo/imaging/filter_output.h"
#include "azulejo/imaging/light.h"
#include "azulejo/math/number_grid.h"

namespace azulejo {

struct ConvolveOptions {
  NumberGrid kernel = {3, 3, {0, -1, 0, -1, 5, -1, 0, -1, 0}};  ///< weights, up to 255 × 255
  std::string file = {};                                        ///< where they are read from instead; empty: nowhere
  bool correlate = false;                    ///< the kernel is laid on the image as it is, not turned
  bool normalize = false;                    ///< divides the weights by their sum
  float scale = 1.0F;                        ///< of the sum
  float offset = 0.0F;                       ///< added to the scaled sum, an intensity
  FilterOutput output = FilterOutput::Same;  ///< what values below 0 and above 1 become
  Border border = Border::Mirror;            ///< what lies outside the image
  float border_value = 0.0F;                 ///< of Border::Constant, intensity 0–1, alpha too
  Light light = Light::Encoded;              ///< what is weighted: stored values, or linear light
};

/// Weighs neighbours by any kernel: result(x) = offset + scale · Σ kernel(i) · source(x − i); with `correlate`, x + i.
///
/// kernel   i = 0 is the weight in column columns / 2 and row rows / 2, counted from 0. `file`: text (a line for each
///          row) or an image of one channel (its intensities). A kernel that is a column times a row to within 2⁻²⁰ of
///          its largest weight is applied as such
/// source   any size, 1–4 channels, any pixel type. Colors are weighted by alpha: what is hidden under alpha 0 never
///          shows. A kernel without negative weights averages alpha likewise; any other leaves alpha as it is
/// result   same shape and type; with output=f32 f32 in units of full range, as many channels as the source has colors,
///          multiplied by alpha, ColorState::Data. Must not overlap the source
/// Exact    whole weights of integer pixels are summed exactly while Σ|weight| · full range is below 2²⁴. If weights ·
///          scale sum to 1 (to within 2⁻²⁰), constants stay constant to the last bit; if weights sum to 0, they give
///          `offset`. Else within (weights + 4)2⁻²³ · Σ|weight · scale| of the largest value, before rounding; weights
///          of u8 are rounded to 16 bits where that changes a result by at most 1/32 of a level.
///          More than 600 weights (u8: 1000) that have no factors, whole ones too: by Fourier transforms of blocks of
///          256 × 256 pixels, within 2⁻¹⁶ · (256 + side) / √(rows + columns) · √(Σ weight²) · scale of the largest value
/// NaN      spreads as far as weights that aren't 0, and so does an infinity, as itself or NaN; where weights sum to 0 or
///          1, over the kernel's rectangle; by Fourier transforms, over the blocks that it reaches
/// Cost     O(pixels · weights that aren't 0), above 600 (u8: 1000) no more; separable: O(pixels · (rows + columns))
/// Throws   Error(Argument) for an option out of range, an empty kernel, a larger one, a sum of 0 with `normalize`;
///          Error(Io | Data | Unsupported | Resource) of the kernel's file
/// Source   Gonzalez & Woods, Digital Image Processing, 4th ed., 3.4
AZULEJO_EXPORT void convolve(const ConstAnyView& source, const AnyView& result, const ConvolveOptions& options = {},
                             const Run& run = {});
AZULEJO_EXPORT Image convolve(const Image& source, const ConvolveOptions& options = {}, const Run& run = {});

}  // namespace azulejo
