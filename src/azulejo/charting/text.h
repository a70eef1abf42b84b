#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/drawing.h"

namespace azulejo {

/// Which end of a line of text is at its place.
enum class TextAnchor : std::uint8_t { Start, Middle, End };
/// What of its height is there. Middle: half of the height of capitals. Top and bottom: of the line, with room for
/// accents and descenders.
enum class TextLevel : std::uint8_t { Baseline, Middle, Top, Bottom };

constexpr auto enum_names(TextAnchor) { return std::array<std::string_view, 3>{"start", "middle", "end"}; }
constexpr auto enum_names(TextLevel) { return std::array<std::string_view, 4>{"baseline", "middle", "top", "bottom"}; }

struct TextOptions {
  float size = 12;  ///< of the em square, in the drawing's units
  bool bold = false;
  TextAnchor anchor = TextAnchor::Start;
  TextLevel level = TextLevel::Baseline;
  float angle = 0;  ///< radians, counter-clockwise as seen, about its place
};

/// The size of a line of text, whatever it says in its height: ascent and descent are the font's.
struct TextExtent {
  float width = 0;    ///< how far it moves the pen
  float ascent = 0;   ///< above the baseline
  float descent = 0;  ///< below it, positive
  float capital = 0;  ///< height of capitals
};

/// Longer texts are cut after the last whole character that fits, and end in "…".
inline constexpr std::size_t kLongestText = 4096;  // bytes

/// How large a line of text is.
///
/// text   UTF-8. Bytes that are none become U+FFFD; line ends, tabs and other control characters are spaces
/// Font   DejaVu Sans, or its bold face, which the library carries: the same everywhere. Kerned, with ligatures and the
///        joined forms of Arabic. Direction and script are those of the first letter that has one; a line of both
///        directions has all of it in one
/// Cost   O(bytes): about 1 µs a letter
AZULEJO_EXPORT TextExtent measure_text(std::string_view text, const TextOptions& options = {});

/// Puts the outlines of a line of text into a drawing, as one path that knows its text (DrawingPath::text).
///
/// text    as measure_text. What the font lacks is its box for missing glyphs, told in one warning
/// place   in the group's units. With an angle, the path is in a group of its own
/// style   index; non-zero filling, no hinting: the outlines are the font's, scaled
/// Result  index of the path; empty text gives an empty path
/// Throws  Error(Argument) for a size that is negative or beyond 1e6, an angle beyond 1e6, a place that is not finite
AZULEJO_EXPORT std::uint32_t add_text(Drawing& drawing, std::string_view text, const glm::vec2& place,
                                      const TextOptions& options, std::uint32_t style, std::string id = {},
                                      std::uint32_t group = 0, const Run& run = {});

/// "DejaVu Sans", the family of all text.
AZULEJO_EXPORT std::string_view text_family();

/// The text as it is drawn: valid UTF-8 of at most kLongestText bytes without control characters.
AZULEJO_EXPORT std::string drawn_text(std::string_view text);

}  // namespace azulejo
