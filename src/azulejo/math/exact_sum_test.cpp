#include "azulejo/math/exact_sum.h"

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace azulejo {
namespace {

TEST(ExactSum, DoesNotDependOnTheOrder) {
  std::mt19937 random(5);
  std::vector<float> values;
  for (int i = 0; i < 10'000; ++i) {
    values.push_back(
        std::ldexp(std::uniform_real_distribution<float>(-1, 1)(random), static_cast<int>(random() % 60) - 30));
  }
  ExactSum forwards;
  for (const float value : values) forwards.add(value);
  std::shuffle(values.begin(), values.end(), random);
  ExactSum first;
  ExactSum second;
  long double expected = 0;
  long double magnitude = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    (i % 3 == 0 ? first : second).add(values[i]);
    expected += values[i];
    magnitude += std::fabs(values[i]);
  }
  first.merge(second);
  EXPECT_EQ(forwards.value(), first.value());
  EXPECT_NEAR(forwards.value(), static_cast<double>(expected), static_cast<double>(magnitude) * 1e-14);
}

TEST(ExactSum, KeepsWhatCancels) {
  ExactSum sum;
  for (const float value : {3e38F, 1e-45F, -3e38F, 2e-45F, 1.5F}) sum.add(value);
  EXPECT_EQ(sum.value(), 1.5);
  ExactSum tiny;
  for (const float value : {3e38F, 1e-45F, -3e38F}) tiny.add(value);
  EXPECT_EQ(tiny.value(), static_cast<double>(1e-45F));
}

TEST(ExactSum, LeavesOutWhatIsNoNumber) {
  ExactSum sum;
  for (const float value : {1.0F, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    sum.add(value);
  }
  EXPECT_EQ(sum.value(), 1);
}

}  // namespace
}  // namespace azulejo
