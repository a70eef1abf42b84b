#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"

namespace azulejo {

struct MaskOptions {
  bool transparent = false;  ///< what is left out becomes transparent; false: black
  bool invert = false;       ///< what the mask marks is left out
};

/// Keeps what a mask marks, and leaves out the rest.
///
/// source   any size, 1–4 channels, any pixel type; transparent: 1 or 3 color channels
/// mask     the same size, any type: 0 leaves out, full range keeps, between is a weight. Of several channels their mean
///          counts, times alpha. Weights are rounded to steps of the source's type, of f32 to 1/65535; NaN is 0
/// result   the source's type and color state. Color times the weight, rounded once, and the source's alpha; transparent:
///          alpha times the weight, of the source or added, and color as it was (premultiplied: times the weight, too).
///          May be the source where it has the same shape
/// NaN      stays NaN but where the weight is 0: all is 0 there
/// Cost     O(pixels), without alpha bound by memory
/// Throws   Error(Argument) for a mask of another size, and for channels to which alpha can't be added
AZULEJO_EXPORT void mask(const ConstAnyView& source, const ConstAnyView& mask, const AnyView& result,
                         const MaskOptions& options = {}, const Run& run = {});
AZULEJO_EXPORT Image mask(const Image& source, const Image& mask, const MaskOptions& options = {}, const Run& run = {});

}  // namespace azulejo
