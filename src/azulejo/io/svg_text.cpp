#include "azulejo/io/svg_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>
#include <utility>

#include "azulejo/io/text_numbers.h"
#include "azulejo/math/turns.h"

namespace azulejo {
namespace {

constexpr double kLargest = std::numeric_limits<float>::max();

/// What is left over by the short way: many digits, large exponents.
const char* parse_slowly(const char* first, const char* end, int exponent, double& value) {
  if (*first == '+') ++first;
  const auto [stop, failure] = std::from_chars(first, end, value);
  if (failure == std::errc::result_out_of_range && exponent < 0) value = 0;
  const bool read = failure == std::errc() || (failure == std::errc::result_out_of_range && exponent < 0);
  return read && std::abs(value) <= kLargest ? end : nullptr;
}

std::optional<glm::dmat3x2> function_matrix(std::string_view name, const std::vector<double>& v) {
  const std::size_t count = v.size();
  if (name == "matrix" && count == 6) return glm::dmat3x2(v[0], v[1], v[2], v[3], v[4], v[5]);
  if (name == "translate" && (count == 1 || count == 2)) {
    return glm::dmat3x2(1, 0, 0, 1, v[0], count == 2 ? v[1] : 0);
  }
  if (name == "scale" && (count == 1 || count == 2)) return glm::dmat3x2(v[0], 0, 0, v[count - 1], 0, 0);
  if (name == "rotate" && (count == 1 || count == 3)) {
    const auto [c, s] = turn_of_degrees(std::fmod(v[0], 360.0));
    const glm::dmat3x2 turn(c, s, -s, c, 0, 0);
    if (count == 1) return turn;
    return combined(glm::dmat3x2(1, 0, 0, 1, v[1], v[2]), combined(turn, glm::dmat3x2(1, 0, 0, 1, -v[1], -v[2])));
  }
  if ((name == "skewX" || name == "skewY") && count == 1) {
    const auto [c, s] = turn_of_degrees(std::fmod(v[0], 360.0));
    const double slope = s / c;
    return name == "skewX" ? glm::dmat3x2(1, 0, slope, 1, 0, 0) : glm::dmat3x2(1, slope, 0, 1, 0, 0);
  }
  return std::nullopt;
}

}  // namespace

const char* parse_svg_number(const char* next, const char* end, double& value) {
  using namespace text_numbers;
  const char* const first = next;
  if (next == end) return nullptr;
  const bool negative = *next == '-';
  if (negative || *next == '+') ++next;
  std::uint64_t mantissa = 0;
  const char* const whole = next;
  for (; next != end && digit(*next); ++next) mantissa = mantissa * 10 + digit_value(*next);
  std::ptrdiff_t digits = next - whole;
  std::ptrdiff_t decimals = 0;
  if (next != end && *next == '.') {
    const char* const fraction = ++next;
    for (; next != end && digit(*next); ++next) mantissa = mantissa * 10 + digit_value(*next);
    decimals = next - fraction;
    digits += decimals;
  }
  if (digits == 0) return nullptr;
  constexpr std::ptrdiff_t kMost = 100'000;
  int exponent = -static_cast<int>(std::min(decimals, kMost));
  // The e of "1em" is no exponent.
  if (next != end && (*next == 'e' || *next == 'E')) {
    const char* behind = next + 1;
    if (behind != end && (*behind == '-' || *behind == '+')) ++behind;
    if (behind != end && digit(*behind)) {
      const bool smaller = next[1] == '-';
      int read = 0;
      for (; behind != end && digit(*behind); ++behind) {
        read = read < kMost ? read * 10 + static_cast<int>(digit_value(*behind)) : read;
      }
      exponent += smaller ? -read : read;
      next = behind;
    }
  }
  constexpr std::uint64_t kExact = std::uint64_t{1} << 53;
  if (digits > 19 || mantissa >= kExact || exponent < -22 || exponent > 22) {
    return parse_slowly(first, next, exponent, value);
  }
  // Both are exact: rounded once.
  const double power = kPowersOfTen[static_cast<std::size_t>(std::abs(exponent))];
  const double result = exponent < 0 ? static_cast<double>(mantissa) / power : static_cast<double>(mantissa) * power;
  value = negative ? -result : result;
  return next;
}

void skip_blanks(std::string_view& text) {
  while (!text.empty() && is_svg_blank(text.front())) text.remove_prefix(1);
}

std::string_view without_blanks(std::string_view text) {
  skip_blanks(text);
  while (!text.empty() && is_svg_blank(text.back())) text.remove_suffix(1);
  return text;
}

bool skip_comma(std::string_view& text) {
  skip_blanks(text);
  if (text.empty() || text.front() != ',') return false;
  text.remove_prefix(1);
  skip_blanks(text);
  return true;
}

std::optional<double> take_number(std::string_view& text) {
  double value = 0;
  const char* const behind = parse_svg_number(text.data(), text.data() + text.size(), value);
  if (behind == nullptr) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(behind - text.data()));
  return value;
}

std::string_view take_word(std::string_view& text) {
  const auto ends = [](char c) {
    const char lower = static_cast<char>(c | 0x20);
    return !((lower >= 'a' && lower <= 'z') || (c >= '0' && c <= '9') || c == '-');
  };
  const auto length = static_cast<std::size_t>(std::find_if(text.begin(), text.end(), ends) - text.begin());
  const std::string_view word = text.substr(0, length);
  text.remove_prefix(length);
  return word;
}

