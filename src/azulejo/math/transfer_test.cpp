#include "azulejo/math/transfer.h"

#include <limits>

#include <gtest/gtest.h>

namespace azulejo {
namespace {

double exact_linear(double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); }
double exact_srgb(double x) { return x <= 0.0031308 ? x * 12.92 : 1.055 * std::pow(x, 1 / 2.4) - 0.055; }

TEST(Transfer, IsWithinAMillionthOfTheDefinition) {
  for (int i = 0; i <= 400'000; ++i) {
    const float x = static_cast<float>(i) / 100'000.0F;
    EXPECT_NEAR(srgb_to_linear(x), exact_linear(static_cast<double>(x)),
                1e-6 * exact_linear(static_cast<double>(x)) + 1e-9)
        << x;
    EXPECT_NEAR(linear_to_srgb(x), exact_srgb(static_cast<double>(x)), 1e-6 * exact_srgb(static_cast<double>(x)) + 1e-9)
        << x;
  }
}

TEST(Transfer, EndsStayEnds) {
  EXPECT_EQ(srgb_to_linear(0.0F), 0.0F);
  EXPECT_NEAR(srgb_to_linear(1.0F), 1.0F, 2e-7F);
  EXPECT_NEAR(linear_to_srgb(1.0F), 1.0F, 2e-7F);
}

TEST(Transfer, IsOddAndPassesNaN) {
  EXPECT_EQ(srgb_to_linear(-0.5F), -srgb_to_linear(0.5F));
  EXPECT_EQ(linear_to_srgb(-0.5F), -linear_to_srgb(0.5F));
  EXPECT_TRUE(std::isnan(srgb_to_linear(std::numeric_limits<float>::quiet_NaN())));
  EXPECT_TRUE(std::isnan(linear_to_srgb(std::numeric_limits<float>::quiet_NaN())));
}

TEST(Transfer, SixteenBitsSurviveThereAndBack) {
  for (int i = 0; i < 65536; ++i) {
    const float encoded = linear_to_srgb(srgb_to_linear(static_cast<float>(i) / 65535.0F)) * 65535.0F;
    EXPECT_EQ(static_cast<int>(std::lround(encoded)), i);
  }
}

TEST(Power, IsWithinItsBoundOfTheLibrarys) {
  for (const float exponent : {0.01F, 0.45F, 0.5F, 1.0F, 2.0F, 2.2F, 7.3F, 100.0F}) {
    for (int i = -400; i <= 400; ++i) {
      const float x = std::exp2(static_cast<float>(i) / 13.0F);
      const double exact = std::pow(static_cast<double>(x), static_cast<double>(exponent));
      if (exact < 3e-38 || exact > 2e38) continue;
      EXPECT_NEAR(power_deterministic(x, exponent), exact, 1e-6 * (1 + std::abs(std::log2(exact))) * exact)
          << x << " ^ " << exponent;
    }
  }
}

TEST(Power, OfSpecialValues) {
  const float infinity = std::numeric_limits<float>::infinity();
  for (const float exponent : {0.01F, 0.5F, 2.2F, 100.0F}) {
    EXPECT_EQ(power_deterministic(0.0F, exponent), 0.0F);
    EXPECT_EQ(power_deterministic(1.0F, exponent), 1.0F);
    EXPECT_EQ(power_deterministic(1e-39F, exponent), 0.0F);
    EXPECT_EQ(power_deterministic(infinity, exponent), infinity);
    EXPECT_TRUE(std::isnan(power_deterministic(std::numeric_limits<float>::quiet_NaN(), exponent)));
  }
  EXPECT_EQ(power_deterministic(1e-30F, 2), 0.0F);
  EXPECT_GT(power_deterministic(1e30F, 2), 2e38F);
}

}  // namespace
}  // namespace azulejo
