#include "azulejo/io/text_numbers.h"

#include <charconv>
#include <cstddef>
#include <limits>
#include <string>
#include <system_error>

namespace azulejo {
namespace {

using namespace text_numbers;

/// Behind `word` (in lower case) if it stands at `text` in any case, else null.
const char* behind_word(const char* text, const char* word) {
  for (; *word != '\0'; ++word, ++text) {
    if ((*text | 0x20) != *word) return nullptr;
  }
  return text;
}

/// Behind letters, digits and what stands in brackets: "nan(ind)", "#QNAN0".
const char* behind_tail(const char* text) {
  const auto tail = [](char c) {
    return digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '(' || c == ')';
  };
  while (tail(*text)) ++text;
  return text;
}

/// "nan", "inf" and their like, behind the sign.
const char* parse_word(const char* text, float& value) {
  if (const char* const next = behind_word(text, "nan")) {
    value = std::numeric_limits<float>::quiet_NaN();
    return *next == '(' ? behind_tail(next) : next;
  }
  if (const char* const next = behind_word(text, "inf")) {
    value = std::numeric_limits<float>::infinity();
    const char* const longer = behind_word(next, "inity");
    return longer != nullptr ? longer : next;
  }
  return nullptr;
}

/// "1.#INF", "1.#QNAN", "1.#IND00": what stands behind the #.
const char* parse_microsoft_word(const char* text, float& value) {
  const bool infinite = behind_word(text, "inf") != nullptr;
  if (!infinite && behind_word(text, "qnan") == nullptr && behind_word(text, "snan") == nullptr &&
      behind_word(text, "ind") == nullptr) {
    return nullptr;
  }
  value = infinite ? std::numeric_limits<float>::infinity() : std::numeric_limits<float>::quiet_NaN();
  return behind_tail(text);
}

/// Of digits, a point and an exponent with e. `exponent`: about that of the value, to tell too large from too small.
float rounded(const std::string& number, std::ptrdiff_t exponent) {
  float value = 0;
  const auto [end, status] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (status == std::errc::result_out_of_range) return exponent > 0 ? std::numeric_limits<float>::infinity() : 0.0F;
  return value;
}

}  // namespace

const char* parse_float_slowly(const char* text, float& value) {
  const char* next = text;
  const bool negative = *next == '-';
  if (negative || *next == '+') ++next;
  const char* const whole = next;
  while (digit(*next)) ++next;
  const char* const point = next;
  if (*next == '.') ++next;
  const char* const fraction = next;
  while (digit(*next)) ++next;
  float magnitude = 0;
  const char* end = nullptr;
  if (*next == '#' && next == fraction && point != whole && fraction != point) {
    end = parse_microsoft_word(next + 1, magnitude);
  } else if (point == whole && next == fraction) {
    end = parse_word(whole, magnitude);
  } else {
    int exponent = 0;
    end = parse_exponent(next, exponent);
    // from_chars knows no D, and no bare point in front of nothing.
    const std::string digits = std::string(whole, next) + "e" + std::to_string(exponent);
    const char* first = whole;
    while (*first == '0') ++first;
    const char* first_of_fraction = fraction;
    while (*first_of_fraction == '0') ++first_of_fraction;
    const std::ptrdiff_t shift = first < point ? point - first : fraction - first_of_fraction;
    magnitude = rounded(digits, shift + exponent);
  }
  if (end != nullptr) value = negative ? -magnitude : magnitude;
  return end;
}

std::string quoted_word(std::string_view word) {
  constexpr std::size_t kLongest = 24;
  std::string result(word.substr(0, kLongest));
  for (char& c : result) {
    if (static_cast<unsigned char>(c) < ' ' || c == 0x7F) c = '?';
  }
  return word.size() > kLongest ? result + "…" : result;
}

}  // namespace azulejo
