#include "azulejo/math/catmull_rom.h"

#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace azulejo {
namespace {

using Points = std::vector<glm::dvec2>;

/// Barry and Goldman's pyramid: the piece from p1 to p2, at t in 0–1 of it.
glm::dvec2 pyramid(const std::array<glm::dvec2, 4>& p, double power, double t) {
  std::array<double, 4> k{};
  for (std::size_t i = 0; i < 3; ++i) k[i + 1] = k[i] + std::pow(glm::distance(p[i], p[i + 1]), power);
  const double u = k[1] + t * (k[2] - k[1]);
  const auto mix = [&](const glm::dvec2& a, const glm::dvec2& b, double from, double to) {
    return ((to - u) * a + (u - from) * b) / (to - from);
  };
  const glm::dvec2 a1 = mix(p[0], p[1], k[0], k[1]);
  const glm::dvec2 a2 = mix(p[1], p[2], k[1], k[2]);
  const glm::dvec2 a3 = mix(p[2], p[3], k[2], k[3]);
  return mix(mix(a1, a2, k[0], k[2]), mix(a2, a3, k[1], k[3]), k[1], k[2]);
}

glm::dvec2 cubic(const std::array<glm::dvec2, 4>& p, double t) {
  const double s = 1 - t;
  return s * s * s * p[0] + 3 * s * s * t * p[1] + 3 * s * t * t * p[2] + t * t * t * p[3];
}

TEST(CatmullRom, IsThePyramids) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-1, 1);
    Points points(6);
    for (glm::dvec2& each : points) each = {number(random), number(random)};
    for (std::size_t timing = 0; timing < 3; ++timing) {
      const auto pieces = catmull_rom<glm::dvec2>(points, true, static_cast<SplineTiming>(timing));
      ASSERT_EQ(pieces.size(), 6U);
      for (std::size_t i = 0; i < 6; ++i) {
        const std::array<glm::dvec2, 4> around{points[(i + 5) % 6], points[i], points[(i + 1) % 6],
                                               points[(i + 2) % 6]};
        for (const double t : {0.0, 0.25, 0.8, 1.0}) {
          EXPECT_LT(glm::distance(cubic(pieces[i], t), pyramid(around, 0.5 * static_cast<double>(timing), t)), 1e-12);
        }
      }
    }
  }
}

TEST(CatmullRom, OpenOnesBeginTowardsTheSecondPoint) {
  const Points points{{0, 0}, {1, 1}, {3, 0}};
  const auto pieces = catmull_rom<glm::dvec2>(points, false, SplineTiming::Centripetal);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0][0], points[0]);
  EXPECT_EQ(pieces[1][3], points[2]);
  EXPECT_LT(glm::distance(pieces[0][1], points[1] / 3.0), 1e-15);
  const auto line = catmull_rom<glm::dvec2>(Points{{0, 0}, {3, 0}}, false, SplineTiming::Uniform);
  ASSERT_EQ(line.size(), 1U);
  EXPECT_EQ(line[0][1], glm::dvec2(1, 0));
}

TEST(CatmullRom, EqualPointsAreLeftOut) {
  EXPECT_EQ(catmull_rom<glm::dvec2>(Points{{0, 0}, {0, 0}, {1, 0}, {1, 0}}, false, SplineTiming::Chordal).size(), 1U);
  EXPECT_EQ(catmull_rom<glm::dvec2>(Points{{0, 0}, {1, 0}, {1, 1}, {0, 0}}, true, SplineTiming::Chordal).size(), 3U);
  EXPECT_TRUE(catmull_rom<glm::dvec2>(Points{{2, 1}, {2, 1}}, true, SplineTiming::Chordal).empty());
  EXPECT_TRUE(catmull_rom<glm::dvec2>({}, false, SplineTiming::Chordal).empty());
}

}  // namespace
}  // namespace azulejo
