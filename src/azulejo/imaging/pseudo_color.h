#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/math/color.h"

namespace azulejo {

/// Colors from the lowest to the highest value.
enum class ColorMap : std::uint8_t {
  Viridis,  ///< dark blue, green, yellow: lightness rises evenly, seen alike with color-deficient eyes
  Magma,    ///< black, purple, orange, white: lightness rises evenly
  Turbo,    ///< dark blue, green, red: a smooth rainbow
  Jet,      ///< blue, cyan, yellow, red: has bands that are not in the data
  Hot,      ///< black, red, yellow, white
  Gray,     ///< black to white
  Rainbow,  ///< violet to red, the hues of the spectrum
  Cyclic,   ///< hues of one lightness, ends where it began: for angles
};

constexpr auto enum_names(ColorMap) {
  return std::array<std::string_view, 8>{"viridis", "magma", "turbo", "jet", "hot", "gray", "rainbow", "cyclic"};
}

struct PseudoColorOptions {
  ColorMap map = ColorMap::Viridis;
  std::optional<float> low = 0.0F;           ///< intensity of the map's first color; nothing: the image's smallest
  std::optional<float> high = 1.0F;          ///< of its last color; nothing: the image's largest
  std::optional<int> levels = std::nullopt;  ///< as many colors, 2–256, in bands of equal width; nothing: all
  Color nan_color = {0, 0, 0, 1};            ///< of what is not a number; its alpha does not count
};

/// Shows gray values as colors.
///
/// source   any size and pixel type; 1 channel, or 2 with alpha
/// result   3 channels, or 4 with the source's alpha; same type and alpha state; color state srgb
/// Range    values below `low` and above `high` have the colors of the ends; with `low` above `high` the map is
///          reversed; where both are the same, everything has the first color. With `low` and `high` 0–1 every pixel
///          type fits; f32 may be of any range (depths: auto)
/// auto     finite values of pixels whose alpha is not 0 count; premultiplied values are divided by alpha
/// levels   bands that a smooth picture has not: false contours
/// Alpha    is copied; premultiplied: values are divided by it, colors multiplied (alpha 0: color 0)
/// Maps     linear in sRGB between colors at equal distances: viridis, magma and turbo are within 1/255 of the
///          published tables of 256 colors
/// Cost     O(pixels); auto reads the image once more
/// Throws   Error(Argument) for other channels or options out of range
/// Source   Gonzalez & Woods, Digital Image Processing, 4th ed., 6.3; viridis, magma: Smith, van der Walt, Firing, 2015
///          (CC0); turbo: A. Mikhailov, Google, 2019 (Apache 2.0); cyclic: CIELAB, L* 70, C* 38
AZULEJO_EXPORT void pseudo_color(const ConstAnyView& source, const AnyView& result,
                                 const PseudoColorOptions& options = {}, const Run& run = {});
AZULEJO_EXPORT Image pseudo_color(const Image& source, const PseudoColorOptions& options = {}, const Run& run = {});

}  // namespace azulejo
