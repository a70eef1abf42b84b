#include "azulejo/io/svg_color.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "azulejo/io/svg_text.h"

namespace azulejo {
namespace {

struct Part {
  double value = 0;
  bool percent = false;
};

float share(double value) { return static_cast<float>(std::clamp(value, 0.0, 1.0)); }

std::optional<Part> take_part(std::string_view& text) {
  const std::optional<double> value = take_number(text);
  if (!value) return std::nullopt;
  Part part{*value, !text.empty() && text.front() == '%'};
  if (part.percent) text.remove_prefix(1);
  return part;
}

/// An angle in turns.
std::optional<double> take_hue(std::string_view& text) {
  const std::optional<double> value = take_number(text);
  if (!value) return std::nullopt;
  const std::string_view unit = take_word(text);
  if (unit.empty() || same_word(unit, "deg")) return *value / 360;
  if (same_word(unit, "turn")) return *value;
  if (same_word(unit, "rad")) return *value / 6.283185307179586;
  if (same_word(unit, "grad")) return *value / 400;
  return std::nullopt;
}

/// What stands between two values.
void skip_between(std::string_view& text) {
  if (!skip_comma(text) && !text.empty() && text.front() == '/') {
    text.remove_prefix(1);
    skip_blanks(text);
  }
}

/// Source: CSS Color Module Level 4, 7.1.
Color from_hsl(double turns, double saturation, double lightness) {
  const double hue = turns - std::floor(turns);
  const double reach = saturation * std::min(lightness, 1 - lightness);
  const auto channel = [&](double n) {
    const double k = std::fmod(n + hue * 12, 12.0);
    return share(lightness - reach * std::max(-1.0, std::min({k - 3, 9 - k, 1.0})));
  };
  return {channel(0), channel(8), channel(4), 1};
}

std::optional<Color> function_color(bool hsl, std::string_view inside) {
  std::array<double, 3> values{};
  skip_blanks(inside);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (hsl && i == 0) {
      const std::optional<double> hue = take_hue(inside);
      if (!hue) return std::nullopt;
      values[0] = *hue;
    } else {
      const std::optional<Part> part = take_part(inside);
      if (!part) return std::nullopt;
      values[i] = part->value / (part->percent || hsl ? 100 : 255);
    }
    skip_between(inside);
  }
  Color color = hsl ? from_hsl(values[0], share(values[1]), share(values[2]))
                    : Color{share(values[0]), share(values[1]), share(values[2]), 1};
  if (!inside.empty()) {
    const std::optional<Part> alpha = take_part(inside);
    skip_blanks(inside);
    if (!alpha || !inside.empty()) return std::nullopt;
    color.a = share(alpha->percent ? alpha->value / 100 : alpha->value);
  }
  return color;
}

}  // namespace

std::optional<Color> parse_css_color(std::string_view text) {
  text = without_blanks(text);
  std::string_view rest = text;
  const std::string_view word = take_word(rest);
  if (!rest.empty() && rest.front() == '(') {
    const bool rgb = same_word(word, "rgb") || same_word(word, "rgba");
    const bool hsl = same_word(word, "hsl") || same_word(word, "hsla");
    const std::size_t close = rest.find(')');
    if ((!rgb && !hsl) || close == std::string_view::npos) return std::nullopt;
    return function_color(hsl, rest.substr(1, close - 1));
  }
  // A number is a gray elsewhere, not here.
  const bool begins = !text.empty() && (text.front() == '#' || static_cast<unsigned>((text.front() | 0x20) - 'a') < 26);
  if (!begins) return std::nullopt;
  const auto blank = static_cast<std::size_t>(std::find_if(text.begin(), text.end(), is_svg_blank) - text.begin());
  return parse_color(text.substr(0, blank));
}

}  // namespace azulejo
