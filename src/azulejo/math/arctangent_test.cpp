#include "azulejo/math/arctangent.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace azulejo {
namespace {

TEST(Arctangent, IsWithinItsBoundOfTheLibrarys) {
  double worst = 0;
  for (int i = 0; i <= 1000000; ++i) {
    const double angle = (i / 500000.0 - 1) * std::numbers::pi;
    const auto x = static_cast<float>(3 * std::cos(angle));
    const auto y = static_cast<float>(3 * std::sin(angle));
    worst = std::max(worst, std::abs(double{atan2_deterministic(y, x)} - std::atan2(double{y}, double{x})));
  }
  EXPECT_LT(worst, 4e-7);
}

TEST(Arctangent, IsOddAndHalfATurnFurtherForTheOppositeDirection) {
  const unsigned seed = 11;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(-5, 5);
  for (int i = 0; i < 10000; ++i) {
    const float x = value(random);
    const float y = value(random);
    EXPECT_EQ(atan2_deterministic(-y, x), -atan2_deterministic(y, x));
    EXPECT_NEAR(std::abs(atan2_deterministic(-y, -x) - atan2_deterministic(y, x)), std::numbers::pi, 8e-7);
  }
}

TEST(Arctangent, OnTheAxesAndOfSpecialValues) {
  constexpr auto kPi = std::numbers::pi_v<float>;
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(atan2_deterministic(0, 0), 0);
  EXPECT_EQ(atan2_deterministic(-0.0F, -0.0F), 0);
  EXPECT_EQ(atan2_deterministic(0, 2), 0);
  EXPECT_EQ(atan2_deterministic(0, -2), kPi);
  EXPECT_EQ(atan2_deterministic(-0.0F, -2), kPi);
  EXPECT_EQ(atan2_deterministic(2, 0), kPi / 2);
  EXPECT_EQ(atan2_deterministic(-2, 0), -kPi / 2);
  EXPECT_EQ(atan2_deterministic(1, kInfinity), 0);
  EXPECT_TRUE(std::isnan(atan2_deterministic(kNaN, 1)));
  EXPECT_TRUE(std::isnan(atan2_deterministic(1, kNaN)));
  EXPECT_TRUE(std::isnan(atan2_deterministic(0, kNaN)));
}

}  // namespace
}  // namespace azulejo
