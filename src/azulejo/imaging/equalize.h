#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"

namespace azulejo {

struct EqualizeOptions {
  bool per_channel = false;  ///< false: one table for all color channels, from their pooled histogram; true: one each
};

/// Spreads intensities so that each is about as frequent: v becomes (cdf(v) − cdf(lowest)) / (n − cdf(lowest)) of the
/// full range, where cdf(v) counts the values up to v and n all. Rounded once; a constant image stays as it is.
///
/// One table for all channels keeps grays gray and changes hues less; one each also removes a color cast.
///
/// source   any size, 1–4 channels, any pixel type; u8 has 256 bins, u16 65536, f32 65536 of which the first and the
///          last take what lies outside 0–1 (the result has at most 65536 values in 0–1)
/// result   same shape and type; may be the source itself
/// Alpha    is copied; pixels of alpha 0 are not counted; premultiplied color is divided by alpha before the table
///          and multiplied after
/// NaN      is not counted and stays NaN
/// Stages   histogram_before, mapping, histogram_after: counts and charts of 256 columns
/// Cost     O(pixels), two passes over the source
/// Source   Gonzalez & Woods, Digital Image Processing, 4th ed., 3.3; its table (3-15) doesn't subtract the lowest
///          value's count, so that black need not occur in its results
AZULEJO_EXPORT void equalize(const ConstAnyView& source, const AnyView& result, const EqualizeOptions& options = {},
                             const Run& run = {});
AZULEJO_EXPORT Image equalize(const Image& source, const EqualizeOptions& options = {}, const Run& run = {});

}  // namespace azulejo