std::vector<double> parse_numbers(std::string_view text) {
  std::vector<double> numbers;
  skip_blanks(text);
  while (const std::optional<double> number = take_number(text)) {
    numbers.push_back(*number);
    skip_comma(text);
  }
  return numbers;
}

bool same_word(std::string_view text, std::string_view lower_case) {
  const auto same = [](char a, char b) { return (a >= 'A' && a <= 'Z' ? static_cast<char>(a | 0x20) : a) == b; };
  return std::equal(text.begin(), text.end(), lower_case.begin(), lower_case.end(), same);
}

std::optional<SvgLength> parse_length(std::string_view text) {
  static constexpr std::pair<std::string_view, SvgUnit> kUnits[] = {
      {"", SvgUnit::Pixel},        {"px", SvgUnit::Pixel},      {"pt", SvgUnit::Point},  {"pc", SvgUnit::Pica},
      {"mm", SvgUnit::Millimetre}, {"cm", SvgUnit::Centimetre}, {"q", SvgUnit::Quarter}, {"in", SvgUnit::Inch},
      {"em", SvgUnit::Em},         {"ex", SvgUnit::Ex},         {"%", SvgUnit::Percent}};
  text = without_blanks(text);
  const std::optional<double> value = take_number(text);
  if (!value) return std::nullopt;
  for (const auto& [name, unit] : kUnits) {
    if (same_word(text, name)) return SvgLength{*value, unit};
  }
  return std::nullopt;
}

double pixels_of(const SvgLength& length, double hundred, double font_size) {
  switch (length.unit) {
    case SvgUnit::Pixel: return length.value;
    case SvgUnit::Point: return length.value * 4 / 3;
    case SvgUnit::Pica: return length.value * 16;
    case SvgUnit::Millimetre: return length.value * 96 / 25.4;
    case SvgUnit::Centimetre: return length.value * 96 / 2.54;
    case SvgUnit::Quarter: return length.value * 96 / 101.6;
    case SvgUnit::Inch: return length.value * 96;
    case SvgUnit::Em: return length.value * font_size;
    case SvgUnit::Ex: return length.value * font_size / 2;
    case SvgUnit::Percent: return length.value / 100 * hundred;
  }
  return length.value;
}

std::optional<glm::dmat3x2> parse_transform(std::string_view text) {
  glm::dmat3x2 result(1, 0, 0, 1, 0, 0);
  skip_blanks(text);
  if (same_word(without_blanks(text), "none")) return result;
  while (!text.empty()) {
    const std::string_view name = take_word(text);
    skip_blanks(text);
    const std::size_t close = text.find(')');
    if (text.empty() || text.front() != '(' || close == std::string_view::npos) return std::nullopt;
    std::string_view rest = text.substr(1, close - 1);
    std::vector<double> values;
    skip_blanks(rest);
    while (const std::optional<double> number = take_number(rest)) {
      values.push_back(*number);
      // In style sheets numbers have the units that are meant here anyway.
      if (rest.starts_with("px")) rest.remove_prefix(2);
      if (rest.starts_with("deg")) rest.remove_prefix(3);
      skip_comma(rest);
    }
    const auto matrix = rest.empty() ? function_matrix(name, values) : std::nullopt;
    if (!matrix) return std::nullopt;
    result = combined(result, *matrix);
    text.remove_prefix(close + 1);
    skip_comma(text);
  }
  return result;
}

glm::dmat3x2 combined(const glm::dmat3x2& outer, const glm::dmat3x2& inner) {
  const auto turned = [&](const glm::dvec2& v) { return outer[0] * v.x + outer[1] * v.y; };
  return {turned(inner[0]), turned(inner[1]), turned(inner[2]) + outer[2]};
}

float to_float(double value) {
  return std::isnan(value) ? 0.0F : static_cast<float>(std::clamp(value, -kLargest, kLargest));
}

glm::mat3x2 to_floats(const glm::dmat3x2& matrix) {
  glm::mat3x2 result;
  for (int column = 0; column < 3; ++column) {
    result[column] = {to_float(matrix[column].x), to_float(matrix[column].y)};
  }
  return result;
}

std::string_view fragment_of(std::string_view reference) {
  reference = without_blanks(reference);
  return reference.size() > 1 && reference.front() == '#' ? reference.substr(1) : std::string_view();
}

std::string_view take_url(std::string_view& text) {
  constexpr std::string_view kUrl = "url(";
  if (text.size() < kUrl.size() || !same_word(text.substr(0, kUrl.size()), kUrl)) return {};
  const std::size_t close = text.find(')');
  if (close == std::string_view::npos) return {};
  std::string_view inside = without_blanks(text.substr(kUrl.size(), close - kUrl.size()));
  if (inside.size() >= 2 && (inside.front() == '"' || inside.front() == '\'') && inside.back() == inside.front()) {
    inside = inside.substr(1, inside.size() - 2);
  }
  text.remove_prefix(close + 1);
  // Something that names nothing here is still a reference.
  const std::string_view id = fragment_of(inside);
  return id.empty() ? (inside.empty() ? std::string_view("#") : inside) : id;
}

}  // namespace azulejo
