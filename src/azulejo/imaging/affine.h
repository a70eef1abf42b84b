#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/engine/border.h"
#include "azulejo/imaging/light.h"

namespace azulejo {

/// How a result pixel is made of source pixels.
enum class AffineFilter : std::uint8_t {
  Nearest,   ///< the source pixel that holds its center
  Bilinear,  ///< a tent, 1 pixel to each side
  Bicubic,   ///< Catmull–Rom, 2 pixels to each side
  Lanczos,   ///< 3 lobes: 3 pixels to each side
};

constexpr auto enum_names(AffineFilter) {
  return std::array<std::string_view, 4>{"nearest", "bilinear", "bicubic", "lanczos"};
}

/// Which part of the plane the result shows.
enum class AffineSize : std::uint8_t {
  Same,  ///< what the source showed: as many pixels, from (0, 0)
  Fit,   ///< all that the source has become
};

constexpr auto enum_names(AffineSize) { return std::array<std::string_view, 2>{"same", "fit"}; }

struct AffineOptions {
  glm::dmat3 target_from_source{1.0};  ///< affine: the last row is 0, 0, h
  AffineFilter filter = AffineFilter::Bicubic;
  Light light = Light::Linear;
  Border border = Border::Constant;  ///< outside the source; constant: transparent where there is alpha, else black
  AffineSize size = AffineSize::Same;
};

/// Moves, turns, scales, shears or mirrors an image.
///
/// Each result pixel is looked up in the source, where the inverse matrix puts its center.
///
/// source   any size, 1–4 channels, any pixel type
/// result   like the source; its size as `size` says. `fit` begins at the lowest whole x and y
/// Position pixel (0, 0) has its center at (0.5, 0.5), y points down. In f32 from every 64th column on, that in double:
///          within 10⁻⁵ pixels where nothing shrinks
/// Weights  where the source shrinks along its columns or rows, bilinear, bicubic and lanczos are widened by as much:
///          they integrate, and nothing aliases. What shrinks aslant is blurred a little more than it had to be. Sums of
///          weights are 1; they are looked up between 1024 neighbors, within 10⁻⁶ of the filter's. Where a center meets
///          a center nothing is changed: quarter turns and mirrors give the same pixels, bit for bit
/// Numbers  sums in f32, rounded once at the end; overshoot saturates in integers and stays in f32. The same bytes on
///          every instruction set
/// Light    sRGB is decoded before and encoded after with Light::Linear; linear images and data are summed as stored
/// Alpha    colors are weighted by alpha: hidden ones don't bleed. Nearest copies
/// NaN      and infinity make those result pixels NaN whose windows hold them: 2, 4, 8 pixels (bilinear, bicubic,
///          lanczos) on a side, times the factor when shrinking, rounded up to the next four
/// Cost     O(result pixels · window); the source is held in memory
/// Throws   Error(Argument) for a matrix that is projective, singular or not finite, for one that shrinks by more than
///          100 or moves by more than 10⁹, and for a result of more than 1 000 000 on a side
/// Source   Keys, Cubic convolution interpolation for digital image processing, IEEE Trans. ASSP 29 (1981);
///          Wolberg, Digital Image Warping (1990), 3.3, 6
AZULEJO_EXPORT void affine(const ConstAnyView& source, const AnyView& result, const AffineOptions& options = {},
                           const Run& run = {});
AZULEJO_EXPORT Image affine(const Image& source, const AffineOptions& options = {}, const Run& run = {});

}  // namespace azulejo
