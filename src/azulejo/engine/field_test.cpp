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
