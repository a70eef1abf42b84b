#include <algorithm>
#include <cmath>
#include <optional>

#include "azulejo/io/svg_output.h"

namespace azulejo {
namespace {

/// Properties, as attributes or for a style sheet.
class Properties {
 public:
  Properties(std::string& text, bool css) : text_(text), css_(css) {}

  void put(std::string_view name, std::string_view value) {
    begin(name);
    text_ += value;
    end();
  }
  void put(std::string_view name, float value) {
    begin(name);
    put_number(text_, value);
    end();
  }
  void put(std::string_view name, const std::vector<float>& values) {
    begin(name);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (i > 0) text_ += ' ';
      put_number(text_, values[i]);
    }
    end();
  }

 private:
  void begin(std::string_view name) {
    if (!css_) text_ += ' ';
    text_ += name;
    text_ += css_ ? ":" : "=\"";
  }
  void end() { text_ += css_ ? ';' : '"'; }

  std::string& text_;
  bool css_;
};

void put_stroke(Properties& properties, const DrawingStyle& style) {
  const DrawingStyle plain;
  if (style.stroke_width != plain.stroke_width) properties.put("stroke-width", style.stroke_width);
  if (style.cap != plain.cap)
    properties.put("stroke-linecap", enum_names(LineCap())[static_cast<std::size_t>(style.cap)]);
  if (style.join != plain.join) {
    properties.put("stroke-linejoin", enum_names(LineJoin())[static_cast<std::size_t>(style.join)]);
  }
  if (style.miter_limit != plain.miter_limit) properties.put("stroke-miterlimit", std::max(1.0F, style.miter_limit));
  if (!style.dash.empty()) {
    properties.put("stroke-dasharray", style.dash);
    if (style.dash_offset != 0) properties.put("stroke-dashoffset", style.dash_offset);
  }
  if (style.fixed_stroke) properties.put("vector-effect", "non-scaling-stroke");
}

using Server = std::optional<std::string>;  ///< url(#…) of a paint

void put_paint(Properties& properties, const std::string& name, const Paint& paint, const Server& server,
               float opacity) {
  std::string value;
  if (server) {
    value = *server;
  } else {
    put_color(value, paint.color);
  }
  if (name != "fill" || value != "#000") properties.put(name, value);
  const float alpha = paint.color.w * opacity;
  if (alpha != 1) properties.put(name + "-opacity", alpha);
}

/// The properties of a style; of its points only if `marks`.
template <class F>
void put_style_properties(Properties properties, const DrawingStyle& style, bool marks, const F& server) {
  if (marks) return put_paint(properties, "fill", *style.points, server(*style.points), style.opacity);
  // Each of two paints has the opacity for itself; that of an element is of both together.
  const bool both = style.fill && style.stroke;
  const float share = both ? style.opacity : 1;
  if (style.fill) {
    put_paint(properties, "fill", *style.fill, server(*style.fill), share);
    if (style.fill_rule == FillRule::EvenOdd) properties.put("fill-rule", "evenodd");
  } else {
    properties.put("fill", "none");
  }
  if (style.stroke) {
    put_paint(properties, "stroke", *style.stroke, server(*style.stroke), share);
    put_stroke(properties, style);
  }
  if (!both && style.opacity != 1) properties.put("opacity", style.opacity);
}

/// "a", "b", …, "z", "aa": as short as can be.
std::string class_name(std::size_t index) {
  std::string name;
  for (++index; index > 0; index = (index - 1) / 26) {
    name.insert(name.begin(), static_cast<char>('a' + (index - 1) % 26));
  }
  return name;
}

}  // namespace

SvgDefinitions::SvgDefinitions(const Drawing& drawing, SvgIds& ids) : drawing_(drawing) {
  name_patterns(drawing, ids);
  std::vector<std::uint32_t> uses(drawing.styles.size());
  for (const DrawingPath& path : drawing.paths) ++uses[path.style];
  choose_classes(uses);
}

/// A gradient is one for all; hatches and stipples contain their color.
void SvgDefinitions::name_patterns(const Drawing& drawing, SvgIds& ids) {
  for (const DrawingStyle& style : drawing.styles) {
    for (const std::optional<Paint>* paint : {&style.fill, &style.stroke, &style.points}) {
      if (!*paint || !(*paint)->pattern) continue;
      const std::uint32_t pattern = *(*paint)->pattern;
      const bool gradient = std::holds_alternative<Gradient>(drawing.patterns[pattern]);
      const bool hatch = std::holds_alternative<Hatch>(drawing.patterns[pattern]);
      std::string& id = patterns_[{pattern, gradient ? 0 : svg_color_bits((*paint)->color)}];
      if (id.empty()) id = ids.unique(gradient ? "gradient" : hatch ? "hatch" : "stipple");
    }
  }
}

void SvgDefinitions::choose_classes(const std::vector<std::uint32_t>& uses) {
  constexpr std::uint32_t kFew = 4;
  constexpr std::size_t kClassBytes = 11;  // ` class="a"`
  classes_.resize(uses.size());
  std::size_t named = 0;
  for (std::uint32_t style = 0; style < uses.size(); ++style) {
    if (uses[style] < kFew) continue;
    std::string attributes;
    put_style(attributes, style, false);
    // Once in the sheet, and then its name each time.
    if (uses[style] * attributes.size() > attributes.size() + uses[style] * kClassBytes + kClassBytes) {
      classes_[style] = class_name(named++);
    }
  }
}

void SvgDefinitions::put_properties(std::string& text, std::uint32_t style, bool css, bool marks) const {
  const auto server = [&](const Paint& paint) -> Server {
    if (!paint.pattern) return std::nullopt;
    const bool gradient = std::holds_alternative<Gradient>(drawing_.patterns[*paint.pattern]);
    return "url(#" + patterns_.at({*paint.pattern, gradient ? 0 : svg_color_bits(paint.color)}) + ")";
  };
  put_style_properties(Properties(text, css), drawing_.styles[style], marks, server);
}

void SvgDefinitions::put_style(std::string& text, std::uint32_t style, bool marks) const {
  if (!marks && !classes_[style].empty()) return put_attribute(text, "class", classes_[style]);
  put_properties(text, style, false, marks);
}

void SvgDefinitions::put(std::string& text) const {
  std::string sheet;
  for (std::uint32_t style = 0; style < classes_.size(); ++style) {
    if (classes_[style].empty()) continue;
    (sheet += '.') += classes_[style];
    sheet += '{';
    put_properties(sheet, style, true, false);
    sheet.back() = '}';
    sheet += '\n';
  }
  if (!sheet.empty()) ((text += "<style>\n") += sheet) += "</style>\n";
  if (patterns_.empty()) return;
  text += "<defs>\n";
  for (const auto& [key, id] : patterns_) put_pattern(text, drawing_.patterns[key.first], id, key.second);
  text += "</defs>\n";
}

}  // namespace azulejo
