#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/engine/border.h"
#include "azulejo/math/number_grid.h"

namespace azulejo {

struct WeightedMedianOptions {
  /// How many times a pixel of the window counts: whole numbers, 0–1000, of an odd number of rows and columns, up to 65
  /// each; their sum is 1–32767. The middle one belongs to the pixel itself.
  NumberGrid weights = {3, 3, {1, 2, 1, 2, 5, 2, 1, 2, 1}};
  Border border = Border::Mirror;  ///< what lies outside the image
  float border_value = 0.0F;       ///< of Border::Constant, intensity 0–1 of every channel, alpha too
};

/// The weighted median of a window: the least of its values such that it and what is below weigh at least half. With a large
/// weight in the middle, a pixel is changed only where it stands out: fine lines and corners stay.
///
/// source   any size, 1–4 channels, any pixel type. Each stored channel is ranked by itself, alpha too
/// result   same shape and type; must not overlap the source. Each value is one of the source's
/// NaN      counts as above infinity, whatever its sign; −0 as below 0. A NaN that comes out has bits 0x7FFFFFFF
/// Cost     O(pixels · weights that aren't 0 · bits of a value), a vector at a time
/// Throws   Error(Argument) for weights that aren't as said, and options out of range
/// Source   Brownrigg, The weighted median filter, Communications of the ACM 27(8), 1984
AZULEJO_EXPORT void weighted_median(const ConstAnyView& source, const AnyView& result,
                                    const WeightedMedianOptions& options = {}, const Run& run = {});
AZULEJO_EXPORT Image weighted_median(const Image& source, const WeightedMedianOptions& options = {},
                                     const Run& run = {});

}  // namespace azulejo
