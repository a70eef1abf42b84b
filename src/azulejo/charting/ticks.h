#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "azulejo/core/export.h"

namespace azulejo {

enum class AxisScale : std::uint8_t { Linear, Log };
constexpr auto enum_names(AxisScale) { return std::array<std::string_view, 2>{"linear", "log"}; }

/// Where an axis is marked, and what stands there.
struct Ticks {
  std::vector<double> values;       ///< rising, within the axis
  std::vector<std::string> labels;  ///< one each, with U+2212 as minus
  std::vector<double> minor;        ///< places without a label
  int exponent = 0;                 ///< labels are values ÷ 10^exponent; not 0: the axis says so once
};

/// Chooses marks at round numbers.
///
/// low, high  finite, low < high, low > 0 on a logarithmic axis
/// most       labels at most, 2 or more
/// Linear     the smallest step of 1, 2 or 5 · 10^n that gives at most so many: at least two where most is 5 or more.
///            All labels have as many decimals as the step needs. From 10⁶ on and below 10⁻³ they have a common power of
///            1000
/// Log        all of 1, 2, 5 · 10^n if they are few enough, else powers of ten, or every so-many-th of them. Over less
///            than a decade: linear
/// Exact      labels are the decimal numbers themselves, values the doubles next to them
/// Throws     Error(Argument) for a range as above is not, or one narrower than 10⁻¹² of its numbers
AZULEJO_EXPORT Ticks make_ticks(double low, double high, AxisScale scale, int most);

/// "10⁻³"
AZULEJO_EXPORT std::string power_of_ten(int exponent);

}  // namespace azulejo
