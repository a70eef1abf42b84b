#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"

namespace azulejo {

struct DivideOptions {
  float by_zero = 0.0F;  ///< the quotient where the other is 0, −10⁹–10⁹
};

/// The quotient of two images: source ÷ other. Corrects uneven light, if the other shows the light alone.
///
/// source, other  the same size and pixel type, and color state unless one is data; the same number of color channels,
///                or one of them gray, which then counts as a color of equal channels
/// result         f32: 1 where both are equal; color state data; as many color channels as the richer of them, alpha of
///                the source. May be one of them where it has the same shape
/// By zero        options.by_zero, whatever is divided
/// Alpha          the source's is copied; the other is taken as it is seen on white, so that what can't be seen changes
///                nothing
/// NaN            of either stays NaN, unless it is divided by 0
/// Cost           O(pixels), without alpha bound by memory
/// Throws         Error(Argument) for images that don't fit and options out of range
/// Source         Gonzalez & Woods, Digital Image Processing, 4th ed., 2.6, shading correction
AZULEJO_EXPORT void divide(const ConstAnyView& source, const ConstAnyView& other, const AnyView& result,
                           const DivideOptions& options = {}, const Run& run = {});
AZULEJO_EXPORT Image divide(const Image& source, const Image& other, const DivideOptions& options = {},
                            const Run& run = {});

}  // namespace azulejo
