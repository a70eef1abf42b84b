#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/engine/border.h"

namespace azulejo {

/// Which pixels around one its Laplacian counts.
enum class Neighbors : std::uint8_t { Four, Eight };

constexpr auto enum_names(Neighbors) { return std::array<std::string_view, 2>{"4", "8"}; }

struct LaplacianOptions {
  Neighbors neighbors = Neighbors::Four;  ///< 0 1 0 / 1 −4 1 / 0 1 0, or 1 1 1 / 1 −8 1 / 1 1 1
  Border border = Border::Mirror;         ///< what lies outside the image
  float border_value = 0.0F;              ///< of Border::Constant, intensity 0–1 of every channel, alpha too
};

/// The Laplacian: the sum of the neighbors minus as often the pixel itself. Positive in a dark place, negative in a bright
/// one, 0 where intensity is constant or changes evenly.
///
/// source  any size, 1–4 channels, any pixel type; each color channel by itself, multiplied by alpha
/// result  f32, as many channels as the source has colors, ColorState::Data, in units of full range: not divided by the
///         kernel's weight, a single white pixel on black gives −4 or −8
/// Exact   integers are summed exactly, then scaled in f32; the others within 2⁻²¹ of the largest value. On constant
///         areas 0 to the last bit
/// NaN     in the neighbors, or the pixel itself, gives NaN
/// Cost    O(pixels)
/// Throws  Error(Argument) for an option out of range
/// Source  Gonzalez & Woods, Digital Image Processing, 4th ed., 3.6 (3-53, figure 3.45)
AZULEJO_EXPORT void laplacian(const ConstAnyView& source, const AnyView& result, const LaplacianOptions& options = {},
                              const Run& run = {});
AZULEJO_EXPORT Image laplacian(const Image& source, const LaplacianOptions& options = {}, const Run& run = {});

}  // namespace azulejo
