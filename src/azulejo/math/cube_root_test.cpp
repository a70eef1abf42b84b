#include "azulejo/math/cube_root.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace azulejo {
namespace {

TEST(CubeRoot, IsWithinItsBoundOfTheLibrarys) {
  // Every 97th float of three octaves, where the method repeats itself, and of all octaves a few.
  const auto error = [](float x) { return std::abs(double{cbrt_deterministic(x)} / std::cbrt(double{x}) - 1); };
  double worst = 0;
  for (std::int32_t bits = 0x3F800000; bits < 0x41000000; bits += 97) {
    worst = std::max(worst, error(std::bit_cast<float>(bits)));
  }
  for (std::int32_t bits = 0x00800000; bits < 0x7F800000; bits += 99'991) {
    worst = std::max(worst, error(std::bit_cast<float>(bits)));
  }
  EXPECT_LT(worst, 2e-7);
}

TEST(CubeRoot, OfEighthsAndOfThousands) {
  EXPECT_FLOAT_EQ(cbrt_deterministic(1), 1);
  EXPECT_FLOAT_EQ(cbrt_deterministic(0.125F), 0.5F);
  EXPECT_FLOAT_EQ(cbrt_deterministic(1e30F), 1e10F);
  EXPECT_FLOAT_EQ(cbrt_deterministic(std::numeric_limits<float>::min()), 2.2737368e-13F);
}

}  // namespace
}  // namespace azulejo
