#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "azulejo/data/drawing.h"
#include "azulejo/io/svg_css.h"
#include "azulejo/io/svg_text.h"
#include "azulejo/math/color.h"

namespace azulejo {

/// What lengths are measured by.
struct SvgViewport {
  double width = 0;  ///< 100% of what goes along x
  double height = 0;
  double diagonal() const;  ///< 100% of the rest
};

/// What fill or stroke say.
struct SvgPaint {
  enum Kind : std::uint8_t { None, Plain, Current };
  Kind kind = None;         ///< also what is shown where the server isn't there
  Color color;              ///< Plain
  std::string_view server;  ///< id of what url() names; empty: there is none
};

/// The computed values of an element's properties.
struct SvgStyle {
  // Inherited.
  SvgPaint fill{SvgPaint::Plain, {}, {}};
  SvgPaint stroke;
  Color color;
  float fill_opacity = 1;
  float stroke_opacity = 1;
  FillRule fill_rule = FillRule::NonZero;
  FillRule clip_rule = FillRule::NonZero;
  float stroke_width = 1;
  LineCap cap = LineCap::Butt;
  LineJoin join = LineJoin::Miter;
  float miter_limit = 4;
  std::shared_ptr<const std::vector<float>> dash;  ///< null: solid
  float dash_offset = 0;
  float font_size = 16;
  bool visible = true;
  // The element's own.
  float opacity = 1;
  bool displayed = true;
  bool overflow = false;  ///< what is outside of a viewport is shown
  bool fixed_stroke = false;
  std::string_view clip_path;  ///< id; empty: none
};

/// What an element has whose parent has `parent`. Values that can't be read are as if they weren't there. Masks, filters
/// and markers are noted.
SvgStyle computed_style(const SvgStyle& parent, const SvgDeclarations& declared, const SvgViewport& viewport,
                        SvgNotes& notes);

/// A color or `currentColor`.
std::optional<Color> color_value(std::string_view text, const Color& current);
/// "0.5" or "50%", between 0 and 1.
std::optional<float> share_value(std::string_view text);

glm::vec4 to_vector(const Color& color);

}  // namespace azulejo
