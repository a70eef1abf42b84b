#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/imaging/anchor.h"

namespace azulejo {

/// What lengths are measured in.
enum class LengthUnit : std::uint8_t {
  Pixels,
  Fractions,  ///< of the image's width and height
};

constexpr auto enum_names(LengthUnit) { return std::array<std::string_view, 2>{"pixels", "fractions"}; }

struct CropOptions {
  std::optional<std::array<float, 4>> rect = {};  ///< left, top, width, height
  std::optional<std::array<float, 2>> size = {};  ///< width, height, instead of rect: placed by the anchor
  Anchor anchor = Anchor::Center;                 ///< where a part of that size lies
  LengthUnit unit = LengthUnit::Pixels;           ///< of rect and size
};

/// Takes a part of an image. Its edges are the nearest between pixels. Nothing asked is the whole image.
///
/// source   any size, channels, pixel type
/// result   the part; the same channels, type and states, the same bytes
/// Cost     O(pixels of the part), bound by memory
/// Throws   Error(Argument) for rect and size both, a part that has no pixel or isn't inside the image
AZULEJO_EXPORT void crop(const ConstAnyView& source, const AnyView& result, const CropOptions& options = {},
                         const Run& run = {});
AZULEJO_EXPORT Image crop(const Image& source, const CropOptions& options = {}, const Run& run = {});

}  // namespace azulejo
