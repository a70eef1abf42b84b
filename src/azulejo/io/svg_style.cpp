#include "azulejo/io/svg_style.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "azulejo/io/svg_color.h"

namespace azulejo {
namespace {

std::optional<SvgPaint> paint_value(std::string_view text) {
  SvgPaint paint;
  paint.server = take_url(text);
  text = without_blanks(text);
  if (text.empty() && !paint.server.empty()) return paint;
  if (same_word(text, "none")) return paint;
  if (same_word(text, "currentcolor")) {
    paint.kind = SvgPaint::Current;
    return paint;
  }
  const std::optional<Color> color = parse_css_color(text);
  if (!color) return paint.server.empty() ? std::nullopt : std::optional(paint);
  paint.kind = SvgPaint::Plain;
  paint.color = *color;
  return paint;
}

template <class T, std::size_t N>
void set_word(T& value, std::string_view text, const std::array<std::pair<std::string_view, T>, N>& words) {
  for (const auto& [name, meaning] : words) {
    if (same_word(text, name)) value = meaning;
  }
}

constexpr std::array<std::pair<std::string_view, FillRule>, 2> kRules = {
    {{"nonzero", FillRule::NonZero}, {"evenodd", FillRule::EvenOdd}}};
constexpr std::array<std::pair<std::string_view, LineCap>, 3> kCaps = {
    {{"butt", LineCap::Butt}, {"round", LineCap::Round}, {"square", LineCap::Square}}};
constexpr std::array<std::pair<std::string_view, LineJoin>, 5> kJoins = {{{"miter", LineJoin::Miter},
                                                                          {"miter-clip", LineJoin::Miter},
                                                                          {"arcs", LineJoin::Miter},
                                                                          {"round", LineJoin::Round},
                                                                          {"bevel", LineJoin::Bevel}}};

/// Sets the properties of one style from what is declared.
class StyleReader {
 public:
  StyleReader(SvgStyle& style, const SvgStyle& parent, const SvgViewport& viewport, SvgNotes& notes)
      : style_(style), parent_(parent), viewport_(viewport), notes_(notes) {}

  void set(SvgProperty property, std::string_view value) {
    if (same_word(value, "inherit")) return inherit(property);
    switch (property) {
      case SvgProperty::Fill: return set_paint(style_.fill, value);
      case SvgProperty::Stroke: return set_paint(style_.stroke, value);
      case SvgProperty::Color: style_.color = color_value(value, parent_.color).value_or(style_.color); return;
      case SvgProperty::FillOpacity: return set_share(style_.fill_opacity, value);
      case SvgProperty::StrokeOpacity: return set_share(style_.stroke_opacity, value);
      case SvgProperty::Opacity: return set_share(style_.opacity, value);
      case SvgProperty::FillRule: return set_word(style_.fill_rule, value, kRules);
      case SvgProperty::ClipRule: return set_word(style_.clip_rule, value, kRules);
      case SvgProperty::StrokeLinecap: return set_word(style_.cap, value, kCaps);
      case SvgProperty::StrokeLinejoin: return set_word(style_.join, value, kJoins);
      case SvgProperty::StrokeMiterlimit: return set_miter_limit(value);
      case SvgProperty::StrokeWidth: return set_length(style_.stroke_width, value, 0);
      case SvgProperty::StrokeDasharray: return set_dash(value);
      case SvgProperty::StrokeDashoffset: return set_length(style_.dash_offset, value, -3e38);
      case SvgProperty::FontSize: return set_font_size(value);
      default: return set_presence(property, value);
    }
  }

 private:
  void inherit(SvgProperty property) {
    if (property == SvgProperty::Opacity) style_.opacity = parent_.opacity;
    if (property == SvgProperty::ClipPath) style_.clip_path = parent_.clip_path;
    if (property == SvgProperty::VectorEffect) style_.fixed_stroke = parent_.fixed_stroke;
  }

