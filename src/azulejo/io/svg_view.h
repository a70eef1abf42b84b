#pragma once

#include <glm/mat3x2.hpp>
#include <optional>
#include <string_view>

#include <pugixml.hpp>

#include "azulejo/data/drawing.h"
#include "azulejo/io/svg_shapes.h"
#include "azulejo/io/svg_style.h"

namespace azulejo {

/// A viewBox: what is seen of the user's coordinates.
struct SvgViewBox {
  double x = 0;
  double y = 0;
  double width = 0;
  double height = 0;
};
/// Nothing where there are not four numbers, or no area.
std::optional<SvgViewBox> parse_view_box(std::string_view text);

/// Brings a viewBox into (0, 0) to (width, height), as preserveAspectRatio says: "xMinYMid slice", "none".
/// Source  SVG 1.1, 7.8
glm::dmat3x2 viewport_from_view_box(const SvgViewBox& box, double width, double height, std::string_view aspect);

/// The page that the root asks for.
struct SvgPage {
  double width = 0;  ///< 0: not known
  double height = 0;
  DrawingUnit unit = DrawingUnit::Pixel;
  glm::dmat3x2 page_from_user{1, 0, 0, 1, 0, 0};
  SvgViewport viewport;  ///< in the user's units
};
/// In millimetres if width or height is in mm, cm, Q or in. A size that isn't there, or in percent, is the viewBox's, in
/// proportion.
SvgPage svg_page(const pugi::xml_node& root);

}  // namespace azulejo
