#pragma once

#include <cstddef>
#include <cstdint>
#include <pugixml.hpp>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>

#include "azulejo/core/run.h"
#include "azulejo/io/input.h"
#include "azulejo/io/read_text.h"
#include "azulejo/io/svg_css.h"
#include "azulejo/io/svg_notes.h"

namespace azulejo {

enum class SvgElement : std::uint8_t {
  Unknown,
  Animation,  ///< animate, animateTransform, set, …
  Circle,
  ClipPath,
  Definitions,  ///< defs, and all whose content is only named by others
  Ellipse,
  Gradient,
  Group,    ///< g, a
  LeftOut,  ///< text, image, …: known, and not read
  Line,
  Path,
  Pattern,
  Polygon,
  Polyline,
  Rectangle,
  Silent,  ///< title, metadata: nothing to see
  Stop,
  Svg,
  Switch,
  Symbol,
  Use,
};

/// A file as a tree of elements.
class SvgDocument {
 public:
  static constexpr int kMostLevels = 1000;

  /// Refuses what the tree would need more memory for than there may be, before it is made, and elements in more than
  /// kMostLevels of others. Entities that the file defines are not expanded.
  /// Throws Error(Data) naming the line, Error(Resource).
  SvgDocument(const Input& input, const Run& run, SvgNotes& notes);

  pugi::xml_node root() const { return root_; }
  /// Null if there is none.
  pugi::xml_node find(std::string_view id) const;
  /// Without the prefix of SVG's namespace; "" for elements of other namespaces.
  std::string_view name_of(const pugi::xml_node& node) const;
  SvgElement element_of(const pugi::xml_node& node) const;
  std::size_t elements() const { return elements_; }
  std::size_t bytes() const { return text_.bytes.size(); }
  const SvgStyleSheet& sheet() const { return sheet_; }
  const std::string& file() const { return file_; }

  /// What attributes, style sheets and the style attribute say.
  SvgDeclarations declarations(const pugi::xml_node& node) const;

 private:
  void parse(const Run& run);
  void look_through(SvgNotes& notes);

  std::string file_;
  Text text_;  ///< names and values lie in it
  pugi::xml_document document_;
  pugi::xml_node root_;
  std::string prefix_;  ///< "svg:", mostly empty
  std::unordered_map<std::string_view, pugi::xml_node> ids_;
  SvgStyleSheet sheet_;
  std::size_t elements_ = 0;
};

/// What href or xlink:href names in the same file; empty: nothing.
std::string_view svg_reference(const pugi::xml_node& node);

/// True if the beginning of a file is that of an SVG, as far as can be seen from it.
bool begins_like_svg(std::span<const std::byte> head, std::string_view name);

}  // namespace azulejo
