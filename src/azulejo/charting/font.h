#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "azulejo/data/drawing.h"

namespace azulejo {

/// A glyph of a line of text, in font units, y up.
struct PlacedGlyph {
  std::uint32_t glyph = 0;
  float x = 0;
  float y = 0;
};

/// A line of text in font units.
struct ShapedLine {
  std::vector<PlacedGlyph> glyphs;
  float width = 0;
  std::uint32_t missing = 0;  ///< the first character that the font lacks; 0: none
};

/// A face of the built-in fonts.
struct FontMetrics {
  float units_per_em = 0;
  float ascent = 0;
  float descent = 0;  ///< positive
  float capital = 0;
};

const FontMetrics& font_metrics(bool bold);

/// text  valid UTF-8
ShapedLine shape_line(std::string_view text, bool bold);

/// Outline in font units, y up. Valid until this thread's next call.
const Path& glyph_outline(std::uint32_t glyph, bool bold);

}  // namespace azulejo
