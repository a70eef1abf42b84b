#include "azulejo/modelling/decimate_quadric.h"

#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

namespace azulejo::decimation {
namespace {

/// Planes near two points; their quadrics together are the sum of squared distances, and least where no step helps.
TEST(DecimateQuadric, TwoPointsAreTheSumOfTheirPlanes) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto point = [&] { return glm::dvec3(number(random), number(random), number(random)); };
  for (int trial = 0; trial < 100; ++trial) {
    const glm::dvec3 a = point();
    const glm::dvec3 b = a + 0.01 * point();
    struct Plane {
      glm::dvec3 normal;
      double depth;
    };
    std::vector<Plane> planes;
    const auto quadric_at = [&](const glm::dvec3& place) {
      Quadric sum;
      for (int i = 0; i < 6; ++i) {
        const glm::dvec3 normal = glm::normalize(point());
        const double away = 0.002 * number(random);
        planes.push_back({normal, away - glm::dot(normal, place)});
        sum.add(normal, away, 1);
        sum.weight += 1;
      }
      LocalQuadric local;
      local.add(sum, glm::dvec3(0));
      return local.near();
    };
    const NearQuadric at_a = quadric_at(a);
    const NearQuadric at_b = quadric_at(b);
    const glm::dvec3 half = 0.5 * (b - a);
    const auto truth = [&](const glm::dvec3& place) {
      double sum = 0;
      for (const Plane& plane : planes) {
        const double distance = glm::dot(plane.normal, place) + plane.depth;
        sum += distance * distance;
      }
      return sum;
    };
    const LocalQuadric local(at_a, at_b, half);
    // Twelve planes within 0.02: terms up to 12 · 0.02² with single precision's 6e-8 each, a few of them.
    const double tolerance = 12 * 0.02 * 0.02 * 6e-7;
    EXPECT_EQ(local.weight(), 12);
    EXPECT_NEAR(local.here(), truth(a + half), tolerance);
    const auto [back, ahead] = local.at_ends(half);
    EXPECT_NEAR(back, truth(a), tolerance);
    EXPECT_NEAR(ahead, truth(b), tolerance);
    const LocalQuadric::Least least = local.least();
    EXPECT_NEAR(least.value, truth(a + half + least.step), tolerance);
    for (int i = 0; i < 10; ++i) EXPECT_LE(least.value, truth(a + half + least.step + 0.001 * point()) + tolerance);

    LocalQuadric moved;
    const glm::dvec3 there = a + 0.01 * point();
    moved.add(at_a, there - a);
    moved.add(at_b, there - b);
    EXPECT_NEAR(moved.here(), truth(there), tolerance);
  }
}

}  // namespace
}  // namespace azulejo::decimation
