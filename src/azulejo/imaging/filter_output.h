#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace azulejo {

/// What becomes of sums below 0 and above 1.
enum class FilterOutput : std::uint8_t {
  Same,  ///< the source's type, saturated
  F32,   ///< f32 in units of full range, as they are
};

constexpr auto enum_names(FilterOutput) { return std::array<std::string_view, 2>{"same", "f32"}; }

}  // namespace azulejo
