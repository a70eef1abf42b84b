#include "azulejo/io/svg_gradient.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "azulejo/io/svg_text.h"

namespace azulejo {
namespace {

constexpr std::size_t kMostReferences = 32;
constexpr double kFontSize = 16;

constexpr std::array<const char*, 10> kPlaceNames = {"x1", "y1", "x2", "y2", "cx", "cy", "r", "fx", "fy", "fr"};

glm::vec2 stored(double x, double y) { return {to_float(x), to_float(y)}; }

}  // namespace

/// The gradient, and those that it refers to.
std::vector<pugi::xml_node> SvgGradients::chain(const pugi::xml_node& node) {
  std::vector<pugi::xml_node> nodes{node};
  while (true) {
    const std::string_view id = svg_reference(nodes.back());
    const pugi::xml_node next = id.empty() ? pugi::xml_node() : document_.find(id);
    if (!next || document_.element_of(next) != SvgElement::Gradient) return nodes;
    if (nodes.size() == kMostReferences || std::find(nodes.begin(), nodes.end(), next) != nodes.end()) {
      notes_.wrong("gradients refer to each other in a circle, or more than 32 deep");
      return nodes;
    }
    nodes.push_back(next);
  }
}

/// What `currentColor` is for an element.
Color SvgGradients::inherited_color(pugi::xml_node node) const {
  for (; node; node = node.parent()) {
    const SvgDeclarations declared = document_.declarations(node);
    const std::string_view value = declared[SvgProperty::Color];
    if (const std::optional<Color> color = color_value(value, {}); color && !same_word(value, "currentcolor")) {
      return *color;
    }
  }
  return {};
}

std::vector<GradientStop> SvgGradients::stops_of(const pugi::xml_node& node) {
  std::vector<GradientStop> stops;
  float before = 0;
  for (const pugi::xml_node& child : node.children()) {
    if (document_.element_of(child) != SvgElement::Stop) continue;
    const SvgDeclarations declared = document_.declarations(child);
    GradientStop stop;
    before = stop.offset = std::max(before, share_value(child.attribute("offset").value()).value_or(0));
    const std::string_view value = declared[SvgProperty::StopColor];
    const Color current = same_word(value, "currentcolor") ? inherited_color(child) : Color();
    Color color = color_value(value, current).value_or(Color());
    color.a *= share_value(declared[SvgProperty::StopOpacity]).value_or(1);
    stop.color = to_vector(color);
    stops.push_back(stop);
  }
  return stops;
}

SvgGradients::Description SvgGradients::describe(const pugi::xml_node& node) {
  Description result;
  result.radial = document_.name_of(node) == "radialGradient";
  const std::vector<pugi::xml_node> nodes = chain(node);
  // The nearest that says it.
  const auto text = [&](const char* name) {
    for (const pugi::xml_node& each : nodes) {
      if (const pugi::xml_attribute attribute = each.attribute(name)) return std::string_view(attribute.value());
    }
    return std::string_view();
  };
  result.box_units = without_blanks(text("gradientUnits")) != "userSpaceOnUse";
  const std::string_view spread = without_blanks(text("spreadMethod"));
  if (spread == "reflect") result.spread = GradientSpread::Reflect;
  if (spread == "repeat") result.spread = GradientSpread::Repeat;
  const auto matrix = parse_transform(text("gradientTransform"));
  if (!matrix) notes_.wrong("a gradientTransform can't be read");
  result.matrix = matrix.value_or(result.matrix);
  for (std::size_t i = 0; i < kPlaces; ++i) result.places[i] = parse_length(text(kPlaceNames[i]));
  for (const pugi::xml_node& each : nodes) {
    result.stops = stops_of(each);
    if (!result.stops.empty()) break;
  }
  return result;
}

const SvgGradients::Description& SvgGradients::described(const pugi::xml_node& node) {
  const auto found = known_.find(node.internal_object());
  if (found != known_.end()) return found->second;
  return known_.emplace(node.internal_object(), describe(node)).first->second;
}

/// 0% for the places that aren't told, or what SVG has for them.
double SvgGradients::Description::place(Place which, const SvgViewport& viewport) const {
  SvgLength length{which == X2 ? 100.0 : which >= Cx && which <= R ? 50.0 : 0.0, SvgUnit::Percent};
  length = places[which].value_or(length);
  const bool along_x = which == X1 || which == X2 || which == Cx || which == Fx;
  const bool radius = which == R || which == Fr;
  const double hundred = radius ? viewport.diagonal() : along_x ? viewport.width : viewport.height;
  return pixels_of(length, box_units ? 1 : hundred, kFontSize);
}

SvgGradients::Result SvgGradients::paint(const pugi::xml_node& node, const Box2& box, const SvgViewport& viewport) {
  const Description& known = described(node);
  if (known.stops.empty()) return Nothing();
  Gradient gradient;
  gradient.radial = known.radial;
  gradient.spread = known.spread;
  const auto place = [&](Place which) { return known.place(which, viewport); };
  if (known.radial) {
    const double x = place(Cx);
    const double y = place(Cy);
    gradient.to = stored(x, y);
    gradient.from = stored(known.places[Fx] ? place(Fx) : x, known.places[Fy] ? place(Fy) : y);
    gradient.to_radius = std::max(0.0F, to_float(place(R)));
    gradient.from_radius = std::max(0.0F, to_float(place(Fr)));
  } else {
    gradient.from = stored(place(X1), place(Y1));
    gradient.to = stored(place(X2), place(Y2));
  }
  const bool is_point = known.radial ? !(gradient.to_radius > 0) : gradient.from == gradient.to;
  if (is_point) return known.stops.back().color;
  glm::dmat3x2 matrix = known.matrix;
  if (known.box_units) {
    const glm::dvec2 size = glm::dvec2(box.upper) - glm::dvec2(box.lower);
    if (box.empty() || !(size.x > 0) || !(size.y > 0)) return Nothing();
    const auto x = static_cast<double>(box.lower.x);
    const auto y = static_cast<double>(box.lower.y);
    matrix = combined(glm::dmat3x2(size.x, 0, 0, size.y, x, y), matrix);
  }
  gradient.path_from_gradient = to_floats(matrix);
  gradient.stops = known.stops;
  return gradient;
}

}  // namespace azulejo
