#include "azulejo/rendering/coverage_band.h"

#include <gtest/gtest.h>

#include "azulejo/rendering/coverage_testing.h"

namespace azulejo {
namespace {

constexpr int kWidth = 40;
constexpr int kHeight = 24;

std::vector<glm::vec2> random_contour(std::mt19937& random, int points, float low, float high) {
  std::uniform_real_distribution<float> within(low, high);
  std::vector<glm::vec2> contour;
  for (int i = 0; i < points; ++i) contour.emplace_back(within(random), within(random));
  return contour;
}

/// Signed area of a contour within a pixel, in double precision: clipped at each of its sides in turn.
double clipped_area(const std::vector<glm::vec2>& contour, int x, int y) {
  std::vector<glm::dvec2> points(contour.begin(), contour.end());
  for (int side = 0; side < 4; ++side) {
    const int axis = side / 2;
    const double sign = side % 2 == 0 ? 1 : -1;
    const double limit = (axis == 0 ? x : y) + side % 2;
    std::vector<glm::dvec2> kept;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const glm::dvec2 a = points[i];
      const glm::dvec2 b = points[(i + 1) % points.size()];
      const double da = sign * (a[axis] - limit);
      const double db = sign * (b[axis] - limit);
      if (da >= 0) kept.push_back(a);
      if ((da < 0) != (db < 0)) kept.push_back(a + da / (da - db) * (b - a));
    }
    points = std::move(kept);
  }
  double area = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec2 a = points[i];
    const glm::dvec2 b = points[(i + 1) % points.size()];
    area += 0.5 * (a.x * b.y - b.x * a.y);
  }
  return area;
}

double largest_difference(const std::vector<float>& ours, const std::vector<double>& truth) {
  double largest = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) largest = std::max(largest, std::abs(double{ours[i]} - truth[i]));
  return largest;
}

/// Ends of edges are off by up to 2⁻¹⁵ pixel, and each adds up to 2⁻¹⁷: a few edges stay far below this.
constexpr double kTolerance = 0.25 / 255;

TEST(CoverageBand, OfATriangleIsItsClippedArea) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    const std::vector<glm::vec2> triangle = random_contour(random, 3, -10, 50);
    for (const FillRule rule : {FillRule::NonZero, FillRule::EvenOdd}) {
      const std::vector<float> ours = coverage_of({triangle}, kWidth, kHeight, rule);
      std::vector<double> truth;
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) truth.push_back(std::abs(clipped_area(triangle, x, y)));
      }
      ASSERT_LT(largest_difference(ours, truth), kTolerance) << "seed " << seed;
    }
  }
}

TEST(CoverageBand, OfStarsAndCombsIsTheirClippedArea) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> radius(1, 11);
    std::vector<glm::vec2> star;
    for (int i = 0; i < 60; ++i) {
      const float r = radius(random);
      const float angle = static_cast<float>(i) * 0.10471976F;
      star.emplace_back(15 + r * std::cos(angle), 12 + r * std::sin(angle));
    }
    std::vector<glm::vec2> comb{{38, 23}, {2, 23}};
    for (int i = 0; i < 40; ++i) {
      const float x = 2 + static_cast<float>(i) * 0.8F;
      comb.insert(comb.end(), {{x, 20}, {x + 0.3F, radius(random)}, {x + 0.5F, 20}});
    }
    for (const std::vector<glm::vec2>& contour : {star, comb}) {
      std::vector<double> truth;
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) truth.push_back(std::abs(clipped_area(contour, x, y)));
      }
      ASSERT_LT(largest_difference(coverage_of({contour}, kWidth, kHeight, FillRule::NonZero), truth), kTolerance)
          << "seed " << seed;
    }
  }
}

