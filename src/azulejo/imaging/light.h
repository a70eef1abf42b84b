#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace azulejo {

/// The values that an operation on colors calculates with.
enum class Light : std::uint8_t {
  Encoded,  ///< the values as they are stored
  Linear,   ///< linear light: sRGB is decoded before and encoded after; linear colors and data are taken as they are
};

constexpr auto enum_names(Light) { return std::array<std::string_view, 2>{"encoded", "linear"}; }

}  // namespace azulejo
