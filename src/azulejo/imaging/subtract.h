#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"

namespace azulejo {

struct SubtractOptions {};

/// The difference of two images with its sign: source − other.
///
/// source, other  the same size and pixel type, and color state unless one is data; the same number of color channels,
///                or one of them gray, which then counts as a color of equal channels
/// result         f32 in units of full range, −1–1 for integers; color state data; as many channels as the richer of
///                them has colors, no alpha. May be one of them where it has the same shape
/// Alpha          color is weighted by its alpha: both as they are seen on black
/// NaN            of either stays NaN
/// Cost           O(pixels), without alpha bound by memory
/// Throws         Error(Argument) for images that don't fit
/// Source         Gonzalez & Woods, Digital Image Processing, 4th ed., 2.6, arithmetic operations
AZULEJO_EXPORT void subtract(const ConstAnyView& source, const ConstAnyView& other, const AnyView& result,
                             const SubtractOptions& options = {}, const Run& run = {});
AZULEJO_EXPORT Image subtract(const Image& source, const Image& other, const SubtractOptions& options = {},
                              const Run& run = {});

}  // namespace azulejo
