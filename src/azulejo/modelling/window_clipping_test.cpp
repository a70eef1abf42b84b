#include "azulejo/modelling/window_clipping.h"

#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "azulejo/modelling/polygon_testing.h"

namespace azulejo {
namespace {

const Box2 kWindow{{0, 0}, {10, 6}};

TEST(WindowClipping, KnownCases) {
  using Part = std::optional<LineSegment2>;
  const auto all = [](const LineSegment2& segment, const Part& expected) {
    const std::vector<glm::vec2> ring = {{0, 0}, {10, 0}, {10, 6}, {0, 6}};
    EXPECT_EQ(clip(segment, kWindow), expected);
    EXPECT_EQ(clip_by_codes(segment, kWindow), expected);
    EXPECT_EQ(clip(segment, std::span<const glm::vec2>(ring)), expected);
  };
  all({{1, 1}, {2, 3}}, LineSegment2{{1, 1}, {2, 3}});     // inside
  all({{-5, 3}, {15, 3}}, LineSegment2{{0, 3}, {10, 3}});  // through two sides
  all({{15, 3}, {-5, 3}}, LineSegment2{{10, 3}, {0, 3}});  // the other way
  all({{5, 3}, {5, 9}}, LineSegment2{{5, 3}, {5, 6}});     // one end inside
  all({{-1, 7}, {11, 7}}, std::nullopt);                   // beside
  all({{-4, 2}, {2, 8}}, LineSegment2{{0, 6}, {0, 6}});    // a corner
  all({{-5, 2}, {1, 8}}, std::nullopt);                    // past a corner
  all({{0, -3}, {0, 9}}, LineSegment2{{0, 0}, {0, 6}});    // along a side
  all({{3, 3}, {3, 3}}, LineSegment2{{3, 3}, {3, 3}});     // a point
  all({{-3, 3}, {-3, 3}}, std::nullopt);
  all({{std::numeric_limits<float>::quiet_NaN(), 3}, {3, 3}}, std::nullopt);
  all({{3, 3}, {std::numeric_limits<float>::infinity(), 3}}, std::nullopt);
  EXPECT_EQ(clip({{0, 0}, {1, 1}}, Box2()), std::nullopt);
  EXPECT_EQ(clip({{0, 0}, {1, 1}}, std::span<const glm::vec2>()), std::nullopt);
}

TEST(WindowClipping, TheThreeMethodsAgreeWithEachOtherAndWithPointsOnTheWay) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> place(-10, 20);
  const std::vector<glm::vec2> ring = {{0, 0}, {10, 0}, {10, 6}, {0, 6}};
  int parts = 0;
  for (int i = 0; i < 20000; ++i) {
    const LineSegment2 segment{{place(random), place(random)}, {place(random), place(random)}};
    const auto a = clip(segment, kWindow);
    const auto b = clip_by_codes(segment, kWindow);
    const auto c = clip(segment, std::span<const glm::vec2>(ring));
    ASSERT_EQ(a.has_value(), b.has_value()) << i;
    ASSERT_EQ(a.has_value(), c.has_value()) << i;
    double inside = 0;
    constexpr int kSteps = 64;
    for (int s = 0; s < kSteps; ++s) {
      const double t = (s + 0.5) / kSteps;
      const glm::dvec2 p = (1 - t) * glm::dvec2(segment.from) + t * glm::dvec2(segment.to);
      inside += p.x >= 0 && p.x <= 10 && p.y >= 0 && p.y <= 6 ? 1.0 / kSteps : 0;
    }
    const double length = glm::length(glm::dvec2(segment.to) - glm::dvec2(segment.from));
    const double kept = a ? glm::length(glm::dvec2(a->to) - glm::dvec2(a->from)) / length : 0;
    ASSERT_NEAR(kept, inside, 1.0 / kSteps + 1e-6) << i;  // each end falls between two of the points
    if (!a) continue;
    ++parts;
    // Doubles, rounded once to floats of 10: 5·10⁻⁷; a second time where codes go around a corner.
    ASSERT_LT(glm::length(a->from - b->from) + glm::length(a->to - b->to), 4e-6);
    ASSERT_LT(glm::length(a->from - c->from) + glm::length(a->to - c->to), 4e-6);
  }
  EXPECT_GT(parts, 3000);
}

TEST(WindowClipping, PolygonsHaveTheAreaOfBruteForce) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> anywhere(-10, 20);
    const auto place = [&] { return seed % 2 == 0 ? std::floor(anywhere(random)) : anywhere(random); };
    Polygon polygon;
    for (std::size_t rings = 1 + seed % 3; rings-- > 0;) {
      std::vector<glm::vec2> ring;
      for (std::size_t points = 3 + random() % 9; points-- > 0;) ring.emplace_back(place(), place());
      polygon.add_ring(ring);
    }
    const Polygon window = polygon_testing::polygon_of({std::vector<glm::vec2>{{0, 0}, {10, 0}, {10, 6}, {0, 6}}});
    for (const FillRule rule : {FillRule::NonZero, FillRule::EvenOdd}) {
      const double truth = polygon_testing::brute_area({&polygon, &window}, [&](const std::vector<int>& w) {
        return w[1] != 0 && polygon_testing::is_inside(rule, w[0]);
      });
      const Polygon kept = simplified(clip(polygon, kWindow), rule);
      ASSERT_NEAR(signed_area(kept), truth, 1e-3);  // floats of 10, a perimeter of some 100
      for (std::size_t r = 0; r < kept.ring_count(); ++r) ASSERT_TRUE(is_simple(kept.ring(r)));
    }
  }
}

}  // namespace
}  // namespace azulejo
