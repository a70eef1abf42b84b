#include "azulejo/io/svg_text.h"

#include <cfloat>
#include <cmath>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "azulejo/io/svg_color.h"
#include "azulejo/io/svg_output.h"

namespace azulejo {
namespace {

/// What is read at the front of `text`, and how many characters it takes; -1: nothing.
std::pair<double, int> number(const std::string& text) {
  double value = 0;
  const char* const behind = parse_svg_number(text.data(), text.data() + text.size(), value);
  return {value, behind == nullptr ? -1 : static_cast<int>(behind - text.data())};
}

using Read = std::pair<double, int>;

TEST(SvgNumber, EndsWhereTheGrammarSays) {
  EXPECT_EQ(number("1.5.5-3"), Read(1.5, 3));
  EXPECT_EQ(number(".5-3"), Read(0.5, 2));
  EXPECT_EQ(number("-3"), Read(-3, 2));
  EXPECT_EQ(number("+7x"), Read(7, 2));
  EXPECT_EQ(number("1."), Read(1, 2));
  EXPECT_EQ(number("1e2"), Read(100, 3));
  EXPECT_EQ(number("1E-2 "), Read(0.01, 4));
  EXPECT_EQ(number("1em"), Read(1, 1));
  EXPECT_EQ(number("1e+"), Read(1, 1));
  EXPECT_EQ(number("5d3"), Read(5, 1));
  for (const char* none : {"", "-", ".", "+.", "e5", "inf", "nan", "-e"}) EXPECT_EQ(number(none).second, -1) << none;
}

TEST(SvgNumber, AnySize) {
  EXPECT_EQ(number("1e400").second, -1);
  EXPECT_EQ(number("1e39").second, -1) << "beyond a float";
  EXPECT_EQ(number("1e-400"), Read(0, 6));
  EXPECT_EQ(number("123456789012345678901234567890").first, 123456789012345678901234567890.0);
  EXPECT_EQ(number("0.1000000000000000055511151231257827").first, 0.1);
  EXPECT_EQ(number("0." + std::string(1000, '0') + "1").first, 0);
  EXPECT_EQ(number("3.4028234663852886e38").first, static_cast<double>(FLT_MAX));
}

TEST(SvgNumber, WhatIsWrittenIsReadAgain) {
  std::mt19937 random(1);
  for (int i = 0; i < 100'000; ++i) {
    const float value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    if (!std::isfinite(value)) continue;
    std::string text;
    put_number(text, value);
    const auto [read, length] = number(text);
    ASSERT_EQ(length, static_cast<int>(text.size())) << text;
    ASSERT_EQ(static_cast<float>(read), value) << text;
  }
}

TEST(SvgNumber, WrittenShort) {
  const auto written = [](float value) {
    std::string text;
    put_number(text, value);
    return text;
  };
  EXPECT_EQ(written(0.5F), ".5");
  EXPECT_EQ(written(-0.25F), "-.25");
  EXPECT_EQ(written(-0.0F), "0");
  EXPECT_EQ(written(10), "10");
  EXPECT_EQ(written(NAN), "0");
}

TEST(SvgLength, UnitsAndPercent) {
  const auto pixels = [](const char* text) { return pixels_of(*parse_length(text), 200, 10); };
  EXPECT_DOUBLE_EQ(pixels(" 3 "), 3);
  EXPECT_DOUBLE_EQ(pixels("3px"), 3);
  EXPECT_DOUBLE_EQ(pixels("3pt"), 4);
  EXPECT_DOUBLE_EQ(pixels("1pc"), 16);
  EXPECT_DOUBLE_EQ(pixels("1in"), 96);
  EXPECT_DOUBLE_EQ(pixels("2.54cm"), 96);
  EXPECT_DOUBLE_EQ(pixels("25.4MM"), 96);
  EXPECT_DOUBLE_EQ(pixels("2em"), 20);
  EXPECT_DOUBLE_EQ(pixels("2ex"), 10);
  EXPECT_DOUBLE_EQ(pixels("25%"), 50);
  for (const char* none : {"", "auto", "3 px", "3furlong", "px"}) EXPECT_FALSE(parse_length(none)) << none;
}

TEST(SvgTransform, EachFunctionAndTheirOrder) {
  const auto at = [](const char* text, double x, double y) {
    const auto matrix = parse_transform(text);
    EXPECT_TRUE(matrix) << text;
    const glm::dmat3x2 m = matrix.value_or(glm::dmat3x2(0));
    return m[0] * x + m[1] * y + m[2];
  };
  EXPECT_EQ(at("", 1, 2), glm::dvec2(1, 2));
  EXPECT_EQ(at("translate(3)", 1, 2), glm::dvec2(4, 2));
  EXPECT_EQ(at("translate(3,4)", 1, 2), glm::dvec2(4, 6));
  EXPECT_EQ(at("scale(2)", 1, 2), glm::dvec2(2, 4));
  EXPECT_EQ(at("scale(2 -1)", 1, 2), glm::dvec2(2, -2));
  EXPECT_EQ(at("rotate(90)", 1, 2), glm::dvec2(-2, 1)) << "quarters are exact";
  EXPECT_EQ(at("rotate(-450)", 1, 2), glm::dvec2(2, -1));
  EXPECT_EQ(at("rotate(180 1 1)", 1, 2), glm::dvec2(1, 0));
  EXPECT_EQ(at("matrix(1 2 3 4 5 6)", 1, 2), glm::dvec2(12, 16));
  EXPECT_NEAR(at("skewX(45)", 1, 2).x, 3, 1e-15);
  EXPECT_NEAR(at("skewY(45)", 1, 2).y, 3, 1e-15);
  EXPECT_EQ(at(" translate( 1 , 0 ) ,\n scale(2) ", 1, 2), glm::dvec2(3, 4)) << "the last comes first";
  for (const char* none : {"rotate", "rotate(1", "rotate()", "spin(1)", "matrix(1 2 3)", "scale(a)", "scale(1) x"}) {
    EXPECT_FALSE(parse_transform(none)) << none;
  }
}

TEST(SvgReference, InTheFile) {
  const auto url = [](std::string_view text) { return std::string(take_url(text)); };
  EXPECT_EQ(url("url(#a)"), "a");
  EXPECT_EQ(url("url( '#a b' ) red"), "a b");
  EXPECT_EQ(url("URL(\"#a\")"), "a");
  EXPECT_EQ(url("red"), "");
  EXPECT_EQ(url("url(#a"), "");
  EXPECT_EQ(url("url(other.svg#a)"), "other.svg#a");
  EXPECT_EQ(fragment_of(" #x "), "x");
  EXPECT_EQ(fragment_of("other.svg#x"), "");
}

/// In 256ths, or "none".
std::string color(const char* text) {
  const std::optional<Color> color = parse_css_color(text);
  if (!color) return "none";
  const auto whole = [](float share) { return std::to_string(std::lround(share * 255)); };
  return whole(color->r) + " " + whole(color->g) + " " + whole(color->b) + " " + whole(color->a);
}

TEST(SvgColor, AllForms) {
  EXPECT_EQ(color("red"), "255 0 0 255");
  EXPECT_EQ(color(" LightGoldenrodYellow "), "250 250 210 255");
  EXPECT_EQ(color("#f80"), "255 136 0 255");
  EXPECT_EQ(color("#f808"), "255 136 0 136");
  EXPECT_EQ(color("#ff800080"), "255 128 0 128");
  EXPECT_EQ(color("rgb(255, 128,0)"), "255 128 0 255");
  EXPECT_EQ(color("rgb(100%,50%,0%)"), "255 128 0 255");
  EXPECT_EQ(color("RGB(300 -5 0 / 50%)"), "255 0 0 128");
  EXPECT_EQ(color("rgba(1,2,3,.5)"), "1 2 3 128");
  EXPECT_EQ(color("hsl(120, 100%, 50%)"), "0 255 0 255");
  EXPECT_EQ(color("hsl(-0.5turn 100% 25%)"), "0 128 128 255");
  EXPECT_EQ(color("hsla(0deg,0%,50%,0)"), "128 128 128 0");
  EXPECT_EQ(color("transparent"), "0 0 0 0");
  EXPECT_EQ(color("#f00 icc-color(x, 1)"), "255 0 0 255");
  for (const char* none : {"", "none", "currentColor", "0.5", "rgb(1,2)", "rgb(1,2,3", "hsl(a)", "#12345", "rgb"}) {
    EXPECT_EQ(color(none), "none") << none;
  }
}

}  // namespace
}  // namespace azulejo
