#include "azulejo/engine/field.h"

#include <gtest/gtest.h>

#include "azulejo/core/error.h"
#include "azulejo/engine/border.h"

namespace azulejo {
namespace {

struct Options {
  float sigma = 1.5F;
  int count = 3;
  bool fast = false;
  Border border = Border::Clamp;
  std::optional<int> width;
  std::string path = "a";
};

const Field kSigma = field("sigma", &Options::sigma, {0, 10}, "px", "width");
const Field kCount = field("count", &Options::count, {1, 5}, "", "how many");
const Field kFast = field("fast", &Options::fast, "hurry");
const Field kBorder = field("border", &Options::border, "outside");
const Field kWidth = field("width", &Options::width, {1, 100}, "px", "of the result");
const Field kPath = field("path", &Options::path, "a file");

std::string refusal(const Field& each, std::string_view text) {
  Options options;
  try {
    each.parse(&options, text);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Error::Argument);
    return error.what();
  }
  return "taken: " + each.print(&options);
}

TEST(Field, ReadsAndPrintsEveryType) {
  Options options;
  kSigma.parse(&options, "2.25");
  kCount.parse(&options, "+4");
  kFast.parse(&options, "true");
  kBorder.parse(&options, "wrap");
  kWidth.parse(&options, "64");
  kPath.parse(&options, "b c");
  EXPECT_EQ(options.sigma, 2.25F);
  EXPECT_EQ(options.count, 4);
  EXPECT_TRUE(options.fast);
  EXPECT_EQ(options.border, Border::Wrap);
  EXPECT_EQ(options.width, 64);
  EXPECT_EQ(options.path, "b c");
  EXPECT_EQ(kSigma.print(&options), "2.25");
  EXPECT_EQ(kBorder.print(&options), "wrap");
  kWidth.parse(&options, "auto");
  EXPECT_FALSE(options.width.has_value());
  EXPECT_EQ(kWidth.print(&options), "auto");
}

TEST(Field, RefusesInOneLineThatSaysWhatWasExpected) {
  EXPECT_EQ(refusal(kSigma, "abc"), "sigma: \"abc\", expected a number from 0 to 10 px");
  EXPECT_EQ(refusal(kSigma, "11"), "sigma: 11, expected a number from 0 to 10 px");
  EXPECT_EQ(refusal(kSigma, "nan"), "sigma: nan, expected a number from 0 to 10 px");
  EXPECT_EQ(refusal(kSigma, "1e99"), "sigma: \"1e99\", expected a number from 0 to 10 px");
  EXPECT_EQ(refusal(kCount, "2.5"), "count: \"2.5\", expected a whole number from 1 to 5");
  EXPECT_EQ(refusal(kCount, "99999999999999999999"),
            "count: \"99999999999999999999\", expected a whole number from 1 to 5");
  EXPECT_EQ(refusal(kFast, "maybe"), "fast: \"maybe\", expected true or false");
  EXPECT_EQ(refusal(kBorder, "warp"), "border: \"warp\", expected mirror, reflect, clamp, wrap or constant");
  EXPECT_EQ(refusal(kWidth, "0"), "width: 0, expected a whole number from 1 to 100 px, or auto");
}

struct MoreOptions {
  Color background{1, 1, 1, 1};
  std::optional<Color> edge;
  glm::vec3 position{1, 2.5F, -3};
  std::optional<glm::vec2> center;
  std::array<float, 4> weights{0, 0, 0, 1};
  std::vector<std::string> layers{"color"};
  std::vector<int> sizes;
  std::vector<float> levels{0.5F, 1};
  std::optional<std::vector<Border>> borders;
};

const Field kBackground = field("background", &MoreOptions::background, "behind all");
const Field kEdge = field("edge", &MoreOptions::edge, "of lines");
const Field kPosition = field("position", &MoreOptions::position, {-9, 9}, "mm", "where");
const Field kCenter = field("center", &MoreOptions::center, "middle");
const Field kWeights = field("weights", &MoreOptions::weights, "how much");
const Field kLayers = field("layers", &MoreOptions::layers, "what is kept");
const Field kSizes = field("sizes", &MoreOptions::sizes, {1, 64}, "px", "of each");
const Field kLevels = field("levels", &MoreOptions::levels, {0, 1}, "", "of each");
const Field kBorders = field("borders", &MoreOptions::borders, "outside");

/// What is printed after `text` was read.
std::string read_back(const Field& each, std::string_view text) {
  MoreOptions options;
  try {
    each.parse(&options, text);
  } catch (const Error& error) {
    return error.what();
  }
  return each.print(&options);
}

TEST(Field, ReadsColorsPointsAndLists) {
  MoreOptions options;
  kBackground.parse(&options, "orange");
  kPosition.parse(&options, "0.5,-2,+9");
  kCenter.parse(&options, "3,4");
  kWeights.parse(&options, "1,2,3,4");
  kLayers.parse(&options, "depth,normal");
  kSizes.parse(&options, "16,32,64");
  kBorders.parse(&options, "wrap,mirror");
  EXPECT_EQ(options.background, (Color{1, 165 / 255.0F, 0, 1}));
  EXPECT_EQ(options.position, glm::vec3(0.5F, -2, 9));
  EXPECT_EQ(options.center, glm::vec2(3, 4));
  EXPECT_EQ(options.weights, (std::array<float, 4>{1, 2, 3, 4}));
  EXPECT_EQ(options.layers, (std::vector<std::string>{"depth", "normal"}));
  EXPECT_EQ(options.sizes, (std::vector<int>{16, 32, 64}));
  EXPECT_EQ(options.borders, (std::vector{Border::Wrap, Border::Mirror}));
  kLayers.parse(&options, "none");
  EXPECT_TRUE(options.layers.empty());
  EXPECT_EQ(kEdge.type, FieldType::Color);
  EXPECT_TRUE(kEdge.optional);
  EXPECT_EQ(kBorders.choices.size(), 5U);
  EXPECT_TRUE(kBorders.list);
  EXPECT_EQ(kPosition.components, 3);
}

TEST(Field, PrintsWhatItReads) {
  MoreOptions defaults;
  const std::pair<const Field*, const char*> cases[] = {
      {&kBackground, "#ffffff"}, {&kEdge, "auto"},       {&kPosition, "1,2.5,-3"},
      {&kCenter, "auto"},        {&kWeights, "0,0,0,1"}, {&kLayers, "color"},
      {&kSizes, "none"},         {&kLevels, "0.5,1"},    {&kBorders, "auto"}};
  for (const auto& [each, text] : cases) {
    EXPECT_EQ(each->print(&defaults), text);
    EXPECT_EQ(read_back(*each, text), text);
  }
  EXPECT_EQ(read_back(kBorders, "clamp,wrap"), "clamp,wrap");
}

TEST(Field, RefusesColorsPointsAndListsInOneLine) {
  EXPECT_EQ(read_back(kBackground, "#12"),
            "background: \"#12\", expected #rrggbb, #rrggbbaa, a CSS color name or a gray from 0 to 1");
  EXPECT_EQ(read_back(kPosition, "1,2"), "position: \"1,2\", expected x,y,z from -9 to 9 mm");
  EXPECT_EQ(read_back(kPosition, "1,2,10"), "position: 10, expected x,y,z from -9 to 9 mm");
  EXPECT_EQ(read_back(kPosition, "1,2,3,4"), "position: \"1,2,3,4\", expected x,y,z from -9 to 9 mm");
  EXPECT_EQ(read_back(kCenter, "1;2"), "center: \"1;2\", expected x,y, or auto");
  EXPECT_EQ(read_back(kSizes, "16,65"),
            "sizes: 65, expected a whole number from 1 to 64 px, several with commas between, or none");
  EXPECT_EQ(read_back(kLayers, "color,"), "layers: \"color,\", expected text, several with commas between, or none");
  EXPECT_EQ(read_back(kBorders, "wrap,warp"),
            "borders: \"warp\", expected mirror, reflect, clamp, wrap or constant, several with commas between, none, "
            "or auto");
}

TEST(Field, ChecksColorsPointsAndLists) {
  MoreOptions options;
  for (const Field* each : {&kBackground, &kEdge, &kPosition, &kSizes, &kBorders})
    EXPECT_NO_THROW(each->check(&options));
  options.background.a = 1.5F;
  EXPECT_THROW(kBackground.check(&options), Error);
  options.edge = Color{0, std::numeric_limits<float>::quiet_NaN(), 0, 1};
  EXPECT_THROW(kEdge.check(&options), Error);
  options.position.z = 10;
  EXPECT_THROW(kPosition.check(&options), Error);
  options.sizes = {1, 2, 0};
  EXPECT_THROW(kSizes.check(&options), Error);
  options.borders = {Border::Wrap, static_cast<Border>(9)};
  EXPECT_THROW(kBorders.check(&options), Error);
}

struct GridOptions {
  NumberGrid kernel{1, 1, {1}};
};

TEST(Field, ReadsRowsOfNumbers) {
  const Field kernel = field("kernel", &GridOptions::kernel, {-9, 9}, "", "weights");
  GridOptions options;
  kernel.parse(&options, "1,2,1/-2.5,4,2");
  EXPECT_EQ(options.kernel, (NumberGrid{2, 3, {1, 2, 1, -2.5F, 4, 2}}));
  EXPECT_EQ(options.kernel(1, 0), -2.5F);
  EXPECT_EQ(kernel.print(&options), "1,2,1/-2.5,4,2");
  for (const char* bad : {"", "/", "1,2/3", "1,/2,3", "1 2", "10", "nan", "1/"}) {
    EXPECT_THROW(kernel.parse(&options, bad), Error) << bad;
  }
  EXPECT_NO_THROW(kernel.check(&options));
  options.kernel.rows = 3;
  EXPECT_THROW(kernel.check(&options), Error);
  options.kernel = {1, 1, {10}};
  EXPECT_THROW(kernel.check(&options), Error);
}

TEST(Field, TakesTheEndsOfItsRange) {
  // 0.7F is a little below 0.7.
  const Field narrow = field("sigma", &Options::sigma, {0.7, 0.8}, "", "width");
  Options options;
  EXPECT_NO_THROW(narrow.parse(&options, "0.7"));
  EXPECT_NO_THROW(narrow.check(&options));
  EXPECT_NO_THROW(narrow.parse(&options, "0.8"));
  EXPECT_THROW(narrow.parse(&options, "0.6999"), Error);
}

TEST(Field, ChecksValuesSetInCode) {
  Options options;
  EXPECT_NO_THROW(kSigma.check(&options));
  options.sigma = -1;
  EXPECT_THROW(kSigma.check(&options), Error);
  options.sigma = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(kSigma.check(&options), Error);
  options.border = static_cast<Border>(9);
  EXPECT_THROW(kBorder.check(&options), Error);
  options.width = 101;
  EXPECT_THROW(kWidth.check(&options), Error);
}

}  // namespace
}  // namespace azulejo
