#pragma once

#include <optional>
#include <string_view>

#include "azulejo/math/color.h"

namespace azulejo {

/// A color as CSS writes it: a name, #rgb[a], #rrggbb[aa], rgb(), rgba(), hsl() and hsla() with commas or without, values
/// out of range pulled into it. What follows a color in older files ("icc-color(…)") is not looked at.
/// Nothing for other text: "none", "currentColor".
/// Source  CSS Color Module Level 4, 5 to 7
std::optional<Color> parse_css_color(std::string_view text);

}  // namespace azulejo
