#pragma once

#include <array>
#include <optional>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"

namespace azulejo {

struct Operation;

/// Where a change shows. What is said of several is their common part; nothing said is everywhere.
struct WithinOptions {
  std::optional<std::array<float, 4>> rect =
      {};                         ///< left, top, width, height in pixels; parts of pixels count as parts
  std::optional<int> label = {};  ///< where the mask holds this value as stored, at least 0: a region of labels
  int feather = 0;                ///< pixels over which the change fades in from the edge inwards, 0–1000
};

/// Takes a change of an image over inside a selected area; outside, the bytes stay as they are.
///
/// source, changed  the same size, channels, type and states
/// mask             optional (no pixels: none), the same size, any type: 0 is outside, full range inside, between is a
///                  mixture. Of several channels their mean counts, of alpha its product with it; under `label` the
///                  first channel. In steps of 1/65535; NaN is outside
/// result           like the source; may be the source or the changed image itself
/// Feather          the weight is 2 m − 1, at least 0, times the weight without it; m is the mean of the area's weights
///                  in a square of 2 · feather + 1 pixels around, what lies beyond the image being like its edge. Along a
///                  straight edge it rises linearly, from 1/(2 · feather + 1) in the first pixel inside to 1
/// Mixture          of stored values, colors weighted by alpha, as `blend`; rounded once. Where the weight is 1 the
///                  changed image's bytes, where it is 0 the source's
/// Cost             O(pixels)
/// Throws           Error(Argument) for images that don't fit, a label without a mask and options out of range
AZULEJO_EXPORT void within(const ConstAnyView& source, const ConstAnyView& changed, const ConstAnyView& mask,
                           const AnyView& result, const WithinOptions& options = {}, const Run& run = {});
AZULEJO_EXPORT Image within(const Image& source, const Image& changed, const Image& mask = {},
                            const WithinOptions& options = {}, const Run& run = {});

/// Whether an operation makes an image of an image, so that it may be kept within an area. Whether that has the source's
/// size, type and channels is known only with the image.
AZULEJO_EXPORT bool may_be_within(const Operation& operation);

}  // namespace azulejo
