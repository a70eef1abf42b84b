#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"

namespace azulejo {

struct GammaOptions {
  float gamma = 0.5F;  ///< exponent, 0.01–100: below 1 brightens, above 1 darkens
};

/// Raises intensities to a power: v becomes v^gamma. Black and white stay; what is between is spread or compressed.
///
/// source   any size, 1–4 channels, any pixel type; stored values, each color channel by itself
/// result   same shape and type; may be the source itself. Integers are the nearest to the power, u16 but for one value
///          in a thousand, which is the second nearest. f32 within 10⁻⁶ · (1 + |log2 of the result|), relatively
/// Range    the curve goes on beyond 1, and below 0 as −|v|^gamma; what is smaller than 2⁻¹²⁵ becomes 0
/// Alpha    is copied; premultiplied color is divided by it before and multiplied after
/// NaN      stays NaN
/// Cost     O(pixels); u8 is looked up in a table
/// Throws   Error(Argument) for an exponent out of range
/// Source   Gonzalez & Woods, Digital Image Processing, 4th ed., 3.2 (3-5), with c = 1
AZULEJO_EXPORT void gamma(const ConstAnyView& source, const AnyView& result, const GammaOptions& options = {},
                          const Run& run = {});
AZULEJO_EXPORT Image gamma(const Image& source, const GammaOptions& options = {}, const Run& run = {});

}  // namespace azulejo
