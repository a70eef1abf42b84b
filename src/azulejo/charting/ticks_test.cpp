#include "azulejo/charting/ticks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

using Labels = std::vector<std::string>;

Labels labels(double low, double high, int most = 6, AxisScale scale = AxisScale::Linear) {
  return make_ticks(low, high, scale, most).labels;
}

/// What a label says, with the minus of typesetters.
double number(const std::string& label, int exponent) {
  std::string text = label;
  if (text.starts_with("\u2212")) text.replace(0, 3, "-");
  return std::stod(text + "e" + std::to_string(exponent));
}

TEST(Ticks, AreTheRoundNumbersThatOneWouldWrite) {
  EXPECT_EQ(labels(0, 10), (Labels{"0", "2", "4", "6", "8", "10"}));
  EXPECT_EQ(labels(0, 1), (Labels{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
  EXPECT_EQ(labels(-1, 1, 5), (Labels{"\u22121.0", "\u22120.5", "0.0", "0.5", "1.0"}));
  EXPECT_EQ(labels(0, 255), (Labels{"0", "50", "100", "150", "200", "250"}));
  EXPECT_EQ(labels(0.013, 0.0171, 5), (Labels{"0.013", "0.014", "0.015", "0.016", "0.017"}));
  EXPECT_EQ(labels(1990, 2020, 4), (Labels{"1990", "2000", "2010", "2020"}));
}

TEST(Ticks, LargeAndSmallNumbersShareAPowerOfAThousand) {
  const Ticks large = make_ticks(0, 3.2e6, AxisScale::Linear, 8);
  EXPECT_EQ(large.exponent, 6);
  EXPECT_EQ(large.labels, (Labels{"0.0", "0.5", "1.0", "1.5", "2.0", "2.5", "3.0"}));
  const Ticks small = make_ticks(0, 4e-5, AxisScale::Linear, 5);
  EXPECT_EQ(small.exponent, -6);
  EXPECT_EQ(small.labels, (Labels{"0", "10", "20", "30", "40"}));
  EXPECT_EQ(make_ticks(0, 0.004, AxisScale::Linear, 5).exponent, 0);
  EXPECT_EQ(make_ticks(0, 200000, AxisScale::Linear, 5).exponent, 0);
}

TEST(Ticks, LogarithmicOnesArePowersOfTen) {
  EXPECT_EQ(labels(1, 1000, 5, AxisScale::Log), (Labels{"1", "10", "100", "1000"}));
  EXPECT_EQ(labels(0.01, 1, 5, AxisScale::Log), (Labels{"0.01", "0.1", "1"}));
  EXPECT_EQ(labels(1, 100, 8, AxisScale::Log), (Labels{"1", "2", "5", "10", "20", "50", "100"}));
  EXPECT_EQ(labels(1e-9, 1e3, 8, AxisScale::Log), (Labels{"10⁻⁸", "10⁻⁶", "10⁻⁴", "10⁻²", "10⁰", "10²"}));
  EXPECT_EQ(labels(3e6, 3e7, 8, AxisScale::Log), (Labels{"5×10⁶", "10⁷", "2×10⁷"}));
  EXPECT_EQ(labels(31, 39, 5, AxisScale::Log), (Labels{"32", "34", "36", "38"}));
  EXPECT_EQ(make_ticks(1, 1000, AxisScale::Log, 5).minor.size(), 3 * 8U);
}

TEST(Ticks, LabelsAreTheirValuesAndStepsAreRound) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 5000; ++i) {
    const double size = std::pow(10, 12 * unit(random));
    const double low = size * unit(random) * std::pow(10, 2 * unit(random));
    const double high = low + size * (0.01 + std::abs(unit(random)));
    const int most = 2 + static_cast<int>(random() % 12);
    SCOPED_TRACE(testing::Message() << "round " << i << ": " << low << " to " << high << ", " << most);
    const Ticks ticks = make_ticks(low, high, AxisScale::Linear, most);
    ASSERT_EQ(ticks.values.size(), ticks.labels.size());
    EXPECT_LE(ticks.values.size(), static_cast<std::size_t>(most));
    // The next smaller step, of at least 2/5, would give too many: (most + 1) of those fit but for both ends.
    if (most >= 5) {
      EXPECT_GE(ticks.values.size(), 2U);
      EXPECT_GE(static_cast<double>(ticks.values.size() + 1), (most - 1) * 0.4 - 1);
    }
    for (std::size_t k = 0; k < ticks.values.size(); ++k) {
      EXPECT_GE(ticks.values[k], low);
      EXPECT_LE(ticks.values[k], high);
      EXPECT_NEAR(number(ticks.labels[k], ticks.exponent), ticks.values[k], 1e-9 * (high - low));
      EXPECT_EQ(ticks.labels[k].find('.') == std::string::npos, ticks.labels[0].find('.') == std::string::npos);
      if (k == 0) continue;
      const double step = ticks.values[k] - ticks.values[k - 1];
      EXPECT_NEAR(step, ticks.values[1] - ticks.values[0], 1e-9 * (high - low) + 1e-12 * std::abs(low));
      const double mantissa = step / std::pow(10, std::floor(std::log10(step) + 1e-6));
      EXPECT_TRUE(std::abs(mantissa - 1) < 1e-3 || std::abs(mantissa - 2) < 1e-3 || std::abs(mantissa - 5) < 1e-3)
          << mantissa;
    }
  }
}

TEST(Ticks, LogarithmicOnesRiseWithinTheRange) {
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 3000; ++i) {
    const double low = std::pow(10, 40 * unit(random) - 20);
    const double high = low * std::pow(10, 0.01 + 25 * unit(random) * unit(random));
    const int most = 2 + static_cast<int>(random() % 9);
    SCOPED_TRACE(testing::Message() << "round " << i << ": " << low << " to " << high << ", " << most);
    const Ticks ticks = make_ticks(low, high, AxisScale::Log, most);
    EXPECT_LE(ticks.values.size(), static_cast<std::size_t>(most));
    EXPECT_GE(ticks.values.size(), most >= 5 ? 2U : 0U);
    EXPECT_TRUE(std::is_sorted(ticks.values.begin(), ticks.values.end()));
    for (const double value : ticks.values) EXPECT_TRUE(value >= low && value <= high);
    for (const double value : ticks.minor) EXPECT_TRUE(value >= low && value <= high);
  }
}

