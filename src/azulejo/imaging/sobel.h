#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/engine/border.h"

namespace azulejo {

struct SobelOptions {
  Border border = Border::Mirror;  ///< what lies outside the image
  float border_value = 0.0F;       ///< of Border::Constant, intensity 0–1 of every channel, alpha too
};

/// f32, as many channels as the source has colors, ColorState::Data.
struct SobelResult {
  Image magnitude;    ///< √(x² + y²)
  Image x;            ///< positive where intensity grows to the right
  Image y;            ///< positive where intensity grows downwards
  Image orientation;  ///< of the gradient, radians in (−π, π], counter-clockwise as seen: 0 points right, π/2 up
};

/// Where results go; what has no data is not computed.
struct SobelViews {
  AnyView magnitude = {};
  AnyView x = {};
  AnyView y = {};
  AnyView orientation = {};
};

/// The gradient by Sobel's kernels: x = [1 2 1]ᵀ ⊗ [−1 0 1], y = [−1 0 1]ᵀ ⊗ [1 2 1].
///
/// source       any size, 1–4 channels, any pixel type; each color channel by itself, multiplied by alpha. Alpha has no
///              gradient of its own
/// Unit         full range: not divided by the kernel's weight, so a step from 0 to 1 gives 4, a ramp of s a pixel 8s
/// orientation  of ascent, arctan(−y ÷ x); 0 where the gradient is 0. Within 4·10⁻⁷
/// Exact        integers are summed exactly, then scaled in f32; the others within 2⁻²² of the largest value
/// NaN          in the 3 × 3 values around gives NaN (x doesn't see its own column, y not its own row); the
///              orientation of two infinite derivatives is NaN
/// Cost         O(pixels)
/// Throws       Error(Argument) for an option out of range
/// Source       Gonzalez & Woods, Digital Image Processing, 4th ed., 10.2 (10-24, 10-25); x and y as columns and rows
AZULEJO_EXPORT void sobel(const ConstAnyView& source, const SobelViews& results, const SobelOptions& options = {},
                          const Run& run = {});
AZULEJO_EXPORT SobelResult sobel(const Image& source, const SobelOptions& options = {}, const Run& run = {});

}  // namespace azulejo
