#include "azulejo/rendering/raster.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>
#include <hwy/highway.h>

namespace azulejo {
namespace {

using Triangle = std::array<ScreenVertex, 3>;

ScreenVertex at(double x, double y, double z = 0.5) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), 1};
}

double below(std::mt19937& random, unsigned count) { return static_cast<double>(random() % count); }

VisibilityBuffer buffer_at(int x, int y, int samples, int log2 = 6) {
  VisibilityBuffer buffer;
  buffer.origin_x = x;
  buffer.origin_y = y;
  buffer.log2 = log2;
  buffer.right = buffer.bottom = buffer.size();
  buffer.samples = sample_pattern(samples);
  buffer.prepare();
  return buffer;
}

/// In 1/256 pixel: coordinates of 26 bits at most, whose products are exact.
struct Point {
  std::int64_t x;
  std::int64_t y;
};

Point snapped(const ScreenVertex& v) {
  return {static_cast<std::int64_t>(std::nearbyint(static_cast<double>(v.x) * kSubpixels)),
          static_cast<std::int64_t>(std::nearbyint(static_cast<double>(v.y) * kSubpixels))};
}

std::int64_t cross(const Point& a, const Point& b, const Point& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// The rule as it is defined: strictly inside, or on an edge that is a top or a left one. Corners run clockwise as seen
/// (y down), so the inside is where all crosses are positive; a top edge runs to the right and a left edge upward.
bool inside_by_definition(const Triangle& triangle, const Point& p) {
  Point v[3] = {snapped(triangle[0]), snapped(triangle[1]), snapped(triangle[2])};
  const std::int64_t area = cross(v[0], v[1], v[2]);
  if (area == 0) return false;
  if (area < 0) std::swap(v[1], v[2]);
  for (int i = 0; i < 3; ++i) {
    const Point& a = v[i];
    const Point& b = v[(i + 1) % 3];
    const std::int64_t side = cross(a, b, p);
    const bool top = a.y == b.y && b.x > a.x;
    const bool left = b.y < a.y;
    if (side < 0 || (side == 0 && !top && !left)) return false;
  }
  return true;
}

Point sample_point(const VisibilityBuffer& buffer, std::size_t s, int column, int row) {
  return {static_cast<std::int64_t>(buffer.origin_x + column) * kSubpixels + buffer.samples[s].x,
          static_cast<std::int64_t>(buffer.origin_y + row) * kSubpixels + buffer.samples[s].y};
}

/// Every sample of the tile is drawn if and only if the definition says so.
testing::AssertionResult drawn_by_definition(const VisibilityBuffer& buffer, const Triangle& triangle) {
  for (std::size_t s = 0; s < buffer.samples.size(); ++s) {
    for (int row = 0; row < buffer.size(); ++row) {
      for (int column = 0; column < buffer.size(); ++column) {
        const bool drawable =
            column >= buffer.left && column < buffer.right && row >= buffer.top && row < buffer.bottom;
        const bool wanted = drawable && inside_by_definition(triangle, sample_point(buffer, s, column, row));
        const std::size_t index =
            s * buffer.pixels() + (static_cast<std::size_t>(row) << buffer.log2) + static_cast<std::size_t>(column);
        const bool drawn = buffer.triangle[index] != kNoTriangle;
        if (drawn == wanted) continue;
        return testing::AssertionFailure()
               << "sample " << s << " of pixel " << column << ", " << row << " is " << (drawn ? "drawn" : "not drawn")
               << " for (" << triangle[0].x << ", " << triangle[0].y << ") (" << triangle[1].x << ", " << triangle[1].y
               << ") (" << triangle[2].x << ", " << triangle[2].y << ")";
      }
    }
  }
  return testing::AssertionSuccess();
}

void draw(VisibilityBuffer& buffer, const std::vector<Triangle>& triangles, std::uint32_t first = 0) {
  std::vector<ScreenVertex> vertices;
  for (const Triangle& each : triangles) vertices.insert(vertices.end(), each.begin(), each.end());
  std::vector<std::uint32_t> corners(vertices.size());
  std::iota(corners.begin(), corners.end(), 0);
  std::vector<std::uint32_t> numbers(triangles.size());
  std::iota(numbers.begin(), numbers.end(), first);
  kernels::raster_triangles(buffer, vertices.data(), corners.data(), first, numbers, nullptr);
}

/// Every triangle with corners on the half and whole pixels of a 2×2 square, and on odd subpixels beside them.
TEST(Raster, EverySmallTriangleCoversWhatTheRuleSays) {
  std::vector<double> places = {0, 0.25, 0.5, 0.50390625, 1, 1.5, 2};
  std::vector<ScreenVertex> points;
  for (const double y : places) {
    for (const double x : places) points.push_back(at(x + 5, y + 9));
  }
  VisibilityBuffer buffer = buffer_at(0, 0, 1, 4);
  static constexpr std::uint32_t kCorners[] = {0, 1, 2};
  int tried = 0;
  for (std::size_t a = 0; a < points.size(); ++a) {
    for (std::size_t b = 0; b < points.size(); b += 1) {
      for (std::size_t c = 0; c < points.size(); c += 1) {
        buffer.prepare();
        const Triangle triangle{points[a], points[b], points[c]};
        // Both ways to draw: one by one, and in vectors.
        if (tried % 2 == 0) {
          kernels::raster_triangle(buffer, triangle, 0, nullptr);
        } else {
          kernels::raster_triangles(buffer, triangle.data(), kCorners, 0, std::span(kCorners, 1), nullptr);
        }
        // Only the pixels around can be drawn; the exact rule is slow.
        for (int row = 8; row <= 12; ++row) {
          for (int column = 4; column <= 8; ++column) {
            const bool drawn = buffer.triangle[static_cast<std::size_t>(row * 16 + column)] != kNoTriangle;
            ASSERT_EQ(drawn, inside_by_definition(triangle, sample_point(buffer, 0, column, row)))
                << a << " " << b << " " << c << " at " << column << ", " << row;
          }
        }
        ++tried;
      }
    }
  }
  EXPECT_EQ(tried, 49 * 49 * 49);
}

TEST(Raster, RandomTrianglesOfAllSizesCoverWhatTheRuleSays) {
  std::mt19937 random(7);
  for (const int samples : {1, 4, 8, 16}) {
    for (int round = 0; round < 120; ++round) {
      VisibilityBuffer buffer = buffer_at(static_cast<int>(random() % 3000), static_cast<int>(random() % 2000), samples,
                                          round % 2 == 0 ? 5 : 6);
      if (round % 3 == 0) {
        buffer.left = static_cast<int>(random() % 5);
        buffer.top = static_cast<int>(random() % 9);
        buffer.right -= static_cast<int>(random() % 7);
        buffer.bottom -= static_cast<int>(random() % 11);
      }
      const double reach = round % 4 == 0 ? 120000 : round % 4 == 1 ? 500 : round % 4 == 2 ? 60 : 4;
      const auto coordinate = [&](int origin) {
        return std::clamp(origin + 32 + std::uniform_real_distribution<double>(-reach, reach)(random), -131072.0,
                          131072.0);
      };
      Triangle triangle;
      for (ScreenVertex& v : triangle) v = at(coordinate(buffer.origin_x), coordinate(buffer.origin_y));
      kernels::raster_triangle(buffer, triangle, 3, nullptr);
      ASSERT_TRUE(drawn_by_definition(buffer, triangle)) << "round " << round;
      VisibilityBuffer in_list = buffer;
      in_list.prepare();
      draw(in_list, {triangle}, 3);
      ASSERT_TRUE(
          std::equal(buffer.triangle.begin(),
                     buffer.triangle.begin() + static_cast<std::ptrdiff_t>(buffer.pixels() * buffer.samples.size()),
                     in_list.triangle.begin()));
    }
  }
}

/// A fan around a point, with random rays: its triangles share all their edges.
TEST(Raster, SharedEdgesAreDrawnOnceAndLeaveNoGap) {
  std::mt19937 random(11);
  for (int round = 0; round < 60; ++round) {
    const int samples = round % 2 == 0 ? 1 : 8;
    VisibilityBuffer buffer = buffer_at(640, 320, samples);
    const ScreenVertex middle = at(672 + below(random, 4096) / 512.0 - 4, 352 + below(random, 4096) / 512.0 - 4);
    std::vector<double> angles(3 + random() % 30);
    for (double& angle : angles) angle = std::uniform_real_distribution<double>(0, 6.28318530717958648)(random);
    for (int k = 0; k < 3; ++k) angles.push_back(k * 2.1);  // no gap of half a turn
    std::sort(angles.begin(), angles.end());
    std::vector<int> hits(buffer.pixels() * buffer.samples.size(), 0);
    const double radius = round % 3 == 0 ? 30000 : 300;
    for (std::size_t i = 0; i < angles.size(); ++i) {
      const double from = angles[i];
      const double to = angles[(i + 1) % angles.size()];
      const Triangle triangle{middle, at(672 + radius * std::cos(from), 352 + radius * std::sin(from)),
                              at(672 + radius * std::cos(to), 352 + radius * std::sin(to))};
      VisibilityBuffer single = buffer_at(640, 320, samples);
      kernels::raster_triangle(single, triangle, 0, nullptr);
      for (std::size_t p = 0; p < hits.size(); ++p) hits[p] += single.triangle[p] != kNoTriangle ? 1 : 0;
    }
    EXPECT_TRUE(std::all_of(hits.begin(), hits.end(), [](int n) { return n == 1; })) << "round " << round;
  }
}

/// z = z0 + e1 k1 + e2 k2: three roundings of terms below the largest depth, and those of positions: a subpixel at most.
TEST(Raster, DepthIsThePlanesAtTheSample) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> depth(0, 1);
  for (int round = 0; round < 200; ++round) {
    VisibilityBuffer buffer = buffer_at(64, 128, 4, 5);
    const double reach = round % 2 == 0 ? 20 : 400;
    const auto place = [&](int origin) {
      return std::nearbyint((origin + 16 + std::uniform_real_distribution<double>(-reach, reach)(random)) * 256) / 256;
    };
    Triangle t;
    for (ScreenVertex& v : t) v = at(place(64), place(128), depth(random));
    const double area = (static_cast<double>(t[1].x) - t[0].x) * (static_cast<double>(t[2].y) - t[0].y) -
                        (static_cast<double>(t[2].x) - t[0].x) * (static_cast<double>(t[1].y) - t[0].y);
    if (std::fabs(area) < 4) continue;
    kernels::raster_triangle(buffer, t, 1, nullptr);
    for (std::size_t i = 0; i < buffer.pixels() * 4; ++i) {
      if (buffer.triangle[i] == kNoTriangle) continue;
      const std::size_t s = i / buffer.pixels();
      const double x = 64 + static_cast<double>(i % 32) + buffer.samples[s].x / 256.0 - t[0].x;
      const double y = 128 + static_cast<double>(i % buffer.pixels() / 32) + buffer.samples[s].y / 256.0 - t[0].y;
      const double b1 =
          (x * (static_cast<double>(t[2].y) - t[0].y) - y * (static_cast<double>(t[2].x) - t[0].x)) / area;
      const double b2 =
          (y * (static_cast<double>(t[1].x) - t[0].x) - x * (static_cast<double>(t[1].y) - t[0].y)) / area;
      const double wanted =
          t[0].z + b1 * (static_cast<double>(t[1].z) - t[0].z) + b2 * (static_cast<double>(t[2].z) - t[0].z);
      EXPECT_NEAR(buffer.depth[i], wanted, 1e-6) << "round " << round;
    }
  }
}

