#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace azulejo {

// Numbers in text, as any program writes them, several times as fast as std::from_chars and with the same rounding.
//
// text     where the number begins: no blanks are skipped. The text must be followed by a byte that belongs to no
//          number (0, a line end): nothing else tells where it ends.
// Result   behind the number, or null where there is none; what follows it is the caller's to judge.

/// Correctly rounded to the nearest float: "1", "-.5", "+1.", "1e-5", "1.5D+03", "inf", "-Infinity", "nan", "NAN(ind)",
/// "1.#QNAN", "-1.#IND", "1.#INF". Too large is infinite, too small is 0. Not: "0x10", "0,5" (that is 0).
inline const char* parse_float(const char* text, float& value);

/// "12", "-3", "+7". Beyond 64 bits it is the largest or smallest value.
inline const char* parse_integer(const char* text, std::int64_t& value);

/// A word of a file as messages quote it: cut short, without control characters.
std::string quoted_word(std::string_view word);

// ---------------------------------------------------------------------------------------------------------------------

/// The same as parse_float for every number: what the short way below leaves over.
const char* parse_float_slowly(const char* text, float& value);

namespace text_numbers {

inline bool digit(char c) { return static_cast<unsigned char>(c - '0') < 10; }
inline unsigned digit_value(char c) { return static_cast<unsigned char>(c - '0'); }
inline bool exponent_letter(char c) { return (c | 0x21) == 'e'; }  // e E d D

inline constexpr std::array<double, 23> kPowersOfTen = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                        1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                        1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// Behind "e-05" and added to `exponent`; `text` itself where no exponent stands there.
inline const char* parse_exponent(const char* text, int& exponent) {
  if (!exponent_letter(*text)) return text;
  const char* next = text + 1;
  const bool negative = *next == '-';
  if (negative || *next == '+') ++next;
  if (!digit(*next)) return text;
  int value = 0;
  for (; digit(*next); ++next) value = value < 100'000 ? value * 10 + static_cast<int>(digit_value(*next)) : value;
  exponent += negative ? -value : value;
  return next;
}

}  // namespace text_numbers

inline const char* parse_float(const char* text, float& value) {
  using namespace text_numbers;
  const char* next = text;
  const bool negative = *next == '-';
  if (negative || *next == '+') ++next;
  const char* const whole = next;
  std::uint64_t mantissa = 0;
  for (; digit(*next); ++next) mantissa = mantissa * 10 + digit_value(*next);
  std::ptrdiff_t digits = next - whole;
  std::ptrdiff_t decimals = 0;
  if (*next == '.') {
    const char* const fraction = ++next;
    for (; digit(*next); ++next) mantissa = mantissa * 10 + digit_value(*next);
    decimals = next - fraction;
    digits += decimals;
  }
  if (digits == 0 || digits > 19 || *next == '#') return parse_float_slowly(text, value);
  int exponent = -static_cast<int>(decimals);
  next = parse_exponent(next, exponent);
  constexpr std::uint64_t kExact = std::uint64_t{1} << 53;
  if (mantissa >= kExact || exponent < -22 || exponent > 22) return parse_float_slowly(text, value);
  // Both are exact, so the double is rounded once. Rounding it again, to float, goes wrong only where it stands on
  // the middle between two floats without being it, or among the floats that have fewer bits.
  const double power = kPowersOfTen[static_cast<std::size_t>(exponent < 0 ? -exponent : exponent)];
  const double result = exponent < 0 ? static_cast<double>(mantissa) / power : static_cast<double>(mantissa) * power;
  constexpr std::uint64_t kBelowFloat = (std::uint64_t{1} << 29) - 1;
  constexpr std::uint64_t kMiddle = std::uint64_t{1} << 28;
  constexpr double kSmallestNormal = 1.17549435e-38;
  if ((std::bit_cast<std::uint64_t>(result) & kBelowFloat) == kMiddle || (result < kSmallestNormal && mantissa != 0)) {
    return parse_float_slowly(text, value);
  }
  value = static_cast<float>(negative ? -result : result);
  return next;
}

inline const char* parse_integer(const char* text, std::int64_t& value) {
  using namespace text_numbers;
  const char* next = text;
  const bool negative = *next == '-';
  if (negative || *next == '+') ++next;
  if (!digit(*next)) return nullptr;
  constexpr std::uint64_t kMost = INT64_MAX;
  std::uint64_t magnitude = 0;
  for (; digit(*next); ++next) {
    magnitude = magnitude <= kMost / 10 - 1 ? magnitude * 10 + digit_value(*next) : kMost;
  }
  value = negative ? -static_cast<std::int64_t>(magnitude) : static_cast<std::int64_t>(magnitude);
  return next;
}

}  // namespace azulejo
