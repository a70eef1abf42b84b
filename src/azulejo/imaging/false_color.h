#pragma once

#include <span>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"

namespace azulejo {

struct FalseColorOptions {
  int red = 1;         ///< the band that is shown as red; bands count from 1, through all images
  int green = 2;       ///< as green
  int blue = 3;        ///< as blue
  float low = 2.0F;    ///< share of a band's values that may become black, 0–100 %
  float high = 98.0F;  ///< share of values up to the one that becomes full, 0–100 %, above `low`
};

/// Shows three bands as red, green and blue, each stretched by itself: bands of a satellite, of a microscope.
///
/// sources  1 or more of one size and pixel type; their color channels are the bands, in order
/// result   3 channels, same size and type, color state srgb. A band goes from its low percentile, 0, to its high one,
///          1, on a line, as by contrast_stretch; 0 and 100 are its smallest and largest value
/// Alpha    does not come along; pixels of alpha 0 are not counted, premultiplied bands are as over black
/// NaN      is not counted and stays NaN
/// Cost     O(pixels), two passes over the sources that have one of the bands
/// Throws   Error(Argument) for a band that is not there, low not below high, images of different size or type
/// Source   Gonzalez & Woods, Digital Image Processing, 4th ed., 6.3 (multispectral images)
AZULEJO_EXPORT void false_color(std::span<const ConstAnyView> sources, const AnyView& result,
                                const FalseColorOptions& options = {}, const Run& run = {});
AZULEJO_EXPORT Image false_color(std::span<const Image* const> sources, const FalseColorOptions& options = {},
                                 const Run& run = {});

}  // namespace azulejo
