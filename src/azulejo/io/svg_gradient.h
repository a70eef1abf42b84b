#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <pugixml.hpp>
#include <unordered_map>
#include <variant>
#include <vector>

#include "azulejo/data/drawing.h"
#include "azulejo/io/svg_document.h"
#include "azulejo/io/svg_notes.h"
#include "azulejo/io/svg_style.h"

namespace azulejo {

/// The gradients of a file.
class SvgGradients {
 public:
  SvgGradients(const SvgDocument& document, SvgNotes& notes) : document_(document), notes_(notes) {}

  /// What a gradient paints a path with whose outline fills `box`: a Gradient; a color, where it is the same everywhere;
  /// nothing, where it has no stops, or is measured by a box without area.
  struct Nothing {};
  using Result = std::variant<Nothing, glm::vec4, Gradient>;
  Result paint(const pugi::xml_node& node, const Box2& box, const SvgViewport& viewport);

  /// True if the result depends on the box.
  bool is_measured_by_box(const pugi::xml_node& node) { return described(node).box_units; }

 private:
  /// Where an attribute says where the gradient is.
  enum Place : std::uint8_t { X1, Y1, X2, Y2, Cx, Cy, R, Fx, Fy, Fr };
  static constexpr std::size_t kPlaces = 10;

  /// A gradient with what it takes from others.
  struct Description {
    bool radial = false;
    bool box_units = true;
    GradientSpread spread = GradientSpread::Pad;
    glm::dmat3x2 matrix{1, 0, 0, 1, 0, 0};
    std::vector<GradientStop> stops;
    std::array<std::optional<SvgLength>, kPlaces> places;
    double place(Place which, const SvgViewport& viewport) const;
  };

  const Description& described(const pugi::xml_node& node);
  Description describe(const pugi::xml_node& node);
  std::vector<pugi::xml_node> chain(const pugi::xml_node& node);
  std::vector<GradientStop> stops_of(const pugi::xml_node& node);
  Color inherited_color(pugi::xml_node node) const;

  const SvgDocument& document_;
  SvgNotes& notes_;
  std::unordered_map<const void*, Description> known_;
};

}  // namespace azulejo
