#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"

namespace azulejo {

struct MultiplyOptions {};

/// The product of intensities of two images: white leaves as it is, black makes black.
///
/// source, other  the same size and pixel type, and color state unless one is data; the same number of color channels,
///                or one of them gray, which then counts as a color of equal channels
/// result         as many color channels as the richer of them; the source's type, color state and alpha. Integers are
///                rounded once, to the nearest: u8 255 · 128 ÷ 255 is 128. May be one of them where it has the same shape
/// Alpha          the source's is copied; the other is taken as it is seen on white, so that what can't be seen changes
///                nothing
/// NaN            of either stays NaN
/// Cost           O(pixels), without alpha bound by memory
/// Throws         Error(Argument) for images that don't fit
/// Source         Gonzalez & Woods, Digital Image Processing, 4th ed., 2.6, shading correction and masks
AZULEJO_EXPORT void multiply(const ConstAnyView& source, const ConstAnyView& other, const AnyView& result,
                             const MultiplyOptions& options = {}, const Run& run = {});
AZULEJO_EXPORT Image multiply(const Image& source, const Image& other, const MultiplyOptions& options = {},
                              const Run& run = {});

}  // namespace azulejo
