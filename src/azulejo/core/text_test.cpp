#include "azulejo/core/text.h"

#include <gtest/gtest.h>

namespace azulejo {
namespace {

const std::vector<std::string> kNames = {"blend", "equalize", "gaussian", "grayscale", "resize", "sobel", "threshold"};

TEST(Text, FindsTheNameThatWasMeant) {
  EXPECT_EQ(closest("gausian", kNames), "gaussian");
  EXPECT_EQ(closest("gaussain", kNames), "gaussian");
  EXPECT_EQ(closest("treshold", kNames), "threshold");
  EXPECT_EQ(closest("gauss", kNames), "gaussian");
  EXPECT_EQ(closest("soble", kNames), "sobel");
}

TEST(Text, OffersNothingFarAway) {
  EXPECT_EQ(closest("dilate", kNames), "");
  EXPECT_EQ(closest("", kNames), "");
  EXPECT_EQ(closest("x", kNames), "");
  EXPECT_EQ(did_you_mean("dilate", kNames), "");
  EXPECT_EQ(did_you_mean("soble", kNames), " (did you mean sobel?)");
}

}  // namespace
}  // namespace azulejo