// Outlines that pass the same pixel without crossing: windings 2, 1, 0 and 1, 0, -1 side by side.
TEST(CoverageBand, CountsEachWindingInAPixel) {
  const std::vector<glm::vec2> outer{{1.2F, 1.3F}, {9.7F, 1.3F}, {9.7F, 9.4F}, {1.2F, 9.4F}};
  const std::vector<glm::vec2> inner{{1.5F, 1.6F}, {9.6F, 1.6F}, {9.6F, 9.1F}, {1.5F, 9.1F}};
  std::vector<glm::vec2> turned = inner;
  std::reverse(turned.begin(), turned.end());
  const std::vector<glm::vec2> right{{10.1F, 1.1F}, {9.8F, 8.8F}, {12, 8}};  // goes the other way than `outer`
  for (const Contours& contours :
       {Contours{outer, inner}, Contours{outer, turned}, Contours{outer, right}, Contours{inner, inner}}) {
    for (const FillRule rule : {FillRule::NonZero, FillRule::EvenOdd}) {
      // Lines of sampling err by the height of one at each end: 1/4096.
      EXPECT_LT(largest_difference(coverage_of(contours, kWidth, kHeight, rule),
                                   sampled_coverage(contours, kWidth, kHeight, rule, 4096)),
                kTolerance + 1.0 / 2048);
    }
  }
}

TEST(CoverageBand, OfOutlinesThatCrossThemselvesIsExactToo) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    Contours contours;
    for (unsigned i = 0; i <= seed % 3; ++i)
      contours.push_back(random_contour(random, 3 + static_cast<int>(seed % 5), -4, 30));
    for (const FillRule rule : {FillRule::NonZero, FillRule::EvenOdd}) {
      ASSERT_LT(largest_difference(coverage_of(contours, kWidth, kHeight, rule),
                                   sampled_coverage(contours, kWidth, kHeight, rule, 2048)),
                1.0 / 255)
          << "seed " << seed;
    }
  }
}

/// Corners on a coarse grid: outlines touch each other's corners and sides, run along them, and cross there.
TEST(CoverageBand, OfOutlinesThatTouchIsCloseToo) {
  for (unsigned seed = 0; seed < 400; ++seed) {
    std::mt19937 random(seed);
    const auto place = [&] { return static_cast<float>(random() % 13) * 0.25F + 1; };
    Contours contours;
    for (unsigned i = 0; i <= seed % 3; ++i) {
      std::vector<glm::vec2>& contour = contours.emplace_back();
      for (unsigned c = 0; c < 3 + seed % 4; ++c) contour.emplace_back(place(), place());
    }
    for (const FillRule rule : {FillRule::NonZero, FillRule::EvenOdd}) {
      // More than four edges that cross in a pixel are exact to 1/256 each crossing.
      ASSERT_LT(largest_difference(coverage_of(contours, 6, 6, rule), sampled_coverage(contours, 6, 6, rule, 2048)),
                2.0 / 255)
          << "seed " << seed;
    }
  }
}

// Hundreds of edges in few pixels: strips that are not cut at each crossing.
TEST(CoverageBand, OfCrowdedPixelsIsCloseToTheTruth) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    std::mt19937 random(seed);
    const Contours contours{random_contour(random, 300, 4, 9)};
    for (const FillRule rule : {FillRule::NonZero, FillRule::EvenOdd}) {
      ASSERT_LT(largest_difference(coverage_of(contours, kWidth, kHeight, rule),
                                   sampled_coverage(contours, kWidth, kHeight, rule, 2048)),
                0.02)
          << "seed " << seed;
    }
  }
}

TEST(CoverageBand, DoesNotDependOnTheBands) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    std::mt19937 random(seed);
    const Contours contours{random_contour(random, 30, -20, 60), random_contour(random, 5, -1e6F, 1e6F)};
    for (const Antialias antialias : {Antialias::None, Antialias::Area}) {
      const std::vector<float> whole = coverage_of(contours, kWidth, kHeight, FillRule::NonZero, antialias, kHeight);
      for (const int rows : {1, 2, 3, 7}) {
        ASSERT_EQ(coverage_of(contours, kWidth, kHeight, FillRule::NonZero, antialias, rows), whole) << "seed " << seed;
      }
    }
  }
}

