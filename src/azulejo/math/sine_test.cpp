#include "azulejo/math/sine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace azulejo {
namespace {

TEST(Sine, IsWithinItsBoundOfTheLibrarys) {
  double worst = 0;
  for (int i = -1'000'000; i <= 1'000'000; ++i) {
    const float turns = static_cast<float>(i) / 300'000.0F;
    const auto [sine, cosine] = sine_cosine_of_turns(turns);
    const double angle = 2 * std::numbers::pi * static_cast<double>(turns);
    worst = std::max({worst, std::abs(sine - std::sin(angle)), std::abs(cosine - std::cos(angle))});
  }
  EXPECT_LT(worst, 2e-7);
}

TEST(Sine, OfQuartersOfATurnIsExact) {
  const float sines[] = {0, 1, 0, -1};
  for (int quarter = -9; quarter <= 9; ++quarter) {
    const auto [sine, cosine] = sine_cosine_of_turns(0.25F * static_cast<float>(quarter));
    EXPECT_EQ(sine, sines[(quarter + 12) % 4]) << quarter;
    EXPECT_EQ(cosine, sines[(quarter + 13) % 4]) << quarter;
  }
}

}  // namespace
}  // namespace azulejo
