#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"

namespace azulejo {

struct ClaheOptions {
  int columns = 8;           ///< tiles side by side; not more than there are pixels
  int rows = 8;              ///< tiles above each other
  float clip = 2;            ///< how steep a mapping may be: times the contrast of the source; 1: nothing changes
  bool per_channel = false;  ///< false: luma is equalized and chroma kept; true: each color channel by itself
};

/// Spreads intensities within each part of the image (contrast limited adaptive histogram equalization).
///
/// The image is cut into columns × rows tiles. Each has a mapping, the cumulative histogram of its pixels, whose slope
/// is limited: what a bin holds beyond `clip` times the mean goes evenly to the other bins, as far as none of them
/// then holds more. A pixel is mapped by the four tiles whose centers are around it, weighted bilinearly; outside the
/// outermost centers by two or one.
///
/// source   any size, 1–4 channels, any pixel type
/// result   same shape and type; may be the source itself
/// Sizes    that aren't multiples: tile i begins at ⌊i · width / columns⌋, so that tiles differ by a pixel; nothing is
///          padded. A tile without pixels that count maps nothing
/// Color    of 3 channels: luma (Rec. 601) of the stored values is mapped, and each channel changes by as much as it
///          does, so that Cb and Cr stay, saturated in integers. Where colors have 2 or 4 channels, and with
///          per_channel, each channel is mapped by itself
/// Values   u8: 256 bins, mappings kept in steps of 1/128; u16, f32: 1024 bins, the mapping is linear within each.
///          f32 outside 0–1 is taken as 0 or 1
/// Alpha    is copied; pixels of alpha 0 are not counted; premultiplied color is divided by alpha before and multiplied
///          after
/// NaN      is not counted; it stays NaN, and with luma makes its pixel NaN
/// Stages   tile_histogram, tile_mapping: counts of the middle tile and its mapping, charts of 256 columns
/// Cost     O(pixels) + O(tiles · bins), two passes over the source
/// Source   Zuiderveld, Contrast limited adaptive histogram equalization, Graphics Gems IV, VIII.5. Departures: the
///          excess is given out exactly instead of by rounds, and a value is mapped by the middle of its bin instead of
///          its upper end, so that the inverse of an image gives the inverse result
AZULEJO_EXPORT void clahe(const ConstAnyView& source, const AnyView& result, const ClaheOptions& options = {},
                          const Run& run = {});
AZULEJO_EXPORT Image clahe(const Image& source, const ClaheOptions& options = {}, const Run& run = {});

}  // namespace azulejo
