#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/imaging/filter_output.h"
#include "azulejo/imaging/light.h"

namespace azulejo {

/// What the image is multiplied by before it is transformed.
enum class SpectrumWindow : std::uint8_t {
  None,  ///< nothing: where opposite edges differ, a cross appears
  Hann,  ///< sin² from edge to edge, both ways: no cross, peaks twice as wide
};

constexpr auto enum_names(SpectrumWindow) { return std::array<std::string_view, 2>{"none", "hann"}; }

struct SpectrumOptions {
  SpectrumWindow window = SpectrumWindow::None;  ///< against the cross of edges that don't fit together
  FilterOutput output = FilterOutput::Same;      ///< Same: stretched to full range; F32: as they are
  Light light = Light::Encoded;                  ///< what is transformed: stored values, or linear light
};

/// The magnitude of the image's discrete Fourier transform, logarithmic: ln(1 + |F|), intensities being 0–1.
///
/// source   any size, 1–4 channels, any pixel type; each color channel by itself, multiplied by alpha
/// result   same size and type, as many channels as the source has colors, ColorState::Data; divided by the largest
///          value of all channels so that that is full range. output=f32: f32, not divided
/// Place    frequency (u, v) cycles in the image's width and height is at column width / 2 + u, row height / 2 + v, so
///          frequency 0, the sum of all intensities, is in the middle
/// Exact    computed in f32: |F| within 10⁻⁶ of the largest |F|
/// NaN      or infinity makes all of its channel NaN (integers: 0)
/// Cost     O(pixels · log pixels) at any size, least where width and height have no factors but 2 and 3; memory for
///          two images of f32. The same bytes for any thread count
/// Throws   Error(Argument) for an option out of range
/// Source   Gonzalez & Woods, Digital Image Processing, 4th ed., 4.5 and 4.6
AZULEJO_EXPORT void spectrum(const ConstAnyView& source, const AnyView& result, const SpectrumOptions& options = {},
                             const Run& run = {});
AZULEJO_EXPORT Image spectrum(const Image& source, const SpectrumOptions& options = {}, const Run& run = {});

}  // namespace azulejo
