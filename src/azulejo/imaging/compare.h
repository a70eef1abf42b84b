#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/json.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"

namespace azulejo {

/// What a verdict is about.
enum class Metric : std::uint8_t { Maximum, Mean, Mse, Psnr, Ssim };

constexpr auto enum_names(Metric) { return std::array<std::string_view, 5>{"maximum", "mean", "mse", "psnr", "ssim"}; }

struct CompareOptions {
  Metric metric = Metric::Maximum;     ///< what at_most and at_least are about
  std::optional<float> at_most = {};   ///< the verdict is no if the metric is larger, or there are not finite pixels
  std::optional<float> at_least = {};  ///< the verdict is no if the metric is smaller, for psnr and ssim
  bool ssim = true;                    ///< structural similarity is computed
  float gain = 1;                      ///< the difference picture is multiplied by it, 0–100000
};

/// How far two images are apart. Intensities are 0–1: 1/255 is a level of u8.
struct Comparison {
  double maximum = 0;  ///< largest absolute difference of a channel
  int maximum_x = 0;   ///< its pixel, the first of several in reading order; 0, 0 if there is no difference
  int maximum_y = 0;
  double mean = 0;             ///< mean absolute difference over all pixels and channels
  double mse = 0;              ///< mean squared difference
  double psnr = 0;             ///< −10 log₁₀(mse), decibels; infinite for equal images
  std::optional<double> ssim;  ///< mean structural similarity, 1 for equal images
  std::int64_t pixels = 0;
  std::int64_t differing_pixels = 0;
  std::int64_t not_finite_pixels = 0;  ///< where NaN or an infinity meets another number; left out of the rest
};

/// Measures how far two images are apart, and shows where.
///
/// source, reference  the same size and number of channels; pixel types may differ; not one in linear light and the
///                    other in sRGB. NaN of both, and equal infinities, are no difference
/// Difference         f32, the color channels: absolute differences of intensities, times `gain`. Colors are weighted by
///                    alpha, so that what can't be seen makes no difference; a difference of alpha counts in each
/// Similarity         f32, 1 channel: SSIM of the luma (Rec. 601 of stored values, as seen on black) in Gaussian windows,
///                    σ = 1.5, 11×11, K₁ = 0.01, K₂ = 0.03, mirrored at the borders. The mean is over the pixels whose
///                    window lies inside, if there are any
/// Cost               O(pixels); three quarters of it for SSIM. Bounded memory, the images are never held whole
/// Throws             Error(Argument) for images that don't fit
/// Source             Wang, Bovik, Sheikh, Simoncelli: Image Quality Assessment, IEEE TIP 13(4), 2004
AZULEJO_EXPORT Comparison compare(const ConstAnyView& source, const ConstAnyView& reference,
                                  const CompareOptions& options = {}, const Run& run = {});
AZULEJO_EXPORT Comparison compare(const Image& source, const Image& reference, const CompareOptions& options = {},
                                  const Run& run = {});
/// The pictures; either may have no pixels: it is not made.
AZULEJO_EXPORT void compare(const ConstAnyView& source, const ConstAnyView& reference, const AnyView& difference,
                            const AnyView& similarity, const CompareOptions& options = {}, const Run& run = {});

/// Whether a comparison is within at_most and at_least.
AZULEJO_EXPORT bool is_close(const Comparison& comparison, const CompareOptions& options);
AZULEJO_EXPORT Json to_json(const Comparison& comparison);

}  // namespace azulejo