TEST(Raster, TheNearerIsSeenAndOfTwoAtOneDepthTheFirst) {
  VisibilityBuffer buffer = buffer_at(0, 0, 1);
  const auto whole = [](float z) { return Triangle{at(-10, -10, z), at(300, -10, z), at(-10, 300, z)}; };
  draw(buffer, {whole(0.25F), whole(0.75F), whole(0.5F), whole(0.75F)});
  EXPECT_TRUE(
      std::all_of(buffer.triangle.begin(), buffer.triangle.begin() + 4096, [](std::uint32_t t) { return t == 1; }));
}

TEST(Raster, CoveredSamplesAreThoseThatWouldBeDrawn) {
  std::mt19937 random(3);
  for (int round = 0; round < 50; ++round) {
    VisibilityBuffer buffer = buffer_at(0, 0, round % 2 == 0 ? 1 : 4);
    draw(buffer, {{at(0, 0, 0.3), at(64, 0, 0.6), at(0, 64, 0.9)}});
    Triangle t;
    for (ScreenVertex& v : t) v = at(below(random, 64), below(random, 64), below(random, 100) / 100.0);
    std::vector<CoveredSample> covered;
    kernels::cover_triangle(buffer, t, covered);
    VisibilityBuffer drawn = buffer;
    kernels::raster_triangle(drawn, t, 9, nullptr);
    std::size_t changed = 0;
    for (std::size_t i = 0; i < drawn.pixels() * drawn.samples.size(); ++i) changed += drawn.triangle[i] == 9 ? 1U : 0U;
    ASSERT_EQ(covered.size(), changed);
    for (const CoveredSample& sample : covered) {
      EXPECT_EQ(drawn.triangle[sample.at], 9U);
      EXPECT_EQ(drawn.depth[sample.at], sample.depth);
    }
  }
}

