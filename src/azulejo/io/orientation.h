#pragma once

#include "azulejo/data/view.h"

namespace azulejo {

/// Size and kind of an image that was stored in this EXIF orientation (1–8) once it stands upright.
ImageInfo turned_info(ImageInfo stored, int orientation);

/// Puts stored rows [first, first + rows.height()) where they belong in the upright image.
/// Source: CIPA DC-008 (Exif 2.3), table 6
void place_turned_rows(const ConstAnyView& rows, int first, int orientation, const AnyView& upright);

}  // namespace azulejo
