#include "azulejo/math/bezier.h"

#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "azulejo/math/rational_curve.h"

namespace azulejo {
namespace {

std::vector<glm::dvec3> random_points(unsigned seed, std::size_t count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<glm::dvec3> points(count);
  for (glm::dvec3& each : points) each = {number(random), number(random), number(random)};
  return points;
}

using Points = std::vector<glm::dvec3>;

TEST(Bezier, BernsteinsPolynomialsAreTheirs) {
  for (const int n : {0, 1, 2, 3, 7, 20}) {
    for (const double t : {0.0, 0.25, 1.0 / 3, 0.9, 1.0}) {
      const std::vector<double> values = bernstein(n, t);
      double sum = 0;
      double mean = 0;
      for (std::size_t i = 0; i < values.size(); ++i) {
        const auto k = static_cast<double>(i);
        EXPECT_NEAR(values[i], binomial(values.size() - 1, i) * std::pow(t, k) * std::pow(1 - t, n - k), 1e-13);
        sum += values[i];
        mean += k * values[i];
      }
      EXPECT_NEAR(sum, 1, 1e-14);
      EXPECT_NEAR(mean, n * t, 1e-13);  // linear precision
    }
  }
}

TEST(Bezier, IsTheSumOfItsPointsAndEndsInThem) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    const Points points = random_points(seed, 1 + seed % 12);
    const auto degree = static_cast<int>(points.size() - 1);
    EXPECT_EQ(bezier_point<glm::dvec3>(points, 0), points.front());
    EXPECT_EQ(bezier_point<glm::dvec3>(points, 1), points.back());
    for (const double t : {0.1, 0.5, 0.77}) {
      glm::dvec3 sum(0);
      for (std::size_t i = 0; i < points.size(); ++i) sum += bernstein(degree, t)[i] * points[i];
      EXPECT_LT(glm::distance(bezier_point<glm::dvec3>(points, t), sum), 1e-14);
    }
  }
  EXPECT_EQ(bezier_point<glm::dvec3>({}, 0.5), glm::dvec3(0));
}

TEST(Bezier, DerivativesAreDifferences) {
  const Points points = random_points(7, 6);
  constexpr double h = 1e-5;
  for (const double t : {0.0, 0.3, 0.8}) {
    const auto at = [&](double u, int order) { return bezier_derivative<glm::dvec3>(points, u, order); };
    for (int order = 1; order <= 5; ++order) {
      const glm::dvec3 difference = (at(t + h, order - 1) - at(t - h, order - 1)) / (2 * h);
      // h² ÷ 6 of the derivative two orders up, and rounding ÷ h.
      EXPECT_LT(glm::distance(at(t, order), difference), 1e-6 * (1 + glm::length(at(t, order)))) << order;
    }
    EXPECT_EQ(at(t, 6), glm::dvec3(0));
  }
}

TEST(Bezier, PartsAndElevationsAreTheSameCurve) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    const Points points = random_points(seed, 2 + seed % 7);
    const double cut = 0.05 + 0.03 * seed;
    const auto [before, behind] = bezier_split<glm::dvec3>(points, cut);
    const Points raised = bezier_elevated<glm::dvec3>(points);
    ASSERT_EQ(raised.size(), points.size() + 1);
    for (const double t : {0.0, 0.2, 0.6, 1.0}) {
      EXPECT_LT(glm::distance(bezier_point<glm::dvec3>(before, t), bezier_point<glm::dvec3>(points, cut * t)), 1e-14);
      EXPECT_LT(
          glm::distance(bezier_point<glm::dvec3>(behind, t), bezier_point<glm::dvec3>(points, cut + (1 - cut) * t)),
          1e-14);
      EXPECT_LT(glm::distance(bezier_point<glm::dvec3>(raised, t), bezier_point<glm::dvec3>(points, t)), 1e-14);
    }
  }
}

TEST(Bezier, ProductsMultiply) {
  const std::vector<double> factor{2, -1, 0.5};
  const Points points = random_points(3, 4);
  const Points product = bezier_product<glm::dvec3>(factor, points);
  ASSERT_EQ(product.size(), 6U);
  for (const double t : {0.0, 0.4, 1.0}) {
    const double f = bernstein(2, t)[0] * 2 - bernstein(2, t)[1] + bernstein(2, t)[2] * 0.5;
    EXPECT_LT(glm::distance(bezier_point<glm::dvec3>(product, t), f * bezier_point<glm::dvec3>(points, t)), 1e-14);
  }
}

TEST(Bezier, StaysWithinItsPoints) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    const Points points = random_points(seed, 5);
    const glm::dvec3 direction = random_points(seed + 1000, 1)[0];
    double most = -10;
    for (const glm::dvec3& p : points) most = std::max(most, glm::dot(p, direction));
    for (int i = 0; i <= 20; ++i) {
      EXPECT_LE(glm::dot(bezier_point<glm::dvec3>(points, i / 20.0), direction), most + 1e-14) << seed;
    }
  }
}

