#include "azulejo/io/svg_output.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace azulejo {
namespace {

/// How many bytes the letter at the front takes; 0: it is no UTF-8.
/// Source: The Unicode Standard, 3.9, table 3-7.
std::size_t letter_bytes(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t count = first < 0xC2 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : first < 0xF5 ? 4 : 0;
  const unsigned lower = first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
  const unsigned upper = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
  for (std::size_t i = 1; i < count; ++i) {
    if (byte(i) < (i == 1 ? lower : 0x80) || byte(i) > (i == 1 ? upper : 0xBF)) return 0;
  }
  return count;
}

bool is_letter(char c) {
  const char lower = static_cast<char>(c | 0x20);
  return (lower >= 'a' && lower <= 'z') || c == '_';
}

/// A valid id that is like it.
std::string id_like(std::string_view wanted) {
  std::string id;
  while (!wanted.empty()) {
    const std::size_t bytes = letter_bytes(wanted);
    const char c = wanted.front();
    const bool allowed = bytes > 1 || is_letter(c) || (c >= '0' && c <= '9') || c == '-' || c == '.';
    if (id.empty() && (!allowed || (bytes == 1 && !is_letter(c)))) id += '_';
    if (allowed) {
      id.append(wanted.substr(0, bytes));
    } else if (id != "_") {
      id += '_';
    }
    wanted.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return id;
}

}  // namespace

void put_number(std::string& text, float value) {
  if (!(std::abs(value) > 0) || !std::isfinite(value)) {
    text += '0';
    return;
  }
  std::array<char, 32> digits;
  char* first = digits.data() + 1;
  const char* const end = std::to_chars(first, digits.data() + digits.size(), value).ptr;
  // "0.5" is ".5".
  const bool negative = *first == '-';
  if (first[negative ? 1 : 0] == '0' && first + (negative ? 2 : 1) < end) {
    ++first;
    if (negative) *first = '-';
  }
  text.append(static_cast<const char*>(first), end);
}

void put_escaped(std::string& text, std::string_view value) {
  while (!value.empty()) {
    const std::size_t bytes = letter_bytes(value);
    const char c = value.front();
    if (bytes == 0) {
      text += "\xEF\xBF\xBD";
    } else if (c == '&') {
      text += "&amp;";
    } else if (c == '<') {
      text += "&lt;";
    } else if (c == '>') {
      text += "&gt;";
    } else if (c == '"') {
      text += "&quot;";
    } else if (static_cast<unsigned char>(c) < 0x20) {
      text += ' ';  // XML has no other control characters than line ends and tabs
    } else {
      text.append(value.substr(0, bytes));
    }
    value.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
}

void put_attribute(std::string& text, std::string_view name, std::string_view value) {
  ((text += ' ') += name) += "=\"";
  (text += value) += '"';
}

void put_attribute(std::string& text, std::string_view name, float value) {
  ((text += ' ') += name) += "=\"";
  put_number(text, value);
  text += '"';
}

std::uint32_t svg_color_bits(const glm::vec4& color) {
  std::uint32_t bits = 0;
  for (int c = 0; c < 3; ++c) {
    bits = bits << 8 | static_cast<std::uint32_t>(std::clamp(color[c], 0.0F, 1.0F) * 255 + 0.5F);
  }
  return bits;
}

void put_color(std::string& text, const glm::vec4& color) {
  constexpr const char* kDigits = "0123456789abcdef";
  const std::uint32_t bits = svg_color_bits(color);
  const bool is_short = (bits >> 4 & 0x0F0F0F) == (bits & 0x0F0F0F);
  text += '#';
  for (int shift = 20; shift >= 0; shift -= is_short ? 8 : 4) text += kDigits[bits >> shift & 15];
}

void put_transform(std::string& text, std::string_view name, const glm::mat3x2& matrix) {
  if (matrix == glm::mat3x2(1, 0, 0, 1, 0, 0)) return;
  ((text += ' ') += name) += "=\"";
  const auto put = [&](const char* function, std::initializer_list<float> values) {
    (text += function) += '(';
    for (const float& value : values) {
      if (&value != values.begin()) text += ' ';
      put_number(text, value);
    }
    text += ")\"";
  };
  const bool straight = matrix[0].y == 0 && matrix[1].x == 0;
  const bool stays = matrix[2] == glm::vec2(0, 0);
  if (straight && matrix[0].x == 1 && matrix[1].y == 1) {
    put("translate", {matrix[2].x, matrix[2].y});
  } else if (straight && stays && matrix[0].x == matrix[1].y) {
    put("scale", {matrix[0].x});
  } else if (straight && stays) {
    put("scale", {matrix[0].x, matrix[1].y});
  } else {
    put("matrix", {matrix[0].x, matrix[0].y, matrix[1].x, matrix[1].y, matrix[2].x, matrix[2].y});
  }
}

std::string SvgIds::unique(std::string_view wanted) {
  std::string id = id_like(wanted);
  std::uint32_t& count = taken_[id];
  if (count++ == 0) return id;
  while (true) {
    // Another may have been called like this from the start.
    std::string numbered = id + '-' + std::to_string(taken_[id]++);
    if (taken_.try_emplace(numbered, 1).second) return numbered;
  }
}

}  // namespace azulejo
