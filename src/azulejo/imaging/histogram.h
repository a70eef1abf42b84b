#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/core/json.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"

namespace azulejo {

struct HistogramOptions {
  int bins = 256;            ///< 1–65536; of u8 at most 256
  bool logarithmic = false;  ///< the chart's bars grow with log(1 + count)
  bool cumulative = false;   ///< the chart shows how many are not above
  int width = 512;           ///< of the chart in pixels, 16–4096
  int height = 256;          ///< of the chart in pixels, 16–4096
};

/// How often values of an image occur.
struct Histogram {
  int bins = 0;
  std::vector<std::string> names;  ///< of the color channels: "gray", "red" …
  std::vector<std::vector<std::uint64_t>>
      counts;  ///< one list a color channel; bin b holds the levels of [b, b + 1) / bins
};

/// Counts how often values occur, and draws it.
///
/// source  any size, 1–4 channels, any pixel type; color channels. Pixels of alpha 0 and NaN are not counted;
///         premultiplied color is divided by alpha. f32 outside 0–1 counts into the first and the last bin
/// Bins    level v of an integer type with n levels is in bin ⌊v · bins / n⌋; f32 is taken in 65536 levels
/// Chart   RGB u8, the largest bar as high as the chart; bars of several channels darken each other, so that what all
///         share is gray. A bar of something is a pixel high at least
/// Cost    O(pixels), bounded memory
/// Throws  Error(Argument) for options out of range, more bins than levels
AZULEJO_EXPORT Histogram histogram(const ConstAnyView& source, const HistogramOptions& options = {},
                                   const Run& run = {});
AZULEJO_EXPORT Histogram histogram(const Image& source, const HistogramOptions& options = {}, const Run& run = {});
AZULEJO_EXPORT Image histogram_chart(const Image& source, const HistogramOptions& options = {}, const Run& run = {});
AZULEJO_EXPORT Json to_json(const Histogram& histogram);

}  // namespace azulejo
