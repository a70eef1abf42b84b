#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"

namespace azulejo {

struct ExposureOptions {
  std::optional<float> stops;  ///< doublings of light, −16–16; none: `ExposureVerdict::stops` of the image
};

/// Multiplies light, as a longer exposure or a wider aperture would have: by 2^stops. sRGB is decoded before and
/// encoded after, linear light and data are multiplied as they are.
///
/// source   any size, 1–4 channels, any pixel type; each color channel by itself
/// result   same shape and type; may be the source itself. Integers are rounded once, half up, and saturate; f32 goes on
///          beyond 0–1. sRGB is within 3·10⁻⁶ of the value, relatively
/// Alpha    is copied; premultiplied color is divided by it before and multiplied after
/// NaN      stays NaN
/// Report   the verdict on the result, and without `stops` on the source; it is no unless exposure and contrast of the
///          result are good
/// Stages   without `stops`: verdict
/// Cost     O(pixels), without `stops` two passes over the source; u8 is looked up in a table
/// Throws   Error(Argument) for stops out of range
AZULEJO_EXPORT void exposure(const ConstAnyView& source, const AnyView& result, const ExposureOptions& options = {},
                             const Run& run = {});
AZULEJO_EXPORT Image exposure(const Image& source, const ExposureOptions& options = {}, const Run& run = {});

enum class Exposure : std::uint8_t {
  Good,
  Under,  ///< a stop or more is missing
  Over,   ///< a stop or more is too much
};
constexpr auto enum_names(Exposure) { return std::array<std::string_view, 3>{"good", "under", "over"}; }

enum class Contrast : std::uint8_t {
  Good,
  Low,   ///< all but the darkest and the brightest percent lie within 0.5 of the range
  High,  ///< a tenth or more of the values are black or white
};
constexpr auto enum_names(Contrast) { return std::array<std::string_view, 3>{"good", "low", "high"}; }

/// What a histogram tells of an exposure. Intensities are 0–1, as stored.
struct ExposureVerdict {
  float low = 0;     ///< 1st percentile
  float median = 0;  ///< 50th percentile
  float high = 0;    ///< 99th percentile
  double black = 0;  ///< share of values in the first bin
  double white = 0;  ///< share of values in the last bin
  /// The correction that brings the light of the median to middle gray, 0.18, but where it brightens the 99th percentile
  /// to no more than white; within ±8. 0 where nothing was counted.
  float stops = 0;
  Exposure exposure = Exposure::Good;
  Contrast contrast = Contrast::Good;
};

/// counts  of bins at even distances, the first at 0, the last at 1: at least 2
/// color   what they are bins of: light, or its sRGB encoding
AZULEJO_EXPORT ExposureVerdict judge_exposure(std::span<const std::uint64_t> counts, ColorState color);

/// Of all color channels of an image together, as stored.
AZULEJO_EXPORT ExposureVerdict judge_exposure(const Image& source, const Run& run = {});

}  // namespace azulejo
