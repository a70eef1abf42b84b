#include "azulejo/math/turns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace azulejo {
namespace {

TEST(Turns, AreCosineAndSine) {
  for (const int whole : {1, 2, 3, 4, 7, 8, 12, 1000, 1999}) {
    for (int part = -whole; part <= 2 * whole; ++part) {
      const Turn turn = turn_of(part, whole);
      const double angle = 2 * std::numbers::pi * part / whole;
      ASSERT_NEAR(turn.cosine, std::cos(angle), 4e-15);
      ASSERT_NEAR(turn.sine, std::sin(angle), 4e-15);
    }
  }
  EXPECT_EQ(turn_of(1, 4).cosine, 0.0);
  EXPECT_EQ(turn_of(3, 6).cosine, -1.0);
}

TEST(Turns, AreTakenAtAnyPlace) {
  for (const double turns : {0.0, 0.1, -0.3, 0.123456789, 7.7, -1000.25}) {
    EXPECT_NEAR(turn_at(turns).cosine, std::cos(2 * std::numbers::pi * turns), 2e-12);
    EXPECT_NEAR(turn_at(turns).sine, std::sin(2 * std::numbers::pi * turns), 2e-12);
  }
  EXPECT_EQ(turn_at(-0.25).sine, -1.0);
  EXPECT_EQ(turn_at(1.5).sine, 0.0);
}

}  // namespace
}  // namespace azulejo
