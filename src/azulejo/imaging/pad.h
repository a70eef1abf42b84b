#pragma once

#include <array>
#include <optional>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/engine/border.h"
#include "azulejo/imaging/anchor.h"
#include "azulejo/math/color.h"

namespace azulejo {

struct PadOptions {
  int left = 0;                                   ///< columns that are added, 0–100000
  int right = 0;                                  ///< columns
  int top = 0;                                    ///< rows
  int bottom = 0;                                 ///< rows
  std::optional<std::array<float, 2>> size = {};  ///< width, height of the result, instead of those four
  Anchor anchor = Anchor::Center;                 ///< where the image lies in that size
  Border border = Border::Constant;               ///< what is added
  std::optional<Color> color = {};  ///< of Border::Constant; none: transparent where there is alpha, else black
};

/// Adds rows and columns around an image.
///
/// source   any size, channels, pixel type
/// result   the source with what is added; the same channels, type and states, the source's bytes unchanged
/// Color    as the image stores it: encoded, or light where that is linear; of gray its luma (Rec. 601); more channels
///          than three take it too. A color that isn't opaque lies on black where the image has no alpha
/// Cost     O(pixels of the result), bound by memory
/// Throws   Error(Argument) for an option out of range, size beside left, right, top or bottom, and a size smaller than
///          the image
AZULEJO_EXPORT void pad(const ConstAnyView& source, const AnyView& result, const PadOptions& options = {},
                        const Run& run = {});
AZULEJO_EXPORT Image pad(const Image& source, const PadOptions& options = {}, const Run& run = {});

}  // namespace azulejo
