#include "azulejo/imaging/gamma.h"

#include "azulejo/core/error.h"
#include "azulejo/imaging/tone_testing.h"

namespace azulejo {
namespace {

PointOperation with(float exponent) {
  return [exponent](const Image& source) { return gamma(source, {.gamma = exponent}); };
}

double power(double v, float exponent) {
  return std::copysign(std::pow(std::abs(v), static_cast<double>(exponent)), v);
}

TEST(Gamma, IsThePower) {
  for (const float exponent : {0.01F, 1.0F / 2.4F, 0.5F, 1.0F, 1.7F, 2.2F, 25.0F}) {
    const auto exact = [&](double v) { return power(v, exponent); };
    expect_rounded(with(exponent), exact, PixelType::U8, 1e-3);
    // log2 is off by 3·10⁻⁷ (1 + |log2 v|) and what follows by a little more: times the derivative of the power, which
    // is steepest where the result is 1/e, less than 0.07 of 65535.
    expect_rounded(with(exponent), exact, PixelType::U16, 0.07);
  }
}

TEST(Gamma, OfFloatsGoesOnBeyondOneAndBelowZero) {
  for (const float exponent : {0.5F, 2.2F}) {
    // |log2| of the results is below 35.
    expect_real(
        with(exponent), [&](double v) { return power(v, exponent); }, 0, 36e-6);
  }
  EXPECT_EQ(of_one(with(2.2F), 0), 0.0F);
  EXPECT_EQ(of_one(with(2.2F), 1), 1.0F);
  EXPECT_EQ(of_one(with(0.5F), kInfinity), kInfinity);
  EXPECT_TRUE(std::isnan(of_one(with(0.5F), kNaN)));
}

TEST(Gamma, OfTheInverseGoesBack) {
  const Image source = every_value(PixelType::U16);
  const Image back = gamma(gamma(source, {.gamma = 0.5F}), {.gamma = 2});
  // The square root is off by half a level, so its square by its own size.
  for (int x = 0; x < 65536; ++x) EXPECT_NEAR(back.view<std::uint16_t>()(x, 0), x, 2 * std::sqrt(x / 65535.0) + 0.6);
}

TEST(Gamma, LeavesAlphaAlone) { expect_alpha_is_left_alone(with(0.7F)); }

TEST(Gamma, RefusesExponentsOutOfRange) {
  const Image source(1, 1, 1);
  EXPECT_THROW(gamma(source, {.gamma = 0}), Error);
  EXPECT_THROW(gamma(source, {.gamma = kNaN}), Error);
}

}  // namespace
}  // namespace azulejo
