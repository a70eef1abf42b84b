#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "azulejo/core/export.h"

namespace azulejo {

/// A color as it is written: sRGB-encoded, 0–1, straight alpha.
struct Color {
  float r = 0;
  float g = 0;
  float b = 0;
  float a = 1;
  friend bool operator==(const Color&, const Color&) = default;
};

/// Red, green, blue as linear light, and alpha; still straight.
AZULEJO_EXPORT std::array<float, 4> to_linear(const Color& color);

/// "#rgb", "#rgba", "#rrggbb", "#rrggbbaa", a name of CSS (any case; "transparent" too), or a gray as one number from
/// 0 to 1. Nothing for other text.
/// Source  CSS Color Module Level 4, 6.1 and 6.2
AZULEJO_EXPORT std::optional<Color> parse_color(std::string_view text);
/// "#rrggbb", or "#rrggbbaa" where it is not opaque; a gray between two of 256 steps as a number; other colors
/// rounded to 256 steps.
AZULEJO_EXPORT std::string to_string(const Color& color);

}  // namespace azulejo
