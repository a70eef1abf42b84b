#pragma once

#include <optional>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/engine/border.h"
#include "azulejo/imaging/light.h"

namespace azulejo {

struct BoxOptions {
  int radius = 1;                    ///< of the window, 2 · radius + 1 pixels wide, 0–1000
  std::optional<int> radius_y = {};  ///< of its height, if that isn't its width
  Border border = Border::Mirror;    ///< what lies outside the image
  float border_value = 0.0F;         ///< of Border::Constant, intensity 0–1 of every channel, alpha too
  Light light = Light::Encoded;      ///< what is averaged: stored values, or linear light
};

/// The average of a rectangular window around each pixel.
///
/// source   any size, 1–4 channels, any pixel type. Colors are weighted by alpha: what is hidden under alpha 0 never
///          shows. Straight alpha comes back straight, with color 0 where alpha is 0
/// result   same shape and type; must not overlap the source
/// Exact    u8 and u16 of which stored values are averaged (no alpha or premultiplied, encoded or no sRGB; u16: windows of
///          up to 32767 pixels): the average, rounded half up. All else in f32: within (height + 20) · 2⁻²⁴ of it,
///          relative to the largest value, before rounding
/// NaN      makes the windows that it is in NaN, and no other; so does an infinity, as itself or NaN
/// Cost     O(pixels) along columns, O(pixels · log radius) along rows
/// Throws   Error(Argument) for an option out of range
/// Source   Gonzalez & Woods, Digital Image Processing, 4th ed., 3.5
AZULEJO_EXPORT void box(const ConstAnyView& source, const AnyView& result, const BoxOptions& options = {},
                        const Run& run = {});
AZULEJO_EXPORT Image box(const Image& source, const BoxOptions& options = {}, const Run& run = {});

}  // namespace azulejo
