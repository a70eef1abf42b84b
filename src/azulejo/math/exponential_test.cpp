#include "azulejo/math/exponential.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace azulejo {
namespace {

TEST(Exponential, IsWithinItsBoundOfTheLibrarys) {
  double worst = 0;
  for (int i = -700000; i <= 700000; i += 7) {
    const double x = i / 1000.0;
    const auto exact = static_cast<double>(std::exp(static_cast<long double>(x)));
    worst = std::max(worst, std::abs(exp_deterministic(x) / exact - 1));
  }
  EXPECT_LT(worst, 1e-15);
}

TEST(Exponential, OfSpecialValues) {
  EXPECT_EQ(exp_deterministic(0), 1);
  EXPECT_EQ(exp_deterministic(-std::numeric_limits<double>::infinity()), 0);
  EXPECT_EQ(exp_deterministic(-1e300), 0);
  EXPECT_TRUE(std::isnan(exp_deterministic(std::nan(""))));
}

}  // namespace
}  // namespace azulejo
