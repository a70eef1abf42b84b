#include "azulejo/io/svg_view.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "azulejo/io/svg_text.h"

namespace azulejo {
namespace {

constexpr double kMillimetresPerPixel = 25.4 / 96;
constexpr double kFontSize = 16;

bool is_physical(const std::optional<SvgLength>& length) {
  return length && (length->unit == SvgUnit::Millimetre || length->unit == SvgUnit::Centimetre ||
                    length->unit == SvgUnit::Quarter || length->unit == SvgUnit::Inch);
}

/// Without a detour over pixels, whose rounding would show.
double millimetres_of(const SvgLength& length) {
  switch (length.unit) {
    case SvgUnit::Millimetre: return length.value;
    case SvgUnit::Centimetre: return length.value * 10;
    case SvgUnit::Quarter: return length.value / 4;
    case SvgUnit::Inch: return length.value * 25.4;
    default: return pixels_of(length, 0, kFontSize) * kMillimetresPerPixel;
  }
}

std::optional<SvgLength> size_of(const pugi::xml_node& root, const char* name) {
  const std::optional<SvgLength> length = parse_length(root.attribute(name).value());
  return length && length->unit != SvgUnit::Percent && length->value > 0 ? length : std::nullopt;
}

/// Where the rest goes that is left over: all of it behind, half, or before.
double share_before(std::string_view alignment, std::string_view axis) {
  const std::size_t at = alignment.find(axis);
  const std::string_view word = at == std::string_view::npos ? "" : alignment.substr(at + 1, 3);
  return word == "Min" ? 0 : word == "Max" ? 1 : 0.5;
}

}  // namespace

std::optional<SvgViewBox> parse_view_box(std::string_view text) {
  const std::vector<double> v = parse_numbers(text);
  if (v.size() != 4 || !(v[2] > 0) || !(v[3] > 0)) return std::nullopt;
  return SvgViewBox{v[0], v[1], v[2], v[3]};
}

glm::dmat3x2 viewport_from_view_box(const SvgViewBox& box, double width, double height, std::string_view aspect) {
  double sx = width / box.width;
  double sy = height / box.height;
  skip_blanks(aspect);
  if (aspect.starts_with("defer")) aspect.remove_prefix(5);
  skip_blanks(aspect);
  const std::string_view alignment = take_word(aspect);
  if (alignment == "none") return {sx, 0, 0, sy, -box.x * sx, -box.y * sy};
  const bool slice = without_blanks(aspect) == "slice";
  sx = sy = slice ? std::max(sx, sy) : std::min(sx, sy);
  const double x = (width - box.width * sx) * share_before(alignment, "x") - box.x * sx;
  const double y = (height - box.height * sy) * share_before(alignment, "Y") - box.y * sy;
  return {sx, 0, 0, sy, x, y};
}

SvgPage svg_page(const pugi::xml_node& root) {
  SvgPage page;
  const std::optional<SvgLength> width = size_of(root, "width");
  const std::optional<SvgLength> height = size_of(root, "height");
  const std::optional<SvgViewBox> box = parse_view_box(root.attribute("viewBox").value());
  const bool physical = is_physical(width) || is_physical(height);
  if (physical) page.unit = DrawingUnit::Millimetre;
  const auto in_page_units = [&](const SvgLength& length) {
    return physical ? millimetres_of(length) : pixels_of(length, 0, kFontSize);
  };
  if (width) page.width = in_page_units(*width);
  if (height) page.height = in_page_units(*height);
  if (box) {
    if (!width) page.width = height ? page.height * box->width / box->height : box->width;
    if (!height) page.height = width ? page.width * box->height / box->width : box->height;
    page.page_from_user =
        viewport_from_view_box(*box, page.width, page.height, root.attribute("preserveAspectRatio").value());
    page.viewport = {box->width, box->height};
  } else {
    const double scale = physical ? kMillimetresPerPixel : 1;
    page.page_from_user = {scale, 0, 0, scale, 0, 0};
    page.viewport = {page.width / scale, page.height / scale};
  }
  return page;
}

}  // namespace azulejo
