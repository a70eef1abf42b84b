#include "azulejo/io/svg_shapes.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "azulejo/io/svg_path.h"
#include "azulejo/io/svg_text.h"

namespace azulejo {
namespace {

glm::vec2 stored(double x, double y) { return {to_float(x), to_float(y)}; }

void add_rectangle(const SvgLengths& lengths, Path& path) {
  const double x = lengths.along_x("x");
  const double y = lengths.along_y("y");
  const double width = lengths.along_x("width");
  const double height = lengths.along_y("height");
  if (!(width > 0) || !(height > 0)) return;
  double rx = lengths.along_x("rx", -1);
  double ry = lengths.along_y("ry", -1);
  if (rx < 0) rx = ry;
  if (ry < 0) ry = rx;
  rx = std::clamp(rx, 0.0, width / 2);
  ry = std::clamp(ry, 0.0, height / 2);
  if (rx == 0 || ry == 0) {
    path.move_to(stored(x, y)).line_to(stored(x + width, y)).line_to(stored(x + width, y + height));
    path.line_to(stored(x, y + height)).close();
    return;
  }
  const glm::dvec2 radii(rx, ry);
  path.move_to(stored(x + rx, y));
  add_arc(path, {x + width - rx, y + ry}, radii, -2, 2);
  add_arc(path, {x + width - rx, y + height - ry}, radii, 0, 2);
  add_arc(path, {x + rx, y + height - ry}, radii, 2, 2);
  add_arc(path, {x + rx, y + ry}, radii, 4, 2);
  path.close();
}

void add_ellipse(const SvgLengths& lengths, double rx, double ry, Path& path) {
  if (!(rx > 0) || !(ry > 0)) return;
  add_arc(path, {lengths.along_x("cx"), lengths.along_y("cy")}, {rx, ry}, 0, 8);
  path.close();
}

bool add_points(std::string_view text, bool closed, Path& path) {
  skip_blanks(text);
  while (!text.empty()) {
    const std::optional<double> x = take_number(text);
    skip_comma(text);
    const std::optional<double> y = x ? take_number(text) : std::nullopt;
    if (!y) break;
    path.commands.empty() ? path.move_to(stored(*x, *y)) : path.line_to(stored(*x, *y));
    skip_comma(text);
  }
  if (closed && !path.commands.empty()) path.close();
  return text.empty();
}

}  // namespace

double SvgLengths::value(const char* name, double hundred, double missing) const {
  const pugi::xml_attribute attribute = node_.attribute(name);
  const std::optional<SvgLength> length = attribute ? parse_length(attribute.value()) : std::nullopt;
  return length ? pixels_of(*length, hundred, font_size_) : missing;
}

bool add_svg_shape(SvgElement element, const pugi::xml_node& node, const SvgLengths& lengths, Path& path) {
  switch (element) {
    case SvgElement::Path: return parse_path_data(node.attribute("d").value(), path);
    case SvgElement::Rectangle: add_rectangle(lengths, path); return true;
    case SvgElement::Circle: {
      const double radius = lengths.any("r");
      add_ellipse(lengths, radius, radius, path);
      return true;
    }
    case SvgElement::Ellipse: {
      const double rx = lengths.along_x("rx", -1);
      const double ry = lengths.along_y("ry", -1);
      add_ellipse(lengths, rx < 0 ? ry : rx, ry < 0 ? rx : ry, path);
      return true;
    }
    case SvgElement::Line:
      path.move_to(stored(lengths.along_x("x1"), lengths.along_y("y1")));
      path.line_to(stored(lengths.along_x("x2"), lengths.along_y("y2")));
      return true;
    default: return add_points(node.attribute("points").value(), element == SvgElement::Polygon, path);
  }
}

}  // namespace azulejo
