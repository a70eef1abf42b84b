#include "azulejo/io/svg_styles.h"

#include <bit>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

class Hash {
 public:
  void add(std::uint64_t value) { state_ = (state_ ^ value) * 0x9E3779B97F4A7C15U + (state_ >> 29); }
  void add(float value) { add(std::uint64_t{std::bit_cast<std::uint32_t>(value == 0 ? 0.0F : value)}); }
  void add(const std::optional<Paint>& paint) {
    add(std::uint64_t{paint.has_value()});
    if (!paint) return;
    for (int c = 0; c < 4; ++c) add(paint->color[c]);
    add(paint->pattern ? std::uint64_t{*paint->pattern} + 1 : 0);
  }
  std::size_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0;
};

std::size_t hash_of(const DrawingStyle& style) {
  Hash hash;
  hash.add(style.fill);
  hash.add(style.stroke);
  hash.add(static_cast<std::uint64_t>(style.fill_rule) | static_cast<std::uint64_t>(style.cap) << 8 |
           static_cast<std::uint64_t>(style.join) << 16 | std::uint64_t{style.fixed_stroke} << 24);
  for (const float each : {style.stroke_width, style.miter_limit, style.dash_offset, style.opacity}) hash.add(each);
  for (const float each : style.dash) hash.add(each);
  return hash.value();
}

}  // namespace

void SvgBudget::add_bytes(std::size_t bytes) {
  bytes_ += bytes;
  if (bytes_ > static_cast<std::size_t>(run_.limits.memory_bytes)) {
    throw Error(Error::Resource,
                fmt::format("{}: more than {} bytes to hold, the limit of memory", file_, run_.limits.memory_bytes));
  }
}

void SvgBudget::add_copy(const pugi::xml_node& node) {
  ++copies_;
  for (const pugi::xml_attribute& each : node.attributes()) copied_bytes_ += std::strlen(each.value());
  check_copies();
}

void SvgBudget::add_looks(std::size_t count) {
  copies_ += count;
  check_copies();
}

void SvgBudget::check_copies() const {
  if (copies_ <= kMostCopies && copied_bytes_ <= kMostCopiedBytes) return;
  throw Error(Error::Resource, fmt::format("{}: its elements are used more than {} times, or {} bytes of them", file_,
                                           kMostCopies, kMostCopiedBytes));
}

DrawingStyle SvgStyles::style_of(const SvgStyle& style, const PathView& path, const SvgViewport& viewport) {
  DrawingStyle result;
  result.fill = paint(style.fill, style.fill_opacity, style, path, viewport);
  result.fill_rule = style.fill_rule;
  // A line without width is none.
  if (style.stroke_width > 0) result.stroke = paint(style.stroke, style.stroke_opacity, style, path, viewport);
  if (!result.stroke) return result;
  result.stroke_width = style.stroke_width;
  result.cap = style.cap;
  result.join = style.join;
  result.miter_limit = style.miter_limit;
  if (style.dash) {
    result.dash = *style.dash;
    result.dash_offset = style.dash_offset;
  }
  result.fixed_stroke = style.fixed_stroke;
  return result;
}

std::uint32_t SvgStyles::index_of(const DrawingStyle& style) {
  const std::size_t hash = hash_of(style);
  const auto [first, last] = known_.equal_range(hash);
  for (auto each = first; each != last; ++each) {
    if (drawing_.styles[each->second] == style) return each->second;
  }
  budget_.add_bytes(sizeof(DrawingStyle) + style.dash.size() * sizeof(float));
  const auto index = static_cast<std::uint32_t>(drawing_.styles.size());
  drawing_.styles.push_back(style);
  known_.emplace(hash, index);
  return index;
}

std::optional<Paint> SvgStyles::paint(const SvgPaint& paint, float opacity, const SvgStyle& style, const PathView& path,
                                      const SvgViewport& viewport) {
  if (!paint.server.empty()) {
    const pugi::xml_node server = document_.find(paint.server);
    const SvgElement kind = document_.element_of(server);
    if (kind == SvgElement::Gradient) {
      if (const auto result = served(server, opacity, path, viewport)) return result;
    } else if (kind == SvgElement::Pattern) {
      notes_.left_out("pattern");
    } else {
      notes_.wrong("a fill or stroke names what isn't there");
    }
  }
  if (paint.kind == SvgPaint::None) return std::nullopt;
  glm::vec4 color = to_vector(paint.kind == SvgPaint::Current ? style.color : paint.color);
  color.w *= opacity;
  return Paint(color);
}

std::optional<Paint> SvgStyles::served(const pugi::xml_node& server, float opacity, const PathView& path,
                                       const SvgViewport& viewport) {
  const Box2 box = gradients_.is_measured_by_box(server) ? bounds(path) : Box2();
  SvgGradients::Result result = gradients_.paint(server, box, viewport);
  if (auto* const color = std::get_if<glm::vec4>(&result)) {
    color->w *= opacity;
    return Paint(*color);
  }
  auto* const gradient = std::get_if<Gradient>(&result);
  if (gradient == nullptr) return std::nullopt;
  return Paint({0, 0, 0, opacity}, pattern(server, std::move(*gradient)));
}

std::uint32_t SvgStyles::pattern(const pugi::xml_node& node, Gradient gradient) {
  const auto last = patterns_.find(node.internal_object());
  if (last != patterns_.end() && std::get<Gradient>(drawing_.patterns[last->second]) == gradient) return last->second;
  budget_.add_bytes(sizeof(PaintPattern) + gradient.stops.size() * sizeof(GradientStop));
  return patterns_[node.internal_object()] = drawing_.add_pattern(std::move(gradient));
}

}  // namespace azulejo