TEST(CoverageBand, WithoutAntialiasingDrawsEachPixelOfAMeshOnce) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> moved(-0.8F, 0.8F);
  // A mesh of triangles over a grid whose inner points are moved; some points lie on centers of pixels.
  constexpr int kCells = 8;
  std::vector<glm::vec2> points;
  for (int y = 0; y <= kCells; ++y) {
    for (int x = 0; x <= kCells; ++x) {
      const bool inner = x > 0 && y > 0 && x < kCells && y < kCells;
      const glm::vec2 grid(static_cast<float>(x) * 3 + 2.5F, static_cast<float>(y) * 2.5F + 1);
      points.push_back(inner && (x + y) % 3 != 0 ? grid + glm::vec2(moved(random), moved(random)) : grid);
    }
  }
  std::vector<int> count(kWidth * kHeight, 0);
  const auto draw = [&](std::vector<glm::vec2> triangle) {
    const std::vector<float> coverage =
        coverage_of({std::move(triangle)}, kWidth, kHeight, FillRule::NonZero, Antialias::None);
    for (std::size_t i = 0; i < count.size(); ++i) count[i] += static_cast<int>(coverage[i]);
  };
  for (int y = 0; y < kCells; ++y) {
    for (int x = 0; x < kCells; ++x) {
      const auto at = [&](int dx, int dy) {
        return points[static_cast<std::size_t>((y + dy) * (kCells + 1) + x + dx)];
      };
      draw({at(0, 0), at(1, 0), at(1, 1)});
      draw({at(0, 0), at(1, 1), at(0, 1)});
    }
  }
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const bool inside = x >= 2 && x < 26 && y >= 1 && y < 21;
      ASSERT_EQ(count[static_cast<std::size_t>(y * kWidth + x)], inside ? 1 : 0) << x << " " << y;
    }
  }
}

TEST(CoverageBand, LeavesOutPointsThatAreNotFinite) {
  const float nan = std::nanf("");
  const float infinite = std::numeric_limits<float>::infinity();
  const std::vector<glm::vec2> square{{2, 2}, {9, 2}, {9, 9}, {2, 9}};
  const std::vector<glm::vec2> broken{{nan, 0}, {2, 2}, {9, 2}, {infinite, 3}, {9, 9}, {2, 9}, {4, -infinite}};
  EXPECT_EQ(coverage_of({broken}, kWidth, kHeight, FillRule::NonZero),
            coverage_of({square}, kWidth, kHeight, FillRule::NonZero));
  EXPECT_EQ(coverage_of({{{nan, nan}}, {}, {{1, 1}}, {{1, 1}, {2, 2}}}, kWidth, kHeight, FillRule::NonZero),
            std::vector<float>(kWidth * kHeight, 0));
}

TEST(CoverageBand, TakesHugeCoordinates) {
  for (const float size : {1e4F, 1e9F, 1e38F}) {
    const std::vector<float> half =
        coverage_of({{{10, -size}, {size, -size}, {size, size}, {10, size}}}, kWidth, kHeight, FillRule::NonZero);
    for (std::size_t i = 0; i < half.size(); ++i) ASSERT_EQ(half[i], i % kWidth >= 10 ? 1.0F : 0.0F);
    const std::vector<float> below =
        coverage_of({{{-size, 3.5F}, {size, 3.5F}, {size, size}, {-size, size}}}, kWidth, kHeight, FillRule::NonZero);
    for (std::size_t i = 0; i < below.size(); ++i) {
      ASSERT_EQ(below[i], i / kWidth > 3 ? 1.0F : i / kWidth == 3 ? 0.5F : 0.0F);
    }
  }
}

}  // namespace
}  // namespace azulejo
