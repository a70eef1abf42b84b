#include "azulejo/math/arc.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

namespace azulejo {
namespace {

constexpr double kPi = std::numbers::pi;

glm::dvec2 cubic(const std::array<glm::dvec2, 4>& p, double t) {
  const double s = 1 - t;
  return s * s * s * p[0] + 3 * s * s * t * p[1] + 3 * s * t * t * p[2] + t * t * t * p[3];
}

double turned(const EllipticalArc& arc) {  // the angle that it turns by, positive
  const double a = std::atan2(arc.first.y, arc.first.x);
  const double b = std::atan2(arc.last.y, arc.last.x);
  const double angle = arc.forward ? b - a : a - b;
  return angle < 0 ? angle + 2 * kPi : angle;
}

TEST(Arc, BetweenPointsIsTheOneOfFour) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-1, 1);
    const glm::dvec2 from(number(random), number(random));
    const glm::dvec2 to(number(random), number(random));
    const glm::dvec2 radii(2 + number(random), -2 + number(random));
    const double turns = number(random);
    for (const bool large : {false, true}) {
      for (const bool forward : {false, true}) {
        const auto arc = arc_between(from, to, radii, turns, large, forward);
        ASSERT_TRUE(arc);
        const auto at = [&](const glm::dvec2& unit) { return arc->center + arc->x * unit.x + arc->y * unit.y; };
        EXPECT_LT(glm::distance(at(arc->first), from), 1e-13);
        EXPECT_LT(glm::distance(at(arc->last), to), 1e-13);
        EXPECT_NEAR(glm::length(arc->first), 1, 1e-15);
        EXPECT_EQ(arc->forward, forward);
        EXPECT_EQ(turned(*arc) > kPi, large);
        EXPECT_NEAR(glm::length(arc->x), radii.x, 1e-14);
        EXPECT_NEAR(std::atan2(arc->x.y, arc->x.x), 2 * kPi * (turns - std::round(turns)), 1e-14);
      }
    }
  }
}

TEST(Arc, RadiiThatAreTooSmallGrow) {
  const auto arc = arc_between({0, 0}, {4, 0}, {1, 0.5}, 0, false, true);
  ASSERT_TRUE(arc);
  EXPECT_LT(glm::distance(arc->center, glm::dvec2(2, 0)), 1e-15);
  EXPECT_LT(glm::distance(arc->x, glm::dvec2(2, 0)), 1e-15);
  EXPECT_LT(glm::distance(arc->y, glm::dvec2(0, 1)), 1e-15);
}

TEST(Arc, IsNothingWhereSvgDrawsALine) {
  EXPECT_FALSE(arc_between({1, 2}, {1, 2}, {1, 1}, 0, true, true));
  EXPECT_FALSE(arc_between({1, 2}, {3, 2}, {0, 1}, 0, true, true));
  EXPECT_FALSE(arc_between({1, 2}, {3, 2}, {1, 0}, 0, true, true));
  EXPECT_FALSE(arc_between({1, NAN}, {3, 2}, {1, 1}, 0, true, true));
  EXPECT_FALSE(arc_between({1, 2}, {3, 2}, {1, 1}, INFINITY, true, true));
}

/// How far the points are from the ellipse: of a circle exactly, else in units where it is the unit circle.
TEST(Arc, CubicsAreWithinTheTolerance) {
  for (const double sweep : {1.0, -1.0, 0.75, -0.6, 0.5, 0.25, 1e-3, 3.0}) {
    const EllipticalArc arc = arc_around({3, -2}, {5, 5}, 0.2, 0.1, sweep);
    double error_before = 0;
    for (const double tolerance : {1e-1, 1e-3, 1e-5, 1e-7}) {
      SCOPED_TRACE(tolerance);
      const auto cubics = arc_to_cubics(arc, tolerance);
      double error = 0;
      double length = 0;
      for (std::size_t i = 0; i < cubics.size(); ++i) {
        if (i > 0) {
          EXPECT_EQ(cubics[i][0], cubics[i - 1][3]);
        }
        for (int k = 0; k < 32; ++k) {
          const glm::dvec2 p = cubic(cubics[i], k / 32.0);
          error = std::max(error, std::abs(glm::length(p - arc.center) - 5));
          length += glm::distance(p, cubic(cubics[i], (k + 1) / 32.0));
        }
      }
      EXPECT_LE(error, tolerance);
      if (tolerance < 1e-3) {
        EXPECT_NEAR(length, 5 * 2 * kPi * std::min(std::abs(sweep), 1.0), 1e-2);
      }
      if (error_before > 0 && error > 1e-12) {
        EXPECT_LE(error, error_before);
      }
      error_before = error;
      const glm::dvec2 start(std::cos(2 * kPi * 0.3), std::sin(2 * kPi * 0.3));
      EXPECT_LT(glm::distance(cubics.front()[0], arc.center + 5.0 * start), 1e-13);
    }
  }
  // A quarter in one piece is 2.7 · 10⁻⁴ off: known of the circle's usual cubics.
  EXPECT_EQ(arc_to_cubics(arc_around({0, 0}, {1, 1}, 0, 0, 0.25), 2.8e-4).size(), 1U);
  EXPECT_EQ(arc_to_cubics(arc_around({0, 0}, {1, 1}, 0, 0, 0.25), 2.7e-4).size(), 2U);
  EXPECT_LE(arc_to_cubics(arc_around({0, 0}, {1, 1}, 0, 0, 1), 0).size(), 64U);
  EXPECT_TRUE(arc_to_cubics(arc_around({0, 0}, {1, 1}, 0, 0, 0), 1e-3).empty());
}

TEST(Arc, RunsTheWayThatItIsTold) {
  const auto forward = arc_to_cubics(arc_around({0, 0}, {2, 1}, 0, 0, 0.25), 1e-6);
  EXPECT_LT(glm::distance(forward.back()[3], glm::dvec2(0, 1)), 1e-15);
  EXPECT_GT(cubic(forward[0], 0.5).y, 0);
  const auto back = arc_to_cubics(arc_around({0, 0}, {2, 1}, 0, 0, -0.75), 1e-6);
  EXPECT_LT(glm::distance(back.back()[3], glm::dvec2(0, 1)), 1e-14);
  EXPECT_LT(cubic(back[0], 0.5).y, 0);
}

}  // namespace
}  // namespace azulejo
