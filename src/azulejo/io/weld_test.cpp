#include "azulejo/io/weld.h"

#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "azulejo/io/model_testing.h"

namespace azulejo {
namespace {

Welded weld(const std::vector<glm::vec3>& corners, int threads = 0) {
  Run run;
  run.threads = threads;
  return weld_exactly(corners, run);
}

/// The definition, with a sorted map.
Welded plainly_welded(const std::vector<glm::vec3>& corners) {
  std::map<std::tuple<float, float, float>, std::uint32_t> numbers;
  Welded result;
  for (const glm::vec3& p : corners) {
    const auto next = static_cast<std::uint32_t>(result.positions.size());
    const bool nan = std::isnan(p.x) || std::isnan(p.y) || std::isnan(p.z);
    const std::uint32_t vertex = nan ? next : numbers.try_emplace({p.x, p.y, p.z}, next).first->second;
    if (vertex == next) result.positions.push_back(p);
    result.corners.push_back(vertex);
  }
  return result;
}

void expect_same(const Welded& a, const Welded& b) {
  EXPECT_TRUE(same_bytes(a.positions, b.positions));
  EXPECT_TRUE(same_bytes(a.corners, b.corners));
}

std::vector<glm::vec3> random_corners(std::size_t count, unsigned range, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<glm::vec3> corners;
  const auto number = [&] {
    return static_cast<float>(static_cast<int>(random() % range) - static_cast<int>(range / 2));
  };
  for (std::size_t i = 0; i < count; ++i) {
    corners.emplace_back(number(), number(), number());
    if (random() % 50 == 0) corners.back().y = std::numeric_limits<float>::quiet_NaN();
    if (random() % 5 == 0) corners.back() *= -1.0F;  // some zeros become -0
  }
  return corners;
}

TEST(Weld, IsByItsDefinition) {
  for (const std::size_t count : {0, 1, 2, 3, 100, 8191, 8192, 70'000, 300'000}) {
    for (const unsigned range : {2U, 40U, 100'000U}) {
      const std::vector<glm::vec3> corners = random_corners(count, range, range);
      SCOPED_TRACE(testing::Message() << count << " corners in " << range);
      const Welded wanted = plainly_welded(corners);
      for (const int threads : {1, 2, 7}) expect_same(weld(corners, threads), wanted);
    }
  }
}

TEST(Weld, ZerosAreEqualAndTheFirstStays) {
  const Welded result = weld({{-0.0F, 1, 2}, {0.0F, 1, 2}, {1, -0.0F, -0.0F}, {1, 0, 0}});
  EXPECT_EQ(listed(result.corners), (std::vector<std::uint32_t>{0, 0, 1, 1}));
  EXPECT_TRUE(std::signbit(result.positions[0].x));
  EXPECT_EQ(position_hash({-0.0F, 1, 2}), position_hash({0.0F, 1, 2}));
}

TEST(Weld, NanEqualsNothing) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(listed(weld({{nan, 0, 0}, {nan, 0, 0}, {0, 0, 0}, {0, 0, nan}, {0, 0, 0}}).corners),
            (std::vector<std::uint32_t>{0, 1, 2, 3, 2}));
}

TEST(Weld, PositionsMadeToMeetInTheTable) {
  // Hashes that agree where the table of so many corners looks: it is given up for sorting, with the same result.
  std::mt19937 random(9);
  std::vector<glm::vec3> corners;
  while (corners.size() < 1000) {
    const glm::vec3 position(std::bit_cast<float>(static_cast<std::uint32_t>(0x3F800000U + random() % (1U << 23))), 1,
                             2);
    if ((position_hash(position) >> 16 & 2047) == 77) corners.push_back(position);
  }
  for (std::size_t i = 0; i < 20; ++i) corners.push_back(corners[i * 7]);
  corners.emplace_back(std::numeric_limits<float>::quiet_NaN(), 0, 0);
  expect_same(weld(corners), plainly_welded(corners));
}

}  // namespace
}  // namespace azulejo
