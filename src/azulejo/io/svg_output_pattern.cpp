#include <string>

#include <fmt/format.h>

#include "azulejo/io/svg_output.h"

namespace azulejo {
namespace {

glm::vec4 color_of(std::uint32_t bits) {
  const auto channel = [&](int shift) { return static_cast<float>(bits >> shift & 255) / 255; };
  return {channel(16), channel(8), channel(0), 1};
}

std::string in_color(std::uint32_t bits) {
  std::string text;
  put_color(text, color_of(bits));
  return text;
}

void put_one(std::string& text, const Gradient& gradient, std::string_view id, std::uint32_t) {
  const char* const name = gradient.radial ? "radialGradient" : "linearGradient";
  (text += '<') += name;
  put_attribute(text, "id", id);
  put_attribute(text, "gradientUnits", "userSpaceOnUse");
  if (gradient.radial) {
    put_attribute(text, "cx", gradient.to.x);
    put_attribute(text, "cy", gradient.to.y);
    put_attribute(text, "r", gradient.to_radius);
    if (gradient.from.x != gradient.to.x) put_attribute(text, "fx", gradient.from.x);
    if (gradient.from.y != gradient.to.y) put_attribute(text, "fy", gradient.from.y);
    if (gradient.from_radius != 0) put_attribute(text, "fr", gradient.from_radius);
  } else {
    put_attribute(text, "x1", gradient.from.x);
    put_attribute(text, "y1", gradient.from.y);
    put_attribute(text, "x2", gradient.to.x);
    put_attribute(text, "y2", gradient.to.y);
  }
  if (gradient.spread != GradientSpread::Pad) {
    put_attribute(text, "spreadMethod", gradient.spread == GradientSpread::Reflect ? "reflect" : "repeat");
  }
  put_transform(text, "gradientTransform", gradient.path_from_gradient);
  text += ">\n";
  for (const GradientStop& stop : gradient.stops) {
    text += "<stop";
    put_attribute(text, "offset", stop.offset);
    std::string color;
    put_color(color, stop.color);
    put_attribute(text, "stop-color", color);
    if (stop.color.w != 1) put_attribute(text, "stop-opacity", stop.color.w);
    text += "/>\n";
  }
  ((text += "</") += name) += ">\n";
}

void begin_pattern(std::string& text, std::string_view id, float size) {
  text += "<pattern";
  put_attribute(text, "id", id);
  put_attribute(text, "width", size);
  put_attribute(text, "height", size);
  put_attribute(text, "patternUnits", "userSpaceOnUse");
}

void put_one(std::string& text, const Hatch& hatch, std::string_view id, std::uint32_t color) {
  begin_pattern(text, id, hatch.spacing);
  if (hatch.angle != 0) {
    text += " patternTransform=\"rotate(";
    put_number(text, hatch.angle * -57.29577951F);
    text += ")\"";
  }
  // A tile shows half of the lines along its edges.
  const auto line = [&](char along, const char* from) {
    (text += from) += along;
    put_number(text, hatch.spacing);
  };
  text += "><path d=\"";
  std::string far;
  put_number(far, hatch.spacing);
  line('H', "M0 0");
  line('H', ("M0 " + far).c_str());
  if (hatch.crossed) {
    line('V', "M0 0");
    line('V', ("M" + far + " 0").c_str());
  }
  text += '"';
  put_attribute(text, "stroke", in_color(color));
  put_attribute(text, "stroke-width", hatch.width);
  text += "/></pattern>\n";
}

void put_one(std::string& text, const Stipple& stipple, std::string_view id, std::uint32_t color) {
  constexpr int kSize = 32;
  begin_pattern(text, id, static_cast<float>(kSize));
  text += "><path d=\"";
  for (int y = 0; y < kSize; ++y) {
    const auto is_set = [&](int x) { return (stipple.rows[static_cast<std::size_t>(y)] >> (31 - x) & 1) != 0; };
    for (int x = 0; x < kSize; ++x) {
      if (!is_set(x)) continue;
      const int begin = x;
      while (x + 1 < kSize && is_set(x + 1)) ++x;
      text += fmt::format("M{0} {1}H{2}v1H{0}z", begin, y, x + 1);
    }
  }
  text += '"';
  put_attribute(text, "fill", in_color(color));
  text += "/></pattern>\n";
}

}  // namespace

void put_pattern(std::string& text, const PaintPattern& pattern, std::string_view id, std::uint32_t color) {
  std::visit([&](const auto& one) { put_one(text, one, id, color); }, pattern);
}

}  // namespace azulejo
