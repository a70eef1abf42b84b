#include "azulejo/rendering/spread_directions.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

glm::dvec3 unit(const Direction& direction) {
  const double azimuth = direction.azimuth_deg * 3.14159265358979 / 180;
  const double elevation = direction.elevation_deg * 3.14159265358979 / 180;
  return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation), std::cos(azimuth) * std::cos(elevation)};
}

TEST(SpreadDirections, CoverTheSphereWithoutCrowding) {
  for (const int count : {20, 200, 1000}) {
    for (const std::uint64_t seed : {0U, 1U, 99U}) {
      const std::vector<Direction> directions = spread_directions(count, seed);
      glm::dvec3 sum(0);
      double nearest = 10;
      for (std::size_t i = 0; i < directions.size(); ++i) {
        sum += unit(directions[i]);
        for (std::size_t j = 0; j < i; ++j) {
          nearest = std::min(nearest, glm::length(unit(directions[i]) - unit(directions[j])));
        }
      }
      EXPECT_LT(glm::length(sum) / count, 2 / std::sqrt(1.0 * count) / 2) << count << " seed " << seed;
      // Unshaken neighbours are about 3.1/√n apart.
      EXPECT_GT(nearest, 0.3 / std::sqrt(1.0 * count)) << count << " seed " << seed;
      // The largest hole: no direction is farther from its nearest than twice the spacing.
      for (int k = 0; k < 500; ++k) {
        const glm::dvec3 probe = unit(spread_directions(500, 12345)[static_cast<std::size_t>(k)]);
        double hole = 10;
        for (const Direction& each : directions) hole = std::min(hole, glm::length(unit(each) - probe));
        ASSERT_LT(hole, 5.5 / std::sqrt(1.0 * count)) << count << " seed " << seed;
      }
    }
  }
}

TEST(SpreadDirections, DependOnTheSeedAlone) {
  const auto a = spread_directions(10, 3);
  const auto b = spread_directions(10, 3);
  const auto c = spread_directions(10, 4);
  int same = 0;
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(a[i].azimuth_deg, b[i].azimuth_deg);
    EXPECT_EQ(a[i].elevation_deg, b[i].elevation_deg);
    same += a[i].azimuth_deg == c[i].azimuth_deg ? 1 : 0;
    EXPECT_GE(a[i].azimuth_deg, 0);
    EXPECT_LT(a[i].azimuth_deg, 360.001F);
    EXPECT_LE(std::abs(a[i].elevation_deg), 90);
  }
  EXPECT_LT(same, 2);
  EXPECT_THROW(spread_directions(0, 1), Error);
}

}  // namespace
}  // namespace azulejo
