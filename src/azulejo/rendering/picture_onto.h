#pragma once

#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/math/rect.h"

namespace azulejo {

/// Puts a part of a picture over the same part of another image; elsewhere that is as it was. So several viewports come
/// into one picture.
///
/// under    any channels and type
/// picture  of under's size, 3 or 4 channels, any type
/// area     pixels of the picture that count
/// Result   under's type, color and alpha state; three color channels
/// Alpha    the picture's share is its alpha (over); the values that are weighted and summed are as they are stored
/// Rounding once, half up; where the picture is transparent, under's own bytes
/// NaN      of either stays where its share is not 0
/// Throws   Error(Argument), beginning with `onto`, for another size or color state than the picture's
/// Source   Porter & Duff, Compositing Digital Images, SIGGRAPH 1984
Image picture_onto(const Image& under, const Image& picture, const Rect& area, const Run& run);

/// Throws what picture_onto would for a picture of this color state.
void check_onto(const Image& under, ColorState picture);

}  // namespace azulejo
