#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace azulejo {

/// Where the smaller of two rectangles lies in the larger one. Where it can't lie in the middle, it is half a pixel
/// further to the left or to the top.
enum class Anchor : std::uint8_t {
  TopLeft,
  Top,
  TopRight,
  Left,
  Center,
  Right,
  BottomLeft,
  Bottom,
  BottomRight,
};

constexpr auto enum_names(Anchor) {
  return std::array<std::string_view, 9>{"top_left", "top",         "top_right", "left",        "center",
                                         "right",    "bottom_left", "bottom",    "bottom_right"};
}

/// How many of `free` columns lie to the left, how many of `free` rows above.
constexpr int free_left(Anchor anchor, int free) { return free * (static_cast<int>(anchor) % 3) / 2; }
constexpr int free_above(Anchor anchor, int free) { return free * (static_cast<int>(anchor) / 3) / 2; }

}  // namespace azulejo
