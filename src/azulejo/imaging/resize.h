#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/imaging/light.h"

namespace azulejo {

/// How a result pixel is made of source pixels.
enum class ResizeFilter : std::uint8_t {
  Nearest,   ///< the source pixel that holds its centre
  Bilinear,  ///< a tent, 1 pixel to each side
  Bicubic,   ///< Catmull–Rom, 2 pixels to each side
  Lanczos,   ///< 3 lobes: 3 pixels to each side
  Area,      ///< the mean over its footprint, source pixels being squares of one color
};

constexpr auto enum_names(ResizeFilter) {
  return std::array<std::string_view, 5>{"nearest", "bilinear", "bicubic", "lanczos", "area"};
}

struct ResizeOptions {
  std::optional<int> width =
      {};  ///< of the result; left out: keeps the aspect of `height`, else `scale` times the source's
  std::optional<int> height =
      {};           ///< of the result; left out: keeps the aspect of `width`, else `scale` times the source's
  float scale = 1;  ///< of both sides, where neither width nor height is given
  ResizeFilter filter = ResizeFilter::Lanczos;
  Light light = Light::Linear;
};

/// Changes the number of pixels that show the image.
///
/// source   any size, 1–4 channels, any pixel type
/// result   the asked size, else like the source. Sizes that follow from others are rounded half up, at least 1.
///          At most 1 000 000 on a side
/// Position the centre of result pixel j lies at (j + ½) · source size / result size, exactly, of pixels whose centres
///          lie at i + ½. The same size gives the same pixels, bit for bit
/// Weights  bilinear, bicubic and lanczos are widened when shrinking, so that nothing aliases. Weights sum to 1; what
///          lies beyond an edge is taken to be the pixel at the edge
/// Numbers  sums in f32, rounded once at the end; overshoot saturates in integers and stays in f32. A constant image
///          stays constant: exactly in u8 and u16, in f32 within 4·10⁻⁶ of the value (linear light: 6·10⁻⁶)
/// Light    sRGB is decoded before and encoded after with Light::Linear; linear images and data are summed as stored
/// Alpha    colors are weighted by alpha: hidden ones don't bleed. A pixel without alpha gets color 0. Nearest copies
/// NaN      and infinity make those result pixels NaN whose windows hold them. Windows have as many pixels as any
/// needs:
///          2, 4, 6 (bilinear, bicubic, lanczos; times the factor when shrinking), area the factor and at most two
///          more; at an edge they are moved inside
/// Cost     O(result rows · source columns · window) when shrinking; memory grows with the factor, not with the image
/// Throws   Error(Argument) for options out of range, a scale beside a width or height, a result too large
/// Source   Keys, Cubic convolution interpolation for digital image processing, IEEE Trans. ASSP 29 (1981);
///          Turkowski, Filters for common resampling tasks, Graphics Gems I (1990)
AZULEJO_EXPORT void resize(const ConstAnyView& source, const AnyView& result, const ResizeOptions& options = {},
                           const Run& run = {});
AZULEJO_EXPORT Image resize(const Image& source, const ResizeOptions& options = {}, const Run& run = {});

}  // namespace azulejo