  /// What an element shows at all.
  void set_presence(SvgProperty property, std::string_view value) {
    switch (property) {
      case SvgProperty::Display: style_.displayed = !same_word(value, "none"); return;
      case SvgProperty::Visibility: style_.visible = same_word(value, "visible"); return;
      case SvgProperty::Overflow: style_.overflow = same_word(value, "visible") || same_word(value, "auto"); return;
      case SvgProperty::VectorEffect: style_.fixed_stroke = same_word(value, "non-scaling-stroke"); return;
      case SvgProperty::ClipPath: style_.clip_path = take_url(value); return;
      case SvgProperty::Filter: return note(value, "filter");
      case SvgProperty::Mask: return note(value, "mask");
      case SvgProperty::Marker:
      case SvgProperty::MarkerStart:
      case SvgProperty::MarkerMid:
      case SvgProperty::MarkerEnd: return note(value, "marker");
      default: return;
    }
  }

  void note(std::string_view value, std::string_view kind) {
    if (!same_word(value, "none")) notes_.left_out(kind);
  }

  void set_paint(SvgPaint& paint, std::string_view value) { paint = paint_value(value).value_or(paint); }
  static void set_share(float& share, std::string_view value) { share = share_value(value).value_or(share); }

  std::optional<float> length(std::string_view text) const {
    const std::optional<SvgLength> length = parse_length(text);
    if (!length) return std::nullopt;
    return to_float(pixels_of(*length, viewport_.diagonal(), static_cast<double>(style_.font_size)));
  }

  void set_length(float& value, std::string_view text, double least) {
    const std::optional<float> read = length(text);
    if (read && static_cast<double>(*read) >= least) value = *read;
  }

  void set_miter_limit(std::string_view value) {
    const std::optional<double> limit = take_number(value);
    if (limit && value.empty() && *limit >= 1) style_.miter_limit = to_float(*limit);
  }

  void set_font_size(std::string_view value) {
    const std::optional<SvgLength> length = parse_length(value);
    if (!length || length->value < 0) return;
    const auto inherited = static_cast<double>(parent_.font_size);
    style_.font_size = to_float(pixels_of(*length, inherited, inherited));
  }

  void set_dash(std::string_view value) {
    if (same_word(value, "none")) {
      style_.dash = nullptr;
      return;
    }
    std::vector<float> dash;
    bool any = false;
    while (!value.empty()) {
      const auto stop = std::min(value.find_first_of(" ,\t\r\n"), value.size());
      const std::optional<float> each = length(value.substr(0, stop));
      if (!each || *each < 0) return;
      any = any || *each > 0;
      dash.push_back(*each);
      value.remove_prefix(stop);
      skip_comma(value);
    }
    if (dash.size() % 2 == 1) dash.insert(dash.end(), dash.begin(), dash.end());
    style_.dash = any ? std::make_shared<const std::vector<float>>(std::move(dash)) : nullptr;
  }

  SvgStyle& style_;
  const SvgStyle& parent_;
  const SvgViewport& viewport_;
  SvgNotes& notes_;
};

}  // namespace

double SvgViewport::diagonal() const { return std::sqrt((width * width + height * height) / 2); }

SvgStyle computed_style(const SvgStyle& parent, const SvgDeclarations& declared, const SvgViewport& viewport,
                        SvgNotes& notes) {
  SvgStyle style = parent;
  style.opacity = 1;
  style.displayed = true;
  style.overflow = false;
  style.fixed_stroke = false;
  style.clip_path = {};
  StyleReader reader(style, parent, viewport, notes);
  // Others are measured by it.
  if (declared.has(SvgProperty::FontSize)) reader.set(SvgProperty::FontSize, declared[SvgProperty::FontSize]);
  for (std::size_t i = 0; i < kSvgProperties; ++i) {
    const auto property = static_cast<SvgProperty>(i);
    if (declared.has(property) && property != SvgProperty::FontSize) reader.set(property, declared[property]);
  }
  return style;
}

std::optional<Color> color_value(std::string_view text, const Color& current) {
  text = without_blanks(text);
  return same_word(text, "currentcolor") ? current : parse_css_color(text);
}

std::optional<float> share_value(std::string_view text) {
  const std::optional<SvgLength> length = parse_length(text);
  if (!length || (length->unit != SvgUnit::Pixel && length->unit != SvgUnit::Percent)) return std::nullopt;
  return std::clamp(to_float(length->unit == SvgUnit::Percent ? length->value / 100 : length->value), 0.0F, 1.0F);
}

glm::vec4 to_vector(const Color& color) { return {color.r, color.g, color.b, color.a}; }

}  // namespace azulejo
