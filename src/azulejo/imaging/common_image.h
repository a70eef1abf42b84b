#pragma once

#include "azulejo/data/view.h"

namespace azulejo {

/// The kind of image that holds two: of their size, pixel type and color state, with as many color channels as the
/// richer of them (gray counts as a color of equal channels), and alpha if either has it: as in the source, or as in the
/// other where only that has it.
/// Throws  Error(Argument) for images that don't fit
ImageInfo common_image(const ImageInfo& source, const ImageInfo& other);

}  // namespace azulejo
