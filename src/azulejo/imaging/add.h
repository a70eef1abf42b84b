#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"

namespace azulejo {

struct AddOptions {};

/// The sum of two images: their light together, where values are light.
///
/// source, other  the same size and pixel type, and color state unless one is data; the same number of color channels,
///                or one of them gray, which then counts as a color of equal channels
/// result         as many color channels as the richer of them; the source's type and color state; alpha if either has it.
///                Integers saturate; f32 goes on beyond 1. May be one of them where it has the same shape
/// Alpha          color is weighted by its alpha, so that what can't be seen adds nothing; alphas are added, to 1 at most
/// NaN            of either stays NaN
/// Cost           O(pixels), without alpha bound by memory
/// Throws         Error(Argument) for images that don't fit
/// Source         Porter & Duff, Compositing Digital Images, SIGGRAPH 1984, 4.3: plus
AZULEJO_EXPORT void add(const ConstAnyView& source, const ConstAnyView& other, const AnyView& result,
                        const AddOptions& options = {}, const Run& run = {});
AZULEJO_EXPORT Image add(const Image& source, const Image& other, const AddOptions& options = {}, const Run& run = {});

}  // namespace azulejo
