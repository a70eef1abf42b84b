#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"

namespace azulejo {

/// What the three values of a pixel mean. Full range (255, 65535 or 1.0) and 0 stand for, in the order of channels:
///
/// Srgb    red, green, blue as encoded by sRGB's curve, 0–1
/// Linear  red, green, blue light with sRGB's primaries, 0–1
/// Xyz     CIE X, Y, Z of the light, each as a share of white's (D65: 0.9505, 1, 1.0891), 0–1: white is 1, 1, 1
/// Lab     CIELAB with that white: L* 0–100, a* −128–127, b* −128–127; gray has a* = b* = 128/255 of the range
/// Lch     the same in polar form: L* 0–100, chroma C*ab 0–150, hue hab 0–360°
/// Hsv     hue 0–360° of sRGB's hexcone, saturation 0–1, value 0–1
/// Hsl     hue 0–360°, saturation 0–1, lightness 0–1 of the double hexcone
/// Ycbcr   JPEG's luma Y 0–1 and color differences −½–½ around 128/255 of the range: Rec. 601, full range
///
/// A space is thus stored the same way in every pixel type, and Lab as in ICC profiles and TIFF's ICCLab. Hue 0 and
/// hue 360° are the same color; gray has hue 0.
enum class ColorSpace : std::uint8_t { Srgb, Linear, Xyz, Lab, Lch, Hsv, Hsl, Ycbcr };

constexpr auto enum_names(ColorSpace) {
  return std::array<std::string_view, 8>{"srgb", "linear", "xyz", "lab", "lch", "hsv", "hsl", "ycbcr"};
}

struct ColorSpaceOptions {
  ColorSpace to = ColorSpace::Lab;
  std::optional<ColorSpace> from = std::nullopt;  ///< nothing: as the image's color state says, srgb or linear
};

/// Says the colors of pixels in another space.
///
/// source   any size and pixel type; 3 channels, or 4 with alpha
/// result   same shape, type and alpha state; color state srgb, linear, or data for all other spaces; may be the source
///          itself. Integers are rounded half up and saturated: lab, lch and xyz hold all colors of sRGB
/// Error    u8: hsv, hsl and ycbcr of sRGB are the exact quotients, rounded. Others, and f32: within 2·10⁻⁶ of the
///          range for colors in 0–1 (hues: times 1/saturation, or 1/chroma)
/// Back     sRGB there and back, largest difference in steps of u8: ycbcr 1, hsv 3, hsl 4, linear 6, lab 24, xyz 25,
///          lch 34 (dark colors, whose light has few steps, and saturated ones); u16 at most 50 of its own steps;
///          f32 2·10⁻⁵
/// Alpha    is copied; premultiplied color is divided by alpha before and multiplied after (alpha 0: color 0)
/// NaN      or an infinity in a color channel makes the pixel's three color channels NaN
/// Cost     O(pixels): of u8, hsv takes 3 times as long as a copy, lab 14 times
/// Throws   Error(Argument) for other channels, and for data without `from`
/// Source   IEC 61966-2-1; CIE 15:2004, 8.2.1; matrices from the chromaticities of ITU-R BT.709-6 and D65 =
///          (0.3127, 0.3290); A. R. Smith, Color Gamut Transform Pairs, 1978; Joblove & Greenberg, Color Spaces for
///          Computer Graphics, 1978; ITU-T T.871, 7; Lab as ICC.1:2010, 6.3.4.2; chroma's range as CSS Color 4, 9.3
AZULEJO_EXPORT void color_space(const ConstAnyView& source, const AnyView& result,
                                const ColorSpaceOptions& options = {}, const Run& run = {});
AZULEJO_EXPORT Image color_space(const Image& source, const ColorSpaceOptions& options = {}, const Run& run = {});

}  // namespace azulejo
