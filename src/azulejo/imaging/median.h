#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/engine/border.h"

namespace azulejo {

struct MedianOptions {
  int radius = 1;                  ///< of the square window, 2 · radius + 1 pixels wide, 0–1000; 0: a copy
  Border border = Border::Mirror;  ///< what lies outside the image
  float border_value = 0.0F;       ///< of Border::Constant, intensity 0–1 of every channel, alpha too
};

/// The median of a square window: takes away specks and salt and pepper, and leaves edges sharp.
///
/// source   any size, 1–4 channels, any pixel type. Each stored channel is ranked by itself, alpha too
/// result   same shape and type; must not overlap the source. Each value is one of the source's
/// NaN      counts as above infinity, whatever its sign; −0 as below 0. A NaN that comes out has bits 0x7FFFFFFF
/// Cost     O(pixels · radius²) up to radius 4, a vector at a time. Above, u8 takes the same time for any radius up to 127;
///          u16, f32 and larger radii sort the values of a block once and walk along their ranks: O(1 + radius/16) a pixel
/// Throws   Error(Argument) for an option out of range
/// Source   Adams, Fast median filters using separable sorting networks, ACM Transactions on Graphics 40(4), 2021 (columns
///          are sorted once for all windows; the networks here are Batcher's, pruned); Perreault & Hébert, Median
///          filtering in constant time, IEEE Transactions on Image Processing 16(9), 2007 (histograms here are
///          cumulative); Huang, Yang & Tang, A fast two-dimensional median filtering algorithm, IEEE Transactions on ASSP
///          27(1), 1979 (here along ranks)
AZULEJO_EXPORT void median(const ConstAnyView& source, const AnyView& result, const MedianOptions& options = {},
                           const Run& run = {});
AZULEJO_EXPORT Image median(const Image& source, const MedianOptions& options = {}, const Run& run = {});

}  // namespace azulejo
