#pragma once

#include <pugixml.hpp>

#include "azulejo/data/drawing.h"
#include "azulejo/io/svg_document.h"
#include "azulejo/io/svg_style.h"

namespace azulejo {

/// Lengths in the attributes of an element.
class SvgLengths {
 public:
  SvgLengths(const pugi::xml_node& node, const SvgViewport& viewport, float font_size)
      : node_(node), viewport_(viewport), font_size_(static_cast<double>(font_size)) {}

  /// `missing` where the attribute isn't there or can't be read.
  double along_x(const char* name, double missing = 0) const { return value(name, viewport_.width, missing); }
  double along_y(const char* name, double missing = 0) const { return value(name, viewport_.height, missing); }
  double any(const char* name, double missing = 0) const { return value(name, viewport_.diagonal(), missing); }

 private:
  double value(const char* name, double hundred, double missing) const;

  pugi::xml_node node_;
  SvgViewport viewport_;
  double font_size_;
};

/// Appends the outline of a path or a basic shape, as SVG 1.1, 9, says where it begins and in which direction it goes.
/// Nothing where sizes are 0, missing or negative. False: there is an error in path data or points, before which it was
/// read.
bool add_svg_shape(SvgElement element, const pugi::xml_node& node, const SvgLengths& lengths, Path& path);

}  // namespace azulejo