/// The largest distance of the curve's points from the simpler pieces, at the same parameters.
template <std::size_t N>
void expect_near(const std::vector<glm::dvec3>& curve, const std::vector<std::array<glm::dvec2, N>>& pieces,
                 double tolerance) {
  // Points of the pieces: their distance from the curve, sampled finely.
  std::vector<glm::dvec2> samples;
  for (int i = 0; i <= 4000; ++i) {
    samples.push_back(projected<glm::dvec2>(bezier_point<glm::dvec3>(curve, i / 4000.0)));
  }
  for (const auto& piece : pieces) {
    for (int i = 0; i <= 8; ++i) {
      const glm::dvec2 at = bezier_point<glm::dvec2>(piece, i / 8.0);
      double nearest = 1e9;
      for (std::size_t k = 1; k < samples.size(); ++k) {
        const glm::dvec2 along = samples[k] - samples[k - 1];
        const double share = glm::dot(at - samples[k - 1], along) / glm::dot(along, along);
        const double clamped = std::min(std::max(share, 0.0), 1.0);
        nearest = std::min(nearest, glm::distance(samples[k - 1] + clamped * along, at));
      }
      EXPECT_LT(nearest, tolerance + 1e-4);  // what 4000 chords are off
    }
  }
}

TEST(RationalCurve, BecomesCubicsAndChordsWithinTheTolerance) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    Points curve = random_points(seed, 3 + seed % 5);
    for (glm::dvec3& p : curve) p = homogeneous<glm::dvec2>(glm::dvec2(p) * 2.0, 0.3 + std::abs(p.z));
    std::size_t before = 0;
    for (const double tolerance : {1e-1, 1e-3}) {
      std::vector<std::array<glm::dvec2, 4>> cubics;
      simplify_rational<glm::dvec2>(curve, tolerance, cubic_of<glm::dvec2>,
                                    [&](const auto& piece) { cubics.push_back(piece); });
      expect_near(curve, cubics, tolerance);
      std::vector<std::array<glm::dvec2, 2>> chords;
      simplify_rational<glm::dvec2>(curve, tolerance, chord_of<glm::dvec2>,
                                    [&](const auto& piece) { chords.push_back(piece); });
      expect_near(curve, chords, tolerance);
      EXPECT_EQ(chords.front()[0], projected<glm::dvec2>(curve.front()));
      EXPECT_EQ(chords.back()[1], projected<glm::dvec2>(curve.back()));
      for (std::size_t i = 1; i < chords.size(); ++i) EXPECT_EQ(chords[i][0], chords[i - 1][1]);
      EXPECT_LE(cubics.size(), chords.size());
      EXPECT_GE(chords.size(), before);
      before = chords.size();
    }
  }
}

TEST(RationalCurve, TakesWhatIsSimpleAsItIs) {
  const Points cubic{{0, 0, 1}, {1, 2, 1}, {3, 2, 1}, {4, 0, 1}};
  int pieces = 0;
  simplify_rational<glm::dvec2>(cubic, 1e-12, cubic_of<glm::dvec2>, [&](const auto& piece) {
    ++pieces;
    EXPECT_LT(glm::distance(piece[1], glm::dvec2(1, 2)) + glm::distance(piece[2], glm::dvec2(3, 2)), 1e-12);
  });
  EXPECT_EQ(pieces, 1);
  // Beyond what can be told, and without numbers, it ends.
  const Points wild{{0, 0, 1}, {NAN, 2, 1}, {3, 2, 1}};
  pieces = 0;
  simplify_rational<glm::dvec2>(wild, 1e-3, chord_of<glm::dvec2>, [&](const auto&) { ++pieces; });
  EXPECT_EQ(pieces, 1);
  const Points round{{1, 0, 1}, {1, 1, 1}, {0, 2, 2}};
  pieces = 0;
  simplify_rational<glm::dvec2>(round, 0, chord_of<glm::dvec2>, [&](const auto&) { ++pieces; });
  EXPECT_LE(pieces, 1 << 16);
}

TEST(RationalCurve, AQuarterOfACircleIsExact) {
  const Points quarter{{1, 0, 1}, {1, 1, 1}, {0, 2, 2}};  // Piegl & Tiller, (7.10)
  for (int i = 0; i <= 10; ++i) {
    const double t = i / 10.0;
    const glm::dvec3 at = bezier_point<glm::dvec3>(quarter, t);
    const glm::dvec2 point = projected<glm::dvec2>(at);
    EXPECT_NEAR(glm::length(point), 1, 1e-15);
    const glm::dvec2 along = projected_derivative<glm::dvec2>(at, bezier_derivative<glm::dvec3>(quarter, t));
    EXPECT_NEAR(glm::dot(point, along), 0, 1e-14);
  }
}

}  // namespace
}  // namespace azulejo