TEST(Ticks, HugeAndTinyRanges) {
  EXPECT_GE(make_ticks(-1e300, 1e300, AxisScale::Linear, 5).values.size(), 2U);
  EXPECT_GE(make_ticks(0, 1e-300, AxisScale::Linear, 5).values.size(), 2U);
  EXPECT_GE(make_ticks(1e9, 1e9 + 1, AxisScale::Linear, 6).values.size(), 2U);
  EXPECT_GE(make_ticks(1e-300, 1e300, AxisScale::Log, 6).values.size(), 2U);
}

TEST(Ticks, RefusesWhatIsNoRange) {
  EXPECT_THROW(make_ticks(1, 1, AxisScale::Linear, 5), Error);
  EXPECT_THROW(make_ticks(2, 1, AxisScale::Linear, 5), Error);
  EXPECT_THROW(make_ticks(NAN, 1, AxisScale::Linear, 5), Error);
  EXPECT_THROW(make_ticks(0, INFINITY, AxisScale::Linear, 5), Error);
  EXPECT_THROW(make_ticks(0, 1, AxisScale::Log, 5), Error);
  EXPECT_THROW(make_ticks(1e15, 1e15 + 1, AxisScale::Linear, 5), Error);
}

TEST(Ticks, PowersOfTen) {
  EXPECT_EQ(power_of_ten(6), "10⁶");
  EXPECT_EQ(power_of_ten(-12), "10⁻¹²");
}

}  // namespace
}  // namespace azulejo
