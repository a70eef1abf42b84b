#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/imaging/light.h"

namespace azulejo {

/// What is done against aliases before sampling.
enum class Prefilter : std::uint8_t {
  None,      ///< nothing: what is finer than two steps shows up as something coarser
  Box,       ///< the mean of the step × step pixels around, as of a sensor whose cells touch
  Gaussian,  ///< σ = step / 2, cut off at 4 σ
};

constexpr auto enum_names(Prefilter) { return std::array<std::string_view, 3>{"none", "box", "gaussian"}; }

struct SampleOptions {
  int step = 8;                           ///< pixels from a sample to the next, 1–256
  Prefilter prefilter = Prefilter::None;  ///< against aliases
  bool show = false;                      ///< the result has the source's size; each sample fills its square
  Light light = Light::Linear;            ///< what the prefilter averages
};

/// Samples an image in space: takes one value of each square of step × step pixels.
///
/// The square of sample j begins at pixel j · step; the last one is cut by the edge. Without prefilter the sample is
/// the pixel in the middle of the square, or the one left of and above it; prefilters are centered in the square. They
/// weigh no pixels outside the image: weights of what is there sum to 1.
///
/// source   any size, 1–4 channels, any pixel type
/// result   ⌈width / step⌉ × ⌈height / step⌉, or with `show` the source's size; else like the source
/// Light    linear: sRGB is decoded before the prefilter and encoded after; the box of integers as they are stored is
///          the exact mean, rounded half up
/// Alpha    the prefilter weighs colors by alpha: hidden ones don't bleed; without prefilter pixels are copied
/// NaN      makes the samples NaN whose prefilter reaches it
/// Cost     O(pixels); of the Gaussian, 4 times
/// Throws   Error(Argument) for options out of range
/// Source   Gonzalez & Woods, Digital Image Processing, 4th ed., 2.4 and 4.5
AZULEJO_EXPORT void sample(const ConstAnyView& source, const AnyView& result, const SampleOptions& options = {},
                           const Run& run = {});
AZULEJO_EXPORT Image sample(const Image& source, const SampleOptions& options = {}, const Run& run = {});

}  // namespace azulejo
