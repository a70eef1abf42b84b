#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/imaging/light.h"

namespace azulejo {

struct BlendOptions {
  float amount = 0.5F;           ///< share of the other image, 0–1
  Light light = Light::Encoded;  ///< what is weighted and summed: stored values, or the light they stand for
};

/// Mixes two images: (1 − amount) · source + amount · other.
///
/// source, other  the same size, pixel type and color state; the same number of color channels, or one of them gray,
///                which then counts as a color of equal channels
/// result         as many color channels as the richer of them; alpha if either has it: as in the source, or as in
///                the other where only that has it. May be one of them where it has the same shape
/// Alpha          color is weighted by its alpha, so that what can't be seen doesn't show; alpha 0 gives color 0. An
///                image without alpha is opaque
/// Rounding       once, half up. u8 without straight alpha and in encoded light takes the amount in steps of 1/32768,
///                then is exact: off by less than 1/256 of a level
/// NaN            of either image stays NaN, even where its share is 0
/// Cost           O(pixels); with equal shapes, without straight alpha and in encoded light bound by memory
/// Throws         Error(Argument) for images that don't fit and an amount outside 0–1
/// Source         Porter & Duff, Compositing Digital Images, SIGGRAPH 1984, 4.3: dissolve and plus
AZULEJO_EXPORT void blend(const ConstAnyView& source, const ConstAnyView& other, const AnyView& result,
                          const BlendOptions& options = {}, const Run& run = {});
AZULEJO_EXPORT Image blend(const Image& source, const Image& other, const BlendOptions& options = {},
                           const Run& run = {});

}  // namespace azulejo
