#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/engine/border.h"
#include "azulejo/imaging/filter_output.h"
#include "azulejo/imaging/light.h"

namespace azulejo {

/// A low-pass filter's share of what it lets through at a frequency q times the cut-off.
enum class FrequencyShape : std::uint8_t {
  Ideal,        ///< 1 up to q = 1, then 0: rings at edges
  Gaussian,     ///< exp(−q² / 2): never rings
  Butterworth,  ///< 1 / (1 + q²ⁿ): the higher the order n, the steeper, and the more it rings
};

constexpr auto enum_names(FrequencyShape) {
  return std::array<std::string_view, 3>{"ideal", "gaussian", "butterworth"};
}

enum class FrequencyPass : std::uint8_t {
  Low,   ///< below the cut-off
  High,  ///< above: 1 − low
  Band,  ///< above the cut-off and below the upper one: their product
  Stop,  ///< all others: 1 − band
};

constexpr auto enum_names(FrequencyPass) { return std::array<std::string_view, 4>{"low", "high", "band", "stop"}; }

struct FrequencyFilterOptions {
  FrequencyPass pass = FrequencyPass::Low;          ///< what is let through
  FrequencyShape shape = FrequencyShape::Gaussian;  ///< how it begins and ends
  float cutoff = 0.2F;                              ///< share of Nyquist's frequency, 0.001–1.5
  float upper = 0.5F;                               ///< upper cut-off of Band and Stop, above the other
  int order = 2;                                    ///< of Butterworth, 1–20
  float offset = 0.0F;                              ///< added to the result, an intensity
  FilterOutput output = FilterOutput::Same;         ///< what values below 0 and above 1 become
  Border border = Border::Mirror;                   ///< what lies outside the image
  float border_value = 0.0F;                        ///< of Border::Constant, intensity 0–1, alpha too
  Light light = Light::Encoded;                     ///< what is filtered: stored values, or linear light
};

/// Filters by frequency: the image's Fourier transform is multiplied by a response that depends on the distance from
/// frequency 0 only.
///
/// Unit     1 is Nyquist's frequency, half a cycle a pixel; towards corners there are frequencies up to √2
/// source   any size, 1–4 channels, any pixel type; each color channel by itself, multiplied by alpha, which stays
/// result   same shape and type; with output=f32 f32 in units of full range, as many channels as the source has colors,
///          multiplied by alpha, ColorState::Data. May be the source
/// Border   the image is continued on all sides by at least 8 / cutoff pixels, or as many as it has, then repeated.
///          Border::Wrap: nothing is added, the image itself is repeated
/// Exact    computed in f32, rounded once: within 10⁻⁶ of the largest value. Constants stay constant to the last bit
///          (Low, Stop) or are exactly `offset` (High, Band)
/// NaN      or infinity makes all of its channel NaN
/// Cost     O(pixels · log pixels), memory for three images of f32; the same bytes for any thread count
/// Throws   Error(Argument) for an option out of range, an upper cut-off that is not above the other
/// Source   Gonzalez & Woods, Digital Image Processing, 4th ed., 4.7 to 4.10
AZULEJO_EXPORT void frequency_filter(const ConstAnyView& source, const AnyView& result,
                                     const FrequencyFilterOptions& options = {}, const Run& run = {});
AZULEJO_EXPORT Image frequency_filter(const Image& source, const FrequencyFilterOptions& options = {},
                                      const Run& run = {});

}  // namespace azulejo
