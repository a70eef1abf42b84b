#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"

namespace azulejo {

struct ContrastStretchOptions {
  float low = 1.0F;          ///< share of values that may become black, 0–100 %
  float high = 99.0F;        ///< share of values up to the one that becomes white, 0–100 %, above `low`
  bool per_channel = false;  ///< false: one line for all color channels, from their pooled histogram; true: one each
};

/// Spreads intensities over the whole range: the low percentile becomes 0, the high one 1, what is between lies on a
/// line. 0 and 100 are the smallest and the largest value.
///
/// One line for all channels keeps grays gray; one each also removes a color cast.
///
/// source   any size, 1–4 channels, any pixel type; u8 has 256 bins, u16 and f32 65536, of which the first and the last
///          take what f32 has outside 0–1
/// result   same shape and type; may be the source itself. Integers are rounded once, half up; all types are cut to the
///          range. Where both percentiles are the same value, the source
/// Alpha    is copied; pixels of alpha 0 are not counted; premultiplied color is divided by alpha before and multiplied
///          after
/// NaN      is not counted and stays NaN
/// Stages   histogram_before: counts and a chart; levels: the intensities that become black and white
/// Cost     O(pixels), two passes over the source; u8 is looked up in a table
/// Throws   Error(Argument) for percentages outside 0–100, and low not below high
/// Source   Gonzalez & Woods, Digital Image Processing, 4th ed., 3.2, contrast stretching (Fig. 3.10)
AZULEJO_EXPORT void contrast_stretch(const ConstAnyView& source, const AnyView& result,
                                     const ContrastStretchOptions& options = {}, const Run& run = {});
AZULEJO_EXPORT Image contrast_stretch(const Image& source, const ContrastStretchOptions& options = {},
                                      const Run& run = {});

}  // namespace azulejo
