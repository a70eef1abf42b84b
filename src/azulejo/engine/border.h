#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace azulejo {

/// What lies outside an image, for operations that look beyond a pixel.
enum class Border : std::uint8_t {
  Mirror,    ///< d c b | a b c d | c b a: reflected at the edge pixel, which is not repeated
  Reflect,   ///< c b a | a b c d | d c b
  Clamp,     ///< a a a | a b c d | d d d
  Wrap,      ///< b c d | a b c d | a b c
  Constant,  ///< one stated value
};

constexpr auto enum_names(Border) {
  return std::array<std::string_view, 5>{"mirror", "reflect", "clamp", "wrap", "constant"};
}

struct BorderRule {
  Border mode = Border::Mirror;
  float value = 0;  ///< of Border::Constant, intensity 0–1 of every channel
  friend bool operator==(const BorderRule&, const BorderRule&) = default;
};

/// The index in [0, size) that stands for any index; −1 for outside under Border::Constant.
constexpr int border_index(std::int64_t index, int size, Border mode) {
  if (index >= 0 && index < size) return static_cast<int>(index);
  const auto modulo = [](std::int64_t value, std::int64_t period) { return (value % period + period) % period; };
  switch (mode) {
    case Border::Mirror: {
      if (size == 1) return 0;
      const std::int64_t period = 2 * (std::int64_t{size} - 1);
      const std::int64_t folded = modulo(index, period);
      return static_cast<int>(folded < size ? folded : period - folded);
    }
    case Border::Reflect: {
      const std::int64_t folded = modulo(index, 2 * std::int64_t{size});
      return static_cast<int>(folded < size ? folded : 2 * std::int64_t{size} - 1 - folded);
    }
    case Border::Clamp: return index < 0 ? 0 : size - 1;
    case Border::Wrap: return static_cast<int>(modulo(index, size));
    case Border::Constant: return -1;
  }
  return -1;
}

}  // namespace azulejo
