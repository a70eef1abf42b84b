#pragma once

#include <cstdint>

#include "azulejo/data/view.h"

namespace azulejo::kernels {

enum class GrayRule : std::uint8_t {
  Luma,            ///< Rec. 601 weights on stored values
  Luminance,       ///< Rec. 709 weights on stored values
  LightLuminance,  ///< Rec. 709 weights on the light that sRGB values stand for
};

/// The gray of a tile of 3 channels, or of 4 whose last is copied.
void grayscale(const ConstAnyView& source, const AnyView& result, GrayRule rule);

}  // namespace azulejo::kernels
