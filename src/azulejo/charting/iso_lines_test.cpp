#include "azulejo/charting/iso_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace azulejo {
namespace {

struct Field {
  int width;
  int height;
  std::vector<float> values;

  template <class F>
  Field(int w, int h, F value) : width(w), height(h) {
    for (int y = 0; y < h; ++y) {
      for (int x = 0; x < w; ++x) values.push_back(static_cast<float>(value(x, y)));
    }
  }
  ImageView<const float> view() const { return {values.data(), width, height, 1, width}; }
};

/// Twice the area that a closed line is around, positive where it is on the left with y down.
double area_on_the_left(const IsoLines& lines, std::size_t line) {
  double area = 0;
  for (std::size_t i = lines.starts[line], end = lines.starts[line + 1]; i < end; ++i) {
    const glm::dvec2 a = lines.points[i];
    const glm::dvec2 b = lines.points[i + 1 < end ? i + 1 : lines.starts[line]];
    area -= a.x * b.y - b.x * a.y;
  }
  return area;
}

TEST(IsoLines, OfASquaredDistanceAreCircles) {
  // Between neighbors x² + y² is above its chord by at most 1/4; with a slope of 2r the line is off by 1/(8r) at most,
  // along an edge, and √2 of it across a slanted one.
  const Field field(101, 101, [](int x, int y) { return (x - 50) * (x - 50) + (y - 50) * (y - 50); });
  for (const float radius : {3.3F, 12.7F, 41.0F, 49.9F}) {
    const IsoLines lines = iso_lines(field.view(), radius * radius);
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_TRUE(lines.closed[0]);
    for (const glm::vec2& point : lines.points) {
      EXPECT_NEAR(std::hypot(point.x - 50, point.y - 50), radius, 0.18F / radius + 1e-4F);
    }
    // What is above is outside: on the left of a line that runs clockwise in a picture with y down.
    EXPECT_LT(area_on_the_left(lines, 0), 0);
    EXPECT_NEAR(-area_on_the_left(lines, 0) / 2, 3.14159 * radius * radius, 3.2);
  }
}

TEST(IsoLines, OfAPlaneAreStraightAndOpen) {
  const Field field(9, 6, [](int x, int) { return x; });
  const IsoLines lines = iso_lines(field.view(), 2.25F);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_FALSE(lines.closed[0]);
  ASSERT_EQ(lines.points.size(), 6U);
  for (const glm::vec2& point : lines.points) EXPECT_EQ(point.x, 2.25F);
  // What is above is on the left of a line that runs down.
  EXPECT_EQ(lines.points.front().y, 0);
  EXPECT_EQ(lines.points.back().y, 5);
}

TEST(IsoLines, SaddlesAreDecidedByTheBilinearMiddle) {
  // Above are upper left and lower right; the middle value is (ac - bd) / (a + c - b - d).
  const auto lines_of = [](float a, float b, float c, float d) {
    const Field field(2, 2, [&](int x, int y) { return y == 0 ? (x == 0 ? a : b) : (x == 0 ? d : c); });
    return iso_lines(field.view(), 0);
  };
  const IsoLines joined = lines_of(3, -1, 3, -1);  // 8/8 > 0: they meet, the lines go around the lower corners
  ASSERT_EQ(joined.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const glm::vec2 middle = 0.5F * (joined.points[2 * i] + joined.points[2 * i + 1]);
    EXPECT_GT(std::abs(middle.x - middle.y), 0.5F) << "around the upper right or the lower left corner";
  }
  const IsoLines apart = lines_of(1, -3, 1, -3);
  ASSERT_EQ(apart.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const glm::vec2 middle = 0.5F * (apart.points[2 * i] + apart.points[2 * i + 1]);
    EXPECT_LT(std::abs(middle.x - middle.y), 0.5F);
  }
}

TEST(IsoLines, EndWhereSamplesAreNotFinite) {
  Field field(20, 20, [](int x, int y) { return x + 0.1 * y; });
  field.values[10 * 20 + 9] = std::numeric_limits<float>::quiet_NaN();
  field.values[3 * 20 + 10] = std::numeric_limits<float>::infinity();
  const IsoLines lines = iso_lines(field.view(), 10);
  EXPECT_EQ(lines.size(), 3U);
  for (const glm::vec2& point : lines.points) EXPECT_TRUE(std::isfinite(point.x) && std::isfinite(point.y));
}

TEST(IsoLines, NothingOfNothing) {
  const Field field(1, 5, [](int, int y) { return y; });
  EXPECT_EQ(iso_lines(field.view(), 2).size(), 0U);
  EXPECT_EQ(iso_lines({}, 2).size(), 0U);
  const Field flat(5, 5, [](int, int) { return 1; });
  EXPECT_EQ(iso_lines(flat.view(), 1).size(), 0U) << "what has the level is above";
  EXPECT_EQ(iso_lines(flat.view(), NAN).size(), 0U);
}

/// Crossings of grid edges, counted by hand, and lines that never leave a cell between two points.
TEST(IsoLines, PassEachCrossingOnce) {
  std::mt19937 random(3);
  for (int round = 0; round < 200; ++round) {
    SCOPED_TRACE(round);
    const int width = 2 + static_cast<int>(random() % 30);
    const int height = 2 + static_cast<int>(random() % 30);
    // Whole numbers: levels that samples have, saddles, plateaus.
    const Field field(width, height, [&](int, int) { return static_cast<int>(random() % 5); });
    const auto above = [&](int x, int y) { return field.values[static_cast<std::size_t>(y * width + x)] >= 2; };
    std::size_t crossings = 0;
    std::size_t at_edges = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        if (x + 1 < width && above(x, y) != above(x + 1, y)) {
          ++crossings;
          at_edges += y == 0 || y == height - 1 ? 1 : 0;
        }
        if (y + 1 < height && above(x, y) != above(x, y + 1)) {
          ++crossings;
          at_edges += x == 0 || x == width - 1 ? 1 : 0;
        }
      }
    }
    const IsoLines lines = iso_lines(field.view(), 2);
    EXPECT_EQ(lines.points.size(), crossings);
    std::size_t ends = 0;
    for (std::size_t line = 0; line < lines.size(); ++line) {
      if (lines.closed[line] == 0) ends += 2;
      ASSERT_GE(lines.starts[line + 1] - lines.starts[line], 2U);
      for (std::size_t i = lines.starts[line] + 1; i < lines.starts[line + 1]; ++i) {
        const glm::vec2 step = lines.points[i] - lines.points[i - 1];
        EXPECT_LE(std::max(std::abs(step.x), std::abs(step.y)), 1.0F);
      }
    }
    EXPECT_EQ(ends, at_edges);
  }
}

}  // namespace
}  // namespace azulejo
