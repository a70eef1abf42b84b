#pragma once

#include <cstdint>
#include <glm/mat3x2.hpp>
#include <glm/vec2.hpp>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "azulejo/data/drawing.h"

namespace azulejo {

// What an SVG is written of. All append to `text`.

/// The shortest number that is read as the same float; 0 where it isn't finite.
void put_number(std::string& text, float value);
/// For attributes and content: markup becomes entities, bytes that are not UTF-8 become U+FFFD.
void put_escaped(std::string& text, std::string_view value);
/// ` name="value"`; `value` needs no escaping.
void put_attribute(std::string& text, std::string_view name, std::string_view value);
void put_attribute(std::string& text, std::string_view name, float value);
/// "#f80", "#ff8000"; alpha isn't part of it.
void put_color(std::string& text, const glm::vec4& color);
/// Nothing for the identity.
void put_transform(std::string& text, std::string_view name, const glm::mat3x2& matrix);

/// Path data. Segments with coordinates that are not finite are left out; what follows begins anew.
/// matrix  brings the points to where they are written
void put_path_data(std::string& text, const PathView& path, const glm::mat3x2& matrix = {1, 0, 0, 1, 0, 0});

/// Path data of the marks at a path's points. to_page  brings the path to the page, where `size` is measured
void put_marks(std::string& text, const PathView& path, PointShape shape, float size, const glm::mat3x2& to_page);

/// Names that are valid and given once.
class SvgIds {
 public:
  /// The name itself where it may be one and is free, else what is nearest to it.
  std::string unique(std::string_view wanted);

 private:
  std::unordered_map<std::string, std::uint32_t> taken_;  ///< how often each was wanted
};

/// What of a drawing's styles and patterns stands before its paths.
class SvgDefinitions {
 public:
  SvgDefinitions(const Drawing& drawing, SvgIds& ids);

  /// ` class="a"`, or the attributes themselves. `marks`: of the path that shows the style's points.
  void put_style(std::string& text, std::uint32_t style, bool marks) const;
  /// The style sheet, gradients and patterns; nothing where there are none.
  void put(std::string& text) const;

 private:
  using Colored = std::pair<std::uint32_t, std::uint32_t>;  ///< a pattern, and a color in 24 bits

  void name_patterns(const Drawing& drawing, SvgIds& ids);
  void choose_classes(const std::vector<std::uint32_t>& uses);
  void put_properties(std::string& text, std::uint32_t style, bool css, bool marks) const;

  const Drawing& drawing_;
  std::map<Colored, std::string> patterns_;
  std::vector<std::string> classes_;  ///< of styles; empty: attributes
};

/// "#rrggbb" as a number.
std::uint32_t svg_color_bits(const glm::vec4& color);
/// A gradient, hatch or stipple.
void put_pattern(std::string& text, const PaintPattern& pattern, std::string_view id, std::uint32_t color);

}  // namespace azulejo
