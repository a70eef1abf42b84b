#include "azulejo/imaging/kernel_response.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

NumberGrid average(int side) {
  return {side, side, std::vector<float>(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 1.0F)};
}

KernelResponse of(const NumberGrid& kernel, int size = 64, bool normalize = true) {
  KernelResponseOptions options;
  options.kernel = kernel;
  options.size = size;
  options.normalize = normalize;
  return kernel_response(options);
}

/// |H(f)| of n equal weights is |sin(πnf) / (n sin(πf))|.
double average_response(int n, double f) {
  return std::fabs(f == 0 ? 1 : std::sin(std::numbers::pi * n * f) / (n * std::sin(std::numbers::pi * f)));
}

TEST(KernelResponse, OfAnAverageIsDirichletsKernel) {
  const KernelResponse response = of(average(5));
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const double expected = average_response(5, (x - 32) / 64.0) * average_response(5, (y - 32) / 64.0);
      ASSERT_NEAR(response.picture.view<std::uint8_t>()(x, y), 255 * expected, 0.5001) << x << ", " << y;
    }
  }
  EXPECT_DOUBLE_EQ(response.at_zero, 1);
  EXPECT_NEAR(response.at_nyquist_x, 0.2, 1e-12);
  EXPECT_NEAR(response.largest, 1, 1e-12);
  EXPECT_TRUE(response.separable);
}

/// (1 + 2 cos 2πf) / 3 = 1/√2.
TEST(KernelResponse, FindsTheCutOff) {
  const double exact = std::acos((3 * std::sqrt(0.5) - 1) / 2) / (2 * std::numbers::pi);
  const KernelResponse response = of(average(3));
  ASSERT_TRUE(response.cutoff_x && response.cutoff_y);
  EXPECT_NEAR(*response.cutoff_x, exact, 1e-9);
  EXPECT_NEAR(*response.cutoff_y, exact, 1e-9);
  // [1 2 1] / 4 is cos² πf.
  EXPECT_NEAR(*of({1, 3, {1, 2, 1}}).cutoff_x, std::acos(std::pow(0.5, 0.25)) / std::numbers::pi, 1e-9);
  EXPECT_FALSE(of({1, 3, {1, 2, 1}}).cutoff_y);  // nothing is lost downwards
}

TEST(KernelResponse, OfAnAverageFallsWithItsSize) {
  double last = 1;
  for (int side = 2; side <= 31; ++side) {
    const KernelResponse response = of(average(side), 16);
    ASSERT_TRUE(response.cutoff_x);
    EXPECT_LT(*response.cutoff_x, last) << side;
    last = *response.cutoff_x;
  }
}

TEST(KernelResponse, OfTheLaplacianIsZeroAtZero) {
  const KernelResponse response = of({3, 3, {0, 1, 0, 1, -4, 1, 0, 1, 0}});
  EXPECT_EQ(response.at_zero, 0);
  EXPECT_FALSE(response.cutoff_x);
  EXPECT_FALSE(response.separable);
  EXPECT_EQ(response.picture.view<std::uint8_t>()(32, 32), 0);
  EXPECT_EQ(response.picture.view<std::uint8_t>()(0, 0), 255);
  EXPECT_NEAR(response.largest, 8, 1e-12);
  EXPECT_NEAR(response.at_nyquist_x, 4, 1e-12);
  EXPECT_NE(to_json(response).dump(-1).find("\"cutoff_x\":null"), std::string::npos) << to_json(response).dump(-1);
}

TEST(KernelResponse, IsOfTheWeightsAsTheyAreOnRequest) {
  EXPECT_NEAR(of({1, 2, {3, 4}}, 16, false).at_zero, 7, 1e-12);
  EXPECT_NEAR(of({1, 2, {3, 4}}, 16, true).at_zero, 1, 1e-12);
}

TEST(KernelResponse, RefusesWhatIsNoKernel) {
  EXPECT_THROW(of({}), Error);
  EXPECT_THROW(of({1, 256, std::vector<float>(256, 1.0F)}), Error);
  EXPECT_THROW(of(average(3), 8), Error);
}

}  // namespace
}  // namespace azulejo
