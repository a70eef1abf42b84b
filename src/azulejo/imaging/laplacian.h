#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/engine/border.h"

namespace azulejo {

enum class LaplacianNeighbors : std::uint8_t {
  Four,   ///< [0 1 0; 1 −4 1; 0 1 0]
  Eight,  ///< [1 1 1; 1 −8 1; 1 1 1]: the diagonals, too
};

constexpr auto enum_names(LaplacianNeighbors) { return std::array<std::string_view, 2>{"4", "8"}; }

struct LaplacianOptions {
  LaplacianNeighbors neighbors = LaplacianNeighbors::Four;  ///< that the pixel is subtracted from
  Border border = Border::Mirror;                           ///< what lies outside the image
  float border_value = 0.0F;                                ///< of Border::Constant, intensity 0–1, alpha too
};

/// The sum of second derivatives to the right and downwards: neighbors minus the pixel.
///
/// source   any size, 1–4 channels, any pixel type; each color channel by itself, multiplied by alpha. Alpha has no
///          derivative of its own
/// result   f32, as many channels as the source has colors, ColorState::Data; must not overlap the source
/// Unit     full range: positive in a dark pixel among bright ones (white around black gives 4 or 8), negative in a
///          bright one; exactly 0 on constants and, but for rounding, on ramps
/// Exact    integers are summed exactly, then scaled in f32; the others within 2⁻¹⁹ of the largest value
/// NaN      in the 3 × 3 values around gives NaN
/// Cost     O(pixels)
/// Throws   Error(Argument) for an option out of range
/// Source   Gonzalez & Woods, Digital Image Processing, 4th ed., 3.6 (3-53)
AZULEJO_EXPORT void laplacian(const ConstAnyView& source, const AnyView& result, const LaplacianOptions& options = {},
                              const Run& run = {});
AZULEJO_EXPORT Image laplacian(const Image& source, const LaplacianOptions& options = {}, const Run& run = {});

}  // namespace azulejo
