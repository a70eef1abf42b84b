#include "azulejo/rendering/camera_moves.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

constexpr double kQuarter = 1.57079632679489662;

void expect_near(const glm::vec3& got, const glm::vec3& wanted, double tolerance = 1e-5) {
  EXPECT_LT(glm::length(got - wanted), tolerance) << got.x << " " << got.y << " " << got.z;
}

TEST(CameraMoves, OrbitGoesAroundTheTarget) {
  const CameraPose front{{1, 2, 13}, {1, 2, 3}, {0, 1, 0}};
  expect_near(orbit(front, kQuarter, 0).position, {11, 2, 3});
  expect_near(orbit(front, -kQuarter, 0).position, {-9, 2, 3});
  expect_near(orbit(front, 0, kQuarter / 3).position, {1, 7, 3 + 10 * std::cos(kQuarter / 3)});
  EXPECT_EQ(orbit(front, 1, 1).target, front.target);
  // The pole is not crossed, and the way back is.
  const CameraPose top = orbit(front, 0, 10);
  EXPECT_GT(top.position.y, 11.99F);
  EXPECT_LT(orbit(top, 0, -10).position.y, -7.99F);
}

TEST(CameraMoves, OrbitsAddUpAndKeepTheDistance) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> number(-1, 1);
    const CameraPose pose{{3 * number(random), 0.3F * number(random), 4}, {0, 0, 0}, {0, 0.2F, 0}};
    const double a = number(random);
    const double b = number(random);
    expect_near(orbit(orbit(pose, a, 0.1), b, 0.2).position, orbit(pose, a + b, 0.3).position, 1e-4);
    EXPECT_NEAR(glm::length(orbit(pose, a, b).position), glm::length(pose.position), 1e-4);
  }
}

TEST(CameraMoves, PanMovesAcrossTheView) {
  const CameraPose pose{{0, 0, 5}, {0, 0, 0}, {0, 1, 0}};
  const CameraPose moved = pan(pose, 2, 3);
  expect_near(moved.position, {2, 3, 5});
  expect_near(moved.target, {2, 3, 0});
}

TEST(CameraMoves, DollyDividesTheDistance) {
  const CameraPose pose{{0, 0, 8}, {0, 0, 0}, {0, 1, 0}};
  expect_near(dolly(pose, 4).position, {0, 0, 2});
  expect_near(dolly(pose, 0.5).position, {0, 0, 16});
  EXPECT_THROW(dolly(pose, 0), Error);
  EXPECT_THROW(dolly(pose, std::nan("")), Error);
}

TEST(CameraMoves, LookAroundTurnsTheHead) {
  const CameraPose pose{{0, 0, 5}, {0, 0, 0}, {0, 1, 0}};
  expect_near(look_around(pose, kQuarter, 0).target, {-5, 0, 5});
  expect_near(look_around(pose, 0, kQuarter / 3).target, {0, 2.5F, 5 - 5 * std::cos(kQuarter / 3)});
  EXPECT_EQ(look_around(pose, 1, 1).position, pose.position);
}

TEST(CameraMoves, DegeneratePosesStayFinite) {
  for (const CameraPose& pose :
       {CameraPose{{0, 0, 0}, {0, 0, 0}, {0, 1, 0}}, CameraPose{{0, 5, 0}, {0, 0, 0}, {0, 1, 0}},
        CameraPose{{0, 0, 5}, {0, 0, 0}, {0, 0, 0}}}) {
    for (const CameraPose& moved : {orbit(pose, 1, 0.1), pan(pose, 1, 1), dolly(pose, 2), look_around(pose, 1, 0.1)}) {
      EXPECT_TRUE(std::isfinite(glm::length(moved.position)));
      EXPECT_TRUE(std::isfinite(glm::length(moved.target)));
    }
  }
}

}  // namespace
}  // namespace azulejo