/// A list in vectors, with sizes around the number of lanes, some without area, some large: as one by one.
TEST(Raster, ListsOfAnyLengthAreAsTheirTrianglesOneByOneOnEveryVectorTarget) {
  std::mt19937 random(23);
  for (const std::int64_t vector_target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(vector_target);
    for (std::size_t length = 0; length < 40; ++length) {
      std::vector<Triangle> triangles(length);
      for (Triangle& t : triangles) {
        const double size = random() % 16 == 0 && length % 3 == 0 ? 300 : 5;
        const double x = below(random, 64);
        const double y = below(random, 64);
        for (ScreenVertex& v : t) {
          v = at(x + std::uniform_real_distribution<double>(-size, size)(random),
                 y + std::uniform_real_distribution<double>(-size, size)(random), below(random, 1000) / 1000.0);
        }
        if (random() % 8 == 0) t[2] = t[1];
      }
      const int samples = length % 2 == 0 ? 1 : 4;
      VisibilityBuffer list = buffer_at(0, 0, samples);
      draw(list, triangles);
      VisibilityBuffer single = buffer_at(0, 0, samples);
      for (std::uint32_t i = 0; i < length; ++i) kernels::raster_triangle(single, triangles[i], i, nullptr);
      const auto end = static_cast<std::ptrdiff_t>(list.pixels() * list.samples.size());
      ASSERT_TRUE(std::equal(list.triangle.begin(), list.triangle.begin() + end, single.triangle.begin())) << length;
      ASSERT_TRUE(std::equal(list.depth.begin(), list.depth.begin() + end, single.depth.begin())) << length;
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace
}  // namespace azulejo
