#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/imaging/light.h"

namespace azulejo {

enum class Dither : std::uint8_t {
  None,            ///< the nearest level
  Ordered,         ///< up where the value is above a threshold of Bayer's 8×8 matrix: a regular pattern
  BlueNoise,       ///< the same with thresholds that are spread evenly without a pattern, 64×64 of them
  FloydSteinberg,  ///< the nearest level; what is lost goes to the neighbors that come later
};

constexpr auto enum_names(Dither) {
  return std::array<std::string_view, 4>{"none", "ordered", "blue_noise", "floyd_steinberg"};
}

struct QuantizeOptions {
  int levels = 2;                ///< 2–256 intensities of each channel, which divide 0–1 evenly
  Dither dither = Dither::None;  ///< how means are kept
  Light light = Light::Encoded;  ///< what dithering keeps the mean of
};

/// Leaves few intensities, as a converter or a printer does; dithering keeps the mean of each neighborhood.
///
/// Without dithering, v becomes the nearest level, as in `posterize`. With thresholds, it becomes the level above it
/// where its place between two levels, 0–1, is above the threshold. With Floyd–Steinberg, 7/16 of the difference that is
/// left goes to the right, 3/16, 5/16 and 1/16 to the pixels below at the left, in the middle and at the right; what
/// would leave the image at its sides goes straight down. Rows are scanned from left to right.
///
/// Light    encoded: means of stored values are kept, so that what is seen from afar is too bright: light adds up, and
///          sRGB values aren't light. linear: means of light are kept, which is right for what is looked at; levels are
///          the same ones. Of linear color and data both are the same
/// source   any size, 1–4 channels, any pixel type; each color channel by itself, with the same thresholds, so that
///          grays stay gray
/// result   same shape and type. Values beyond 0–1 become black or white
/// Alpha    is copied; premultiplied color is divided by it before and multiplied after; pixels of alpha 0 neither take
///          nor give differences
/// NaN      stays NaN, and gives no difference
/// Cost     O(pixels); Floyd–Steinberg needs the whole image and is computed on one thread, several rows at a time
/// Source   Bayer, An optimum method for two-level rendition of continuous-tone pictures, ICC 1973; Ulichney, The
///          void-and-cluster method for dither array generation, SPIE 1913, 1993; Floyd, Steinberg, An adaptive
///          algorithm for spatial greyscale, Proc. SID 17(2), 1976
AZULEJO_EXPORT void quantize(const ConstAnyView& source, const AnyView& result, const QuantizeOptions& options = {},
                             const Run& run = {});
AZULEJO_EXPORT Image quantize(const Image& source, const QuantizeOptions& options = {}, const Run& run = {});

}  // namespace azulejo
