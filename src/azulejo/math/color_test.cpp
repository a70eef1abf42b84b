#include "azulejo/math/color.h"

#include <gtest/gtest.h>

namespace azulejo {
namespace {

TEST(Color, IsReadFromEveryNotation) {
  EXPECT_EQ(parse_color("#ff8000"), (Color{1, 128 / 255.0F, 0, 1}));
  EXPECT_EQ(parse_color("#FF800040"), (Color{1, 128 / 255.0F, 0, 64 / 255.0F}));
  EXPECT_EQ(parse_color("#f80"), (Color{1, 136 / 255.0F, 0, 1}));
  EXPECT_EQ(parse_color("#f808"), (Color{1, 136 / 255.0F, 0, 136 / 255.0F}));
  EXPECT_EQ(parse_color("0.25"), (Color{0.25F, 0.25F, 0.25F, 1}));
  EXPECT_EQ(parse_color("1"), (Color{1, 1, 1, 1}));
  EXPECT_EQ(parse_color("transparent"), (Color{0, 0, 0, 0}));
}

TEST(Color, KnowsTheNamesOfCss) {
  // The first, the last, one named after a person, and one of the two spellings that CSS has for each gray.
  EXPECT_EQ(to_string(*parse_color("aliceblue")), "#f0f8ff");
  EXPECT_EQ(to_string(*parse_color("YellowGreen")), "#9acd32");
  EXPECT_EQ(to_string(*parse_color("RebeccaPurple")), "#663399");
  EXPECT_EQ(parse_color("lightslategrey"), parse_color("lightslategray"));
  EXPECT_EQ(to_string(*parse_color("green")), "#008000");
}

TEST(Color, RefusesOtherText) {
  for (const char* text : {"", "#", "#12", "#12345", "#1234567", "#123456789", "#ggg", "#-12345", "1.01", "-0.1", "nan",
                           "0.5x", "ffffff", "blueish", "#ff 000"}) {
    EXPECT_FALSE(parse_color(text).has_value()) << text;
  }
}

TEST(Color, ReadsWhatItPrints) {
  EXPECT_EQ(to_string({1, 1, 1, 1}), "#ffffff");
  EXPECT_EQ(to_string({0, 0, 0, 0}), "#00000000");
  EXPECT_EQ(to_string({0.5F, 0.5F, 0.5F, 1}), "0.5");
  EXPECT_EQ(to_string({0.1F, 0.5F, 0.5F, 1}), "#1a8080");
  for (int byte = 0; byte < 256; ++byte) {
    const float value = static_cast<float>(byte) / 255.0F;
    const Color color{value, 1 - value, 0, value};
    EXPECT_EQ(to_string(*parse_color(to_string(color))), to_string(color));
  }
}

TEST(Color, BecomesLight) {
  const auto light = to_linear({0, 1, 188 / 255.0F, 0.5F});
  EXPECT_EQ(light[0], 0);
  EXPECT_NEAR(light[1], 1, 1e-6);
  EXPECT_NEAR(light[2], 0.5029, 1e-4);  // ((188/255 + 0.055)/1.055)^2.4
  EXPECT_EQ(light[3], 0.5F);
}

}  // namespace
}  // namespace azulejo
