#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <string_view>
#include <vector>

#include "azulejo/imaging/pseudo_color.h"
#include "azulejo/math/color.h"

namespace azulejo {

/// Colors that tell series apart.
enum class ChartPalette : std::uint8_t {
  OkabeIto,  ///< eight, told apart with all kinds of color vision
  Tol,       ///< seven, bright, likewise
  Gray,      ///< five shades, for print
};
constexpr auto enum_names(ChartPalette) { return std::array<std::string_view, 3>{"okabe_ito", "tol", "gray"}; }

/// Source  M. Okabe, K. Ito, Color Universal Design, 2008; P. Tol, Colour Schemes, 2021, "bright"
glm::vec4 series_color(ChartPalette palette, std::size_t series);

inline glm::vec4 to_vec4(const Color& color) { return {color.r, color.g, color.b, color.a}; }

/// `count` colors of a map, from its first to its last.
std::vector<glm::vec4> map_colors(ColorMap map, int count);

/// The one of `colors` for a value of a range; NaN has none: colors.size().
std::size_t color_index(double value, double low, double high, std::size_t colors);

}  // namespace azulejo
