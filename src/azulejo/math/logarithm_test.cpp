#include "azulejo/math/logarithm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace azulejo {
namespace {

TEST(Logarithm, IsWithinItsBound) {
  for (double x = 1e-300; x < 1e300; x *= 1.37) {
    ASSERT_NEAR(log_deterministic(x), std::log(x), 1e-15 * std::max(1.0, std::fabs(std::log(x)))) << x;
  }
  for (double x = 0.5; x < 2.1; x += 0.0007) ASSERT_NEAR(log_deterministic(x), std::log(x), 1e-15) << x;
  EXPECT_EQ(log_deterministic(1), 0.0);
}

}  // namespace
}  // namespace azulejo
