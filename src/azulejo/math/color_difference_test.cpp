#include "azulejo/math/color_difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace azulejo {
namespace {

constexpr double kPrinted = 0.5e-4 + 1e-6;  // four digits are printed

TEST(ColorDifference, OfPairsAsPublished) {
  // Sharma, Wu, Dalal 2005, table 1: hues that wrap, opposite hues, a gray, large and small differences.
  const struct {
    Lab first;
    Lab second;
    double difference;
  } pairs[] = {{{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
               {{50, 0, 0}, {50, -1, 2}, 2.3669},
               {{50, 2.49, -0.001}, {50, -2.49, 0.0009}, 7.1792},
               {{50, 2.49, -0.001}, {50, -2.49, 0.0011}, 7.2195},
               {{50, 2.5, 0}, {58, 24, 15}, 19.4535},
               {{2.0776, 0.0795, -1.135}, {0.9033, -0.0636, -0.5514}, 0.9082}};
  for (const auto& [first, second, difference] : pairs) EXPECT_NEAR(ciede2000(first, second), difference, kPrinted);
}

TEST(ColorDifference, OfAllPairsOfTheTestData) {
  std::ifstream file(AZULEJO_SOURCE_FOLDER "/../shared/data/groundtruth/filters/ciede2000_test_data.txt");
  if (!file) GTEST_SKIP() << "groundtruth/filters/ciede2000_test_data.txt is not there";
  int pairs = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line.starts_with('#')) continue;
    std::istringstream words(line);
    std::vector<double> n;
    for (double value = 0; words >> value;) n.push_back(value);
    ASSERT_GE(n.size(), 20U) << line;
    const Lab first{n[2], n[3], n[4]};
    const Lab second{n[17], n[18], n[19]};
    EXPECT_NEAR(ciede2000(first, second), n[15], kPrinted) << line;
    EXPECT_NEAR(ciede2000(second, first), n[15], kPrinted) << line;
    ++pairs;
  }
  EXPECT_EQ(pairs, 34);
}

/// The formula with angles, as in the paper.
double by_angles(const Lab& p, const Lab& q) {
  constexpr double kDegree = std::numbers::pi / 180;
  const auto share = [](double c) { return std::sqrt(std::pow(c, 7) / (std::pow(c, 7) + std::pow(25.0, 7))); };
  const double g = 0.5 * (1 - share((std::hypot(p.a, p.b) + std::hypot(q.a, q.b)) / 2));
  const double a1 = (1 + g) * p.a;
  const double a2 = (1 + g) * q.a;
  const double c1 = std::hypot(a1, p.b);
  const double c2 = std::hypot(a2, q.b);
  const auto hue = [&](double a, double b) { return std::fmod(std::atan2(b, a) / kDegree + 360, 360); };
  const double h1 = hue(a1, p.b);
  const double h2 = hue(a2, q.b);
  double dh = h2 - h1;
  double mean = (h1 + h2) / 2;
  if (std::abs(h2 - h1) > 180) {
    dh += h2 > h1 ? -360 : 360;
    mean += h1 + h2 < 360 ? 180 : -180;
  }
  const double l = (p.l + q.l) / 2;
  const double c = (c1 + c2) / 2;
  const double t = 1 - 0.17 * std::cos((mean - 30) * kDegree) + 0.24 * std::cos(2 * mean * kDegree) +
                   0.32 * std::cos((3 * mean + 6) * kDegree) - 0.20 * std::cos((4 * mean - 63) * kDegree);
  const double sl = 1 + 0.015 * std::pow(l - 50, 2) / std::sqrt(20 + std::pow(l - 50, 2));
  const double dl = (q.l - p.l) / sl;
  const double dc = (c2 - c1) / (1 + 0.045 * c);
  const double dH = 2 * std::sqrt(c1 * c2) * std::sin(dh * kDegree / 2) / (1 + 0.015 * c * t);
  const double theta = 30 * std::exp(-std::pow((mean - 275) / 25, 2));
  return std::sqrt(dl * dl + dc * dc + dH * dH - 2 * share(c) * std::sin(2 * theta * kDegree) * dc * dH);
}

TEST(ColorDifference, IsThatOfTheFormulaWithAngles) {
  const unsigned seed = 5;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> lightness(0, 100);
  std::uniform_real_distribution<double> ab(-128, 127);
  for (int i = 0; i < 20'000; ++i) {
    const Lab first{lightness(random), ab(random), ab(random)};
    const double scale = i % 2 == 0 ? 1 : 0.02;  // any color, or a near one
    const Lab second{first.l + scale * (lightness(random) - first.l), first.a + scale * (ab(random) - first.a),
                     first.b + scale * (ab(random) - first.b)};
    const double expected = by_angles(first, second);
    ASSERT_NEAR(ciede2000(first, second), expected, 2e-6 * expected);
    ASSERT_DOUBLE_EQ(ciede2000(first, second), ciede2000(second, first));
  }
}

TEST(ColorDifference, OfAColorToItselfIsNothing) {
  EXPECT_EQ(ciede2000({40, 0, 0}, {40, 0, 0}), 0);
  EXPECT_EQ(ciede2000({40, -20, 33}, {40, -20, 33}), 0);
  EXPECT_EQ(color_difference_1976({40, -20, 33}, {40, -20, 33}), 0);
  EXPECT_TRUE(std::isnan(ciede2000({std::numeric_limits<double>::quiet_NaN(), 0, 0}, {})));
}

TEST(ColorDifference, Of1976IsADistance) { EXPECT_DOUBLE_EQ(color_difference_1976({10, 1, 2}, {12, 4, 8}), 7); }

}  // namespace
}  // namespace azulejo
