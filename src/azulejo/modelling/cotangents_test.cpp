#include "azulejo/modelling/cotangents.h"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "azulejo/math/arctangent.h"

namespace azulejo {
namespace {

TEST(Cotangents, GiveTheirAnglesInEveryVectorTarget) {
  std::mt19937 random(2);
  std::normal_distribution<float> number(0, 3);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    for (std::size_t count = 0; count <= 33; ++count) {
      std::vector<float> values(count + 1, 7);
      for (std::size_t i = 0; i < count; ++i) values[i] = number(random);
      if (count > 2) values[2] = std::numeric_limits<float>::infinity();
      if (count > 3) values[3] = -1e30F;
      std::vector<float> angles = values;
      kernels::angles_of_cotangents(angles.data(), count);
      for (std::size_t i = 0; i < count; ++i) {
        EXPECT_EQ(angles[i], atan2_deterministic(1, values[i]));
        EXPECT_NEAR(angles[i], std::atan2(1.0F, values[i]), 1e-6F);
      }
      EXPECT_EQ(angles[count], 7);
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace
}  // namespace azulejo
