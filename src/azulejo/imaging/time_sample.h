#pragma once

#include <optional>
#include <span>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/imaging/light.h"

namespace azulejo {

struct TimeSampleOptions {
  float time = 0;                     ///< when the shutter opens, in frames: 0 is when the first one begins
  std::optional<float> shutter = {};  ///< for how many frames it is open; 0: an instant; left out: to the end
  Light light = Light::Linear;        ///< what is integrated
};

/// Samples a sequence of frames in time: at an instant, or integrated over the interval in which a shutter is open.
///
/// Frame i is what is seen from time i to i + 1, so an instant is one frame, as it is; an interval is the mean of the
/// frames weighted by how much of it each takes. The longer it is, the less moves in jumps and the more it is blurred.
///
/// frames   one or more of the same size, channels, type and states; the interval lies within them
/// result   like a frame. Sums in f32, rounded once; what doesn't change stays as it is, f32 within 4·10⁻⁶
/// Light    linear: sRGB is decoded before and encoded after: light adds up
/// Alpha    colors are weighted by alpha: hidden ones don't bleed; an instant is copied
/// NaN      of any frame in the interval makes the value NaN
/// Cost     O(pixels · frames in the interval)
/// Throws   Error(Argument) for frames that differ and an interval that reaches beyond them
AZULEJO_EXPORT void time_sample(std::span<const ConstAnyView> frames, const AnyView& result,
                                const TimeSampleOptions& options = {}, const Run& run = {});
AZULEJO_EXPORT Image time_sample(std::span<const Image* const> frames, const TimeSampleOptions& options = {},
                                 const Run& run = {});

}  // namespace azulejo
