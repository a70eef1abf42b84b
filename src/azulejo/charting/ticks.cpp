#include "azulejo/charting/ticks.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

constexpr std::string_view kMinus = "\xE2\x88\x92";  // U+2212
constexpr std::string_view kTimes = "\xC3\x97";      // ×

/// A decimal number: digits · 10^exponent.
struct Decimal {
  std::int64_t digits = 0;
  int exponent = 0;

  double value() const {
    const std::string text = fmt::format("{}e{}", digits, exponent);
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error == std::errc::result_out_of_range) return exponent < 0 ? 0 : std::copysign(HUGE_VAL, double(digits));
    return number;
  }
};

/// The number without an exponent, as many decimals as `exponent` asks for.
std::string plain(const Decimal& number) {
  std::string text = std::to_string(std::abs(number.digits));
  if (number.exponent >= 0) {
    if (number.digits != 0) text.append(static_cast<std::size_t>(number.exponent), '0');
  } else {
    const auto decimals = static_cast<std::size_t>(-number.exponent);
    text = fmt::format("{:0>{}}", text, decimals + 1);
    text.insert(text.size() - decimals, ".");
  }
  return number.digits < 0 ? std::string(kMinus) + text : text;
}

int digits_of(std::int64_t number) { return static_cast<int>(std::to_string(std::abs(number)).size()); }

/// The power of 1000 that labels leave out.
int common_exponent(std::int64_t largest, int exponent) {
  if (largest == 0) return 0;
  const int order = digits_of(largest) - 1 + exponent;  // of its first digit
  if (order >= -3 && order < 6) return 0;
  return (order >= 0 ? order / 3 : -((2 - order) / 3)) * 3;
}

Ticks linear_ticks(double low, double high, int most) {
  constexpr double kSlack = 1e-9;  // of a step: ends that are round numbers but for rounding have a tick
  const int order = static_cast<int>(std::floor(std::log10((high - low) / most)));
  for (int exponent = order - 1;; ++exponent) {
    for (const std::int64_t mantissa : {1, 2, 5}) {
      const double step = Decimal{mantissa, exponent}.value();
      if (!(step > 0)) continue;
      const double first = std::ceil(low / step - kSlack);
      const double last = std::floor(high / step + kSlack);
      if (last - first + 1 > most) continue;
      Ticks ticks;
      const auto begin = static_cast<std::int64_t>(first);
      const auto end = static_cast<std::int64_t>(last);
      const std::int64_t largest = std::max(std::abs(begin), std::abs(end)) * mantissa;
      ticks.exponent = common_exponent(largest, exponent);
      for (std::int64_t k = begin; k <= end; ++k) {
        const Decimal number{k * mantissa, exponent};
        ticks.values.push_back(std::clamp(number.value(), low, high));
        ticks.labels.push_back(plain({number.digits, exponent - ticks.exponent}));
      }
      return ticks;
    }
  }
}

std::string log_label(std::int64_t mantissa, int exponent, bool as_plain) {
  // Without the zeros behind the point that a common number of decimals has.
  if (as_plain) return plain({mantissa, exponent});
  if (mantissa == 1) return power_of_ten(exponent);
  return fmt::format("{}{}{}", mantissa, kTimes, power_of_ten(exponent));
}

Ticks log_ticks(double low, double high, int most) {
  constexpr double kSlack = 1e-12;
  const auto inside = [&](double value) { return value >= low * (1 - kSlack) && value <= high * (1 + kSlack); };
  const int first = static_cast<int>(std::floor(std::log10(low)));
  const int last = static_cast<int>(std::ceil(std::log10(high)));
  Ticks powers;
  Ticks several;
  std::vector<int> exponents;
  const bool as_plain = first >= -3 && last <= 5;
  for (int exponent = first; exponent <= last; ++exponent) {
    for (std::int64_t mantissa = 1; mantissa < 10; ++mantissa) {
      const double value = Decimal{mantissa, exponent}.value();
      if (!inside(value)) continue;
      const double kept = std::clamp(value, low, high);
      const bool labelled = mantissa == 1 || mantissa == 2 || mantissa == 5;
      if (mantissa == 1) exponents.push_back(exponent);
      (mantissa == 1 ? powers.values : powers.minor).push_back(kept);
      (labelled ? several.values : several.minor).push_back(kept);
      if (labelled) several.labels.push_back(log_label(mantissa, exponent, as_plain));
    }
  }
  if (several.values.size() >= 2 && several.values.size() <= static_cast<std::size_t>(most)) return several;
  if (powers.values.size() < 2) return linear_ticks(low, high, most);
  const int stride = (static_cast<int>(exponents.size()) + most - 1) / most;
  Ticks ticks;
  if (stride == 1) ticks.minor = powers.minor;
  for (std::size_t i = 0; i < exponents.size(); ++i) {
    if (exponents[i] % stride != 0) {
      ticks.minor.push_back(powers.values[i]);
      continue;
    }
    ticks.values.push_back(powers.values[i]);
    ticks.labels.push_back(log_label(1, exponents[i], as_plain));
  }
  return ticks;
}

}  // namespace

Ticks make_ticks(double low, double high, AxisScale scale, int most) {
  const bool log = scale == AxisScale::Log;
  const double largest = std::max(std::abs(low), std::abs(high));
  if (!(low < high) || !std::isfinite(high - low) || !(high - low >= 1e-12 * largest) || (log && !(low > 0))) {
    throw Error(Error::Argument,
                fmt::format("ticks: the range is {} to {}, expected a rising one{}", low, high, log ? " above 0" : ""));
  }
  return log ? log_ticks(low, high, std::max(2, most)) : linear_ticks(low, high, std::max(2, most));
}

std::string power_of_ten(int exponent) {
  constexpr std::array<std::string_view, 10> kSuperscripts{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(exponent))) {
    text += kSuperscripts[static_cast<std::size_t>(digit - '0')];
  }
  return text;
}

}  // namespace azulejo
