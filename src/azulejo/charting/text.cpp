#include "azulejo/charting/text.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "azulejo/charting/font.h"
#include "azulejo/charting/turn.h"
#include "azulejo/core/error.h"

namespace azulejo {
namespace {

constexpr float kLargestSize = 1e6F;
constexpr float kLargestAngle = 1e6F;
constexpr std::string_view kReplacement = "\xEF\xBF\xBD";  // U+FFFD
constexpr std::string_view kEllipsis = "\xE2\x80\xA6";     // U+2026

/// Bytes of the character that begins the text, 0: they are no UTF-8 (Unicode 15, table 3-7).
std::size_t character_size(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  if (first < 0xC2 || first > 0xF4) return 0;
  const std::size_t size = first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  if (text.size() < size) return 0;
  // Neither longer than need be, nor a surrogate, nor beyond U+10FFFF.
  const int lower = first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
  const int upper = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
  if (byte(1) < lower || byte(1) > upper) return 0;
  for (std::size_t i = 2; i < size; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
  }
  return size;
}

bool is_control(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  if (character.size() == 1) return first < 0x20 || first == 0x7F;
  if (character.size() == 2) return first == 0xC2 && static_cast<unsigned char>(character[1]) < 0xA0;
  // The ends of lines and paragraphs; U+FFFE and U+FFFF, which files may not hold.
  return character == "\xE2\x80\xA8" || character == "\xE2\x80\xA9" || character == "\xEF\xBF\xBE" ||
         character == "\xEF\xBF\xBF";
}

void check(const glm::vec2& place, const TextOptions& options) {
  if (!(options.size >= 0 && options.size <= kLargestSize)) {
    throw Error(Error::Argument, fmt::format("text: size is {}, expected 0 to {}", options.size, kLargestSize));
  }
  if (!(std::abs(options.angle) <= kLargestAngle)) {
    throw Error(Error::Argument,
                fmt::format("text: angle is {}, expected {} to {}", options.angle, -kLargestAngle, kLargestAngle));
  }
  if (!std::isfinite(place.x) || !std::isfinite(place.y)) {
    throw Error(Error::Argument, fmt::format("text: its place is {},{}, expected numbers", place.x, place.y));
  }
}

TextExtent extent_of(const ShapedLine& line, const TextOptions& options) {
  const FontMetrics& font = font_metrics(options.bold);
  const float scale = options.size / font.units_per_em;
  return {line.width * scale, font.ascent * scale, font.descent * scale, font.capital * scale};
}

/// Where the baseline begins, of a text whose place is (0, 0).
glm::vec2 baseline_start(const TextExtent& extent, const TextOptions& options) {
  glm::vec2 start{0, 0};
  switch (options.anchor) {
    case TextAnchor::Start: break;
    case TextAnchor::Middle: start.x = -0.5F * extent.width; break;
    case TextAnchor::End: start.x = -extent.width; break;
  }
  switch (options.level) {
    case TextLevel::Baseline: break;
    case TextLevel::Middle: start.y = 0.5F * extent.capital; break;
    case TextLevel::Top: start.y = extent.ascent; break;
    case TextLevel::Bottom: start.y = -extent.descent; break;
  }
  return start;
}

/// The outlines of a line, its baseline beginning at `start`.
Path outlines_of(const ShapedLine& line, const TextOptions& options, const glm::vec2& start) {
  const float scale = options.size / font_metrics(options.bold).units_per_em;
  Path path;
  for (const PlacedGlyph& placed : line.glyphs) {
    const Path& outline = glyph_outline(placed.glyph, options.bold);
    path.commands.insert(path.commands.end(), outline.commands.begin(), outline.commands.end());
    for (const glm::vec2& point : outline.points) {
      path.points.emplace_back(start.x + (placed.x + point.x) * scale, start.y - (placed.y + point.y) * scale);
    }
  }
  return path;
}

}  // namespace

std::string_view text_family() { return "DejaVu Sans"; }

std::string drawn_text(std::string_view text) {
  std::string drawn;
  while (!text.empty()) {
    const std::size_t size = character_size(text);
    std::string_view character = size == 0 ? kReplacement : text.substr(0, size);
    if (is_control(character)) character = " ";
    if (drawn.size() + character.size() > kLongestText) {
      while (drawn.size() + kEllipsis.size() > kLongestText) {
        while ((static_cast<unsigned char>(drawn.back()) & 0xC0) == 0x80) drawn.pop_back();
        drawn.pop_back();
      }
      return drawn.append(kEllipsis);
    }
    drawn += character;
    text.remove_prefix(std::max<std::size_t>(size, 1));
  }
  return drawn;
}

TextExtent measure_text(std::string_view text, const TextOptions& options) {
  check({0, 0}, options);
  return extent_of(shape_line(drawn_text(text), options.bold), options);
}

std::uint32_t add_text(Drawing& drawing, std::string_view text, const glm::vec2& place, const TextOptions& options,
                       std::uint32_t style, std::string id, std::uint32_t group, const Run& run) {
  check(place, options);
  DrawingText told{drawn_text(text), std::string(text_family()), options.bold, options.size, {}};
  const ShapedLine line = shape_line(told.text, options.bold);
  if (line.missing != 0) {
    warn(run, fmt::format("text: {}{} has no glyph for U+{:04X}: a box stands for it", text_family(),
                          options.bold ? " Bold" : "", line.missing));
  }
  told.origin = baseline_start(extent_of(line, options), options);
  if (options.angle == 0) {
    told.origin += place;
  } else {
    group = drawing.add_group(turned(options.angle, place), 1, group);
  }
  const std::uint32_t path = drawing.add_path(outlines_of(line, options, told.origin), style, std::move(id), group);
  drawing.paths[path].text = static_cast<std::uint32_t>(drawing.texts.size());
  drawing.texts.push_back(std::move(told));
  return path;
}

}  // namespace azulejo
