#include "azulejo/charting/text.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "azulejo/charting/font.h"
#include "azulejo/core/error.h"

namespace azulejo {
namespace {

/// Of DejaVu Sans 2.37: units of an em; advance of each digit, of a space; height of H; ascender and descender.
constexpr float kEm = 2048;
constexpr float kDigit = 1303;
constexpr float kSpace = 651;
constexpr float kCapital = 1493;
constexpr float kAscent = 1901;
constexpr float kDescent = 483;

struct Drawn {
  Drawing drawing;
  std::uint32_t path = 0;
  std::vector<std::string> warnings;

  PathView view() const { return drawing.view(drawing.paths[path]); }
  const DrawingText& text() const { return drawing.texts[*drawing.paths[path].text]; }
};

Drawn drawn(std::string_view text, const glm::vec2& place = {0, 0}, const TextOptions& options = {.size = kEm}) {
  Drawn result;
  Run run;
  run.warn = [&](const std::string& message) { result.warnings.push_back(message); };
  const std::uint32_t style = result.drawing.add_style({});
  result.path = add_text(result.drawing, text, place, options, style, "id", 0, run);
  result.drawing.check("text");
  return result;
}

TEST(Text, WidthsAreTheFontsAdvances) {
  EXPECT_EQ(measure_text("0123456789", {.size = kEm}).width, 10 * kDigit);
  EXPECT_EQ(measure_text("1 1", {.size = kEm}).width, 2 * kDigit + kSpace);
  EXPECT_EQ(measure_text("", {.size = kEm}).width, 0);
  const TextExtent extent = measure_text("x", {.size = kEm / 2});
  EXPECT_EQ(extent.ascent, kAscent / 2);
  EXPECT_EQ(extent.descent, kDescent / 2);
  EXPECT_EQ(extent.capital, kCapital / 2);
  EXPECT_GT(measure_text("mill", {.bold = true}).width, measure_text("mill").width);
}

TEST(Text, PairsAreKerned) {
  const auto width = [](std::string_view text) { return measure_text(text, {.size = kEm}).width; };
  EXPECT_LT(width("AV"), width("A") + width("V"));
  EXPECT_EQ(width("HH"), 2 * width("H"));
}

TEST(Text, OutlinesStandOnTheirBaseline) {
  const Drawn h = drawn("H", {100, 5000});
  const Box2 box = bounds(h.view());
  EXPECT_EQ(box.upper.y, 5000);
  EXPECT_EQ(box.lower.y, 5000 - kCapital);
  EXPECT_GT(box.lower.x, 100);
  EXPECT_LT(box.upper.x, 100 + measure_text("H", {.size = kEm}).width);
  // H is one contour of 12 corners, o two of curves.
  EXPECT_EQ(std::count(h.view().commands.begin(), h.view().commands.end(), PathCommand::Move), 1);
  const Drawn o = drawn("o");
  EXPECT_EQ(std::count(o.view().commands.begin(), o.view().commands.end(), PathCommand::Move), 2);
  EXPECT_GT(std::count(o.view().commands.begin(), o.view().commands.end(), PathCommand::Quadratic), 4);
}

TEST(Text, KnowsWhatItSays) {
  const Drawn result = drawn("Área", {3, 4}, {.size = 10, .bold = true});
  EXPECT_EQ(result.text(), (DrawingText{"Área", "DejaVu Sans", true, 10, {3, 4}}));
  EXPECT_EQ(result.drawing.paths[result.path].id, "id");
  EXPECT_TRUE(result.warnings.empty());
}

TEST(Text, AnchorsMoveIt) {
  const float width = measure_text("123", {.size = kEm}).width;
  const auto origin = [](TextAnchor anchor, TextLevel level) {
    return drawn("123", {1000, 2000}, {.size = kEm, .anchor = anchor, .level = level}).text().origin;
  };
  EXPECT_EQ(origin(TextAnchor::Start, TextLevel::Baseline), glm::vec2(1000, 2000));
  EXPECT_EQ(origin(TextAnchor::Middle, TextLevel::Middle), glm::vec2(1000 - width / 2, 2000 + kCapital / 2));
  EXPECT_EQ(origin(TextAnchor::End, TextLevel::Top), glm::vec2(1000 - width, 2000 + kAscent));
  EXPECT_EQ(origin(TextAnchor::End, TextLevel::Bottom), glm::vec2(1000 - width, 2000 - kDescent));
}

TEST(Text, AQuarterTurnRunsUpwards) {
  const Drawn result = drawn("1", {10, 20}, {.size = kEm, .angle = std::numbers::pi_v<float> / 2});
  const std::vector<PlacedPath> placed = walk(result.drawing);
  ASSERT_EQ(placed.size(), 1U);
  EXPECT_EQ(transformed(placed[0].page_from_path, {0, 0}), glm::vec2(10, 20));
  EXPECT_EQ(transformed(placed[0].page_from_path, {100, 0}), glm::vec2(10, -80));
  EXPECT_EQ(transformed(placed[0].page_from_path, {0, -7}), glm::vec2(3, 20));
}

TEST(Text, HebrewRunsToTheLeft) {
  const Drawn both = drawn("\u05D0\u05D1");
  const Drawn alef = drawn("\u05D0");
  const float shift = measure_text("\u05D1", {.size = kEm}).width;
  const auto last = both.view().points.last(alef.view().points.size());
  for (std::size_t i = 0; i < last.size(); ++i) {
    EXPECT_EQ(last[i], alef.view().points[i] + glm::vec2(shift, 0)) << "the first letter is on the right, point " << i;
  }
}

TEST(Text, ArabicLettersAreJoined) {
  // Joined, the middle one has another form than alone.
  const auto width = [](std::string_view text) { return measure_text(text, {.size = kEm}).width; };
  EXPECT_NE(width("\u0628\u0628\u0628"), 3 * width("\u0628"));
}

TEST(Text, WhatTheFontLacksIsABoxAndOneWarning) {
  const Drawn result = drawn("a\U00012000b\U00012001");
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_EQ(result.warnings[0], "text: DejaVu Sans has no glyph for U+12000: a box stands for it");
  EXPECT_GT(result.view().commands.size(), drawn("ab").view().commands.size());
}

TEST(Text, BytesThatAreNoUtf8AreReplaced) {
  EXPECT_EQ(drawn_text("a\xFFz"), "a\uFFFDz");
  EXPECT_EQ(drawn_text("\xC0\x80"), "\uFFFD\uFFFD");            // longer than need be
  EXPECT_EQ(drawn_text("\xED\xA0\x80"), "\uFFFD\uFFFD\uFFFD");  // a surrogate
  EXPECT_EQ(drawn_text("\xF4\x90\x80\x80").size(), 4 * 3U);     // beyond U+10FFFF
  EXPECT_EQ(drawn_text("\xE2\x82"), "\uFFFD\uFFFD");            // cut
  EXPECT_EQ(drawn_text("a\nb\tc\x7F\u0085\u2028"), "a b c   ");
  EXPECT_EQ(drawn_text("1 \u20AC \U0001D400"), "1 \u20AC \U0001D400");
  EXPECT_EQ(drawn_text(std::string_view("\0", 1)), " ");
}

TEST(Text, AnyBytesGiveAValidLine) {
  std::mt19937 random(7);
  for (int i = 0; i < 2000; ++i) {
    std::string bytes(random() % 40, ' ');
    for (char& byte : bytes) byte = static_cast<char>(random() & 255);
    const Drawn result = drawn(bytes);
    EXPECT_EQ(drawn_text(result.text().text), result.text().text) << "round " << i;
    EXPECT_TRUE(std::isfinite(measure_text(bytes).width));
  }
}

TEST(Text, LongTextIsCutAndSaysSo) {
  std::string text;
  for (int i = 0; i < 2000; ++i) text += "a\u20AC";  // 4 bytes each
  const std::string cut = drawn_text(text);
  EXPECT_LE(cut.size(), kLongestText);
  EXPECT_GT(cut.size(), kLongestText - 8);
  EXPECT_EQ(cut.substr(cut.size() - 3), "\u2026");
  EXPECT_EQ(drawn_text(cut), cut);
  EXPECT_EQ(drawn_text(text.substr(0, kLongestText)).size(), kLongestText);
}

TEST(Text, RefusesWhatIsNoSize) {
  Drawing drawing;
  const std::uint32_t style = drawing.add_style({});
  EXPECT_THROW(add_text(drawing, "a", {0, 0}, {.size = -1}, style), Error);
  EXPECT_THROW(add_text(drawing, "a", {0, 0}, {.size = NAN}, style), Error);
  EXPECT_THROW(add_text(drawing, "a", {0, 0}, {.angle = INFINITY}, style), Error);
  EXPECT_THROW(add_text(drawing, "a", {NAN, 0}, {}, style), Error);
  EXPECT_TRUE(drawing.paths.empty());
}

}  // namespace
}  // namespace azulejo
