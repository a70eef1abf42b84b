#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"

namespace azulejo {

struct MatchHistogramOptions {
  bool per_channel = true;  ///< each color channel by itself; false: one table, from the pooled histograms
};

/// Gives an image the distribution of intensities of another: v becomes the smallest value z of the reference with
/// G(z) ≥ F(v), where F is the share of the source's values below v and half of those that are v, and G the share of
/// the reference's values up to z. So only values of the reference occur, the order of values is kept, and an image
/// matched with itself stays as it is (of f32: but for the width of a bin).
///
/// Per channel, the mood of colors is taken over; with one table for all, grays stay gray.
///
/// source     any size, 1–4 channels, any pixel type
/// reference  any size; pixel type, color state and color channels of the source
/// result     size, channels, type and states of the source; may be the source itself
/// Values     u8 has 256 bins, u16 65536, f32 65536 of which the first and the last take what lies outside 0–1
/// Alpha      is copied; pixels of alpha 0 are not counted, in either image; premultiplied color is divided by alpha
///            before the table and multiplied after
/// NaN        is not counted and stays NaN. An image without counted values changes nothing, and isn't changed
/// Stages     histogram_before, mapping, histogram_after: counts and charts of 256 columns
/// Cost       O(pixels), two passes over the source and one over the reference
/// Throws     Error(Argument) for a reference of another kind
/// Source     Gonzalez & Woods, Digital Image Processing, 4th ed., 3.3 (histogram specification); its F counts all of
///            the values v, which makes everything brighter by half a step
AZULEJO_EXPORT void match_histogram(const ConstAnyView& source, const ConstAnyView& reference, const AnyView& result,
                                    const MatchHistogramOptions& options = {}, const Run& run = {});
AZULEJO_EXPORT Image match_histogram(const Image& source, const Image& reference,
                                     const MatchHistogramOptions& options = {}, const Run& run = {});

}  // namespace azulejo
