#include "azulejo/rendering/clip.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

namespace azulejo {
namespace {

/// A picture of 200×100.
const ScreenTransform kTransform = screen_transform({0, 0, 200, 100});

using Corners = std::array<glm::vec4, 3>;

float between(std::mt19937& random, double low, double high) {
  return static_cast<float>(std::uniform_real_distribution<double>(low, high)(random));
}

/// A corner inside, behind the camera, before the near plane, beyond the far one, or far beside the picture.
glm::vec4 corner(std::mt19937& random) {
  const float w = between(random, 0.5, 3);
  const glm::vec4 inside(w * between(random, -1, 1), w * between(random, -1, 1), w * between(random, 0.01, 0.99), w);
  switch (random() % 5) {
    case 0: return {inside.x, inside.y, between(random, 0.1, 1), between(random, -3, -0.1)};
    case 1: return {inside.x, inside.y, w * between(random, 1.01, 2), w};
    case 2: return {inside.x, inside.y, between(random, -1, -0.01), w};
    case 3: return {inside.x + 30000 * between(random, -1, 1), inside.y + 30000 * between(random, -1, 1), inside.z, w};
    default: return inside;
  }
}

bool is_inside(const glm::vec4& c) { return !std::isnan(to_screen(c, kTransform).x); }

/// 4·10⁻³ is half the distance of floats at the guard band.
void expect_inside(const ScreenVertex& v) {
  EXPECT_LE(std::fabs(v.x), kGuardBand + 0.004F);
  EXPECT_LE(std::fabs(v.y), kGuardBand + 0.004F);
  EXPECT_GE(v.z, 0);
  EXPECT_LE(v.z, 1);
  EXPECT_GT(v.inverse_w, 0);
}

/// Whether a point of the picture, by the triangle's homogeneous edges, is inside the triangle, between near and far:
/// positive by how much, in pixels and in depth.
double insideness(const Corners& corners, double x, double y) {
  glm::dvec3 c[3];
  for (std::size_t k = 0; k < 3; ++k) {
    c[k] = {corners[k].x * static_cast<double>(kTransform.scale_x) +
                corners[k].w * static_cast<double>(kTransform.offset_x),
            corners[k].y * static_cast<double>(kTransform.scale_y) +
                corners[k].w * static_cast<double>(kTransform.offset_y),
            corners[k].w};
  }
  const double whole = glm::dot(c[0], glm::cross(c[1], c[2]));
  double least = 1e9;
  double depth = 0;
  double w = 0;
  for (int k = 0; k < 3; ++k) {
    const glm::dvec3 line = glm::cross(c[(k + 1) % 3], c[(k + 2) % 3]) * (whole < 0 ? -1.0 : 1.0);
    const double weight = glm::dot(line, glm::dvec3(x, y, 1));
    least = std::min(least, weight / std::hypot(line.x, line.y));
    depth += weight * static_cast<double>(corners[static_cast<std::size_t>(k)].z);
    w += weight * static_cast<double>(corners[static_cast<std::size_t>(k)].w);
  }
  return std::min({least, depth / w * 100, (1 - depth / w) * 100});
}

/// By how far a point is inside a convex polygon, in pixels.
double insideness(const ClippedPolygon& polygon, double x, double y) {
  double area = 0;
  double least = 1e9;
  const auto n = static_cast<std::size_t>(polygon.count);
  for (int pass = 0; pass < 2; ++pass) {
    for (std::size_t i = 0; i < n; ++i) {
      const ScreenVertex& a = polygon.vertices[i];
      const ScreenVertex& b = polygon.vertices[(i + 1) % n];
      const double ex = static_cast<double>(b.x) - a.x;
      const double ey = static_cast<double>(b.y) - a.y;
      const double side = ex * (y - a.y) - ey * (x - a.x);
      if (pass == 0) area += static_cast<double>(a.x) * b.y - static_cast<double>(a.y) * b.x;
      if (pass == 1 && std::hypot(ex, ey) > 0) least = std::min(least, side * (area < 0 ? -1 : 1) / std::hypot(ex, ey));
    }
  }
  return n < 3 ? -1e9 : least;
}

TEST(Clip, WhatIsLeftIsInsideAndCoversThePictureAsTheTriangleDoes) {
  std::mt19937 random(1);
  int clipped = 0;
  int inside_points = 0;
  int outside_points = 0;
  for (int round = 0; round < 20000; ++round) {
    const Corners corners = {corner(random), corner(random), corner(random)};
    const ClippedPolygon polygon = clip_triangle(corners, kTransform);
    ASSERT_LE(polygon.count, ClippedPolygon::kMost);
    for (int i = 0; i < polygon.count; ++i) expect_inside(polygon.vertices[static_cast<std::size_t>(i)]);
    if (polygon.count > 0 && !std::all_of(corners.begin(), corners.end(), is_inside)) ++clipped;
    for (int p = 0; p < 8; ++p) {
      const double x = static_cast<double>(between(random, -50, 250));
      const double y = static_cast<double>(between(random, -50, 150));
      const double wanted = insideness(corners, x, y);
      // A corner at the guard band is off by 1/256 pixel, and in depth by what that means on a steep triangle.
      if (!(std::fabs(wanted) > 0.05)) continue;
      (wanted > 0 ? inside_points : outside_points) += 1;
      const double got = insideness(polygon, x, y);
      EXPECT_EQ(got > 0, wanted > 0) << "round " << round << ": " << got << " for " << wanted;
    }
  }
  EXPECT_GT(clipped, 5000);
  EXPECT_GT(inside_points, 3000);
  EXPECT_GT(outside_points, 3000);
}

TEST(Clip, ATriangleInsideIsLeftAsItIs) {
  std::mt19937 random(2);
  for (int round = 0; round < 1000; ++round) {
    Corners corners;
    for (glm::vec4& c : corners) {
      do c = corner(random);
      while (!is_inside(c));
    }
    const ClippedPolygon polygon = clip_triangle(corners, kTransform);
    ASSERT_EQ(polygon.count, 3);
    for (std::size_t k = 0; k < 3; ++k) {
      const ScreenVertex wanted = to_screen(corners[k], kTransform);
      EXPECT_EQ(polygon.vertices[k].x, wanted.x);
      EXPECT_EQ(polygon.vertices[k].y, wanted.y);
      EXPECT_EQ(polygon.vertices[k].z, wanted.z);
      EXPECT_EQ(polygon.vertices[k].inverse_w, wanted.inverse_w);
    }
  }
}

/// Twice the signed area, y down.
double area_of(const ClippedPolygon& polygon) {
  double area = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(polygon.count); ++i) {
    const ScreenVertex& a = polygon.vertices[i];
    const ScreenVertex& b = polygon.vertices[(i + 1) % static_cast<std::size_t>(polygon.count)];
    area += static_cast<double>(a.x) * b.y - static_cast<double>(a.y) * b.x;
  }
  return area;
}

/// A triangle cut in four: the pieces' areas sum up to the whole's, all turn the same way.
TEST(Clip, AreaIsKept) {
  std::mt19937 random(3);
  int compared = 0;
  for (int round = 0; round < 5000; ++round) {
    const Corners t = {corner(random), corner(random), corner(random)};
    const auto middle = [](const glm::vec4& a, const glm::vec4& b) {
      return glm::vec4(0.5 * (glm::dvec4(a) + glm::dvec4(b)));
    };
    const glm::vec4 m[3] = {middle(t[1], t[2]), middle(t[2], t[0]), middle(t[0], t[1])};
    const double whole = area_of(clip_triangle(t, kTransform));
    double sum = 0;
    for (const Corners& part :
         {Corners{t[0], m[2], m[1]}, Corners{m[2], t[1], m[0]}, Corners{m[1], m[0], t[2]}, Corners{m[0], m[1], m[2]}}) {
      const double area = area_of(clip_triangle(part, kTransform));
      sum += area;
      // A sliver along the guard band may turn by its rounding.
      const bool sliver = std::fabs(area) <= 1e-4 * std::fabs(whole) + 2;
      EXPECT_TRUE(sliver || (area > 0) == (whole > 0)) << round;
    }
    // Corners on a boundary of 10⁵ pixels are right to 1/256 pixel; the halves of edges to 24 bits.
    EXPECT_NEAR(sum, whole, 1e-4 * std::fabs(whole) + 1e4) << round;
    if (std::fabs(whole) > 1e6) ++compared;
  }
  EXPECT_GT(compared, 500);
}

/// The corners that two triangles get on the edge that they share are the same bits, whichever way they turn.
TEST(Clip, NeighboursGetTheSameCornersOnTheirEdge) {
  std::mt19937 random(4);
  int crossings = 0;
  for (int round = 0; round < 20000; ++round) {
    const glm::vec4 a = corner(random);
    const glm::vec4 b = corner(random);
    const std::array<glm::vec4, 2> edge = {a, b};
    const ClippedPolygon alone = clip_segment(edge, kTransform);
    const ClippedPolygon back = clip_segment({b, a}, kTransform);
    ASSERT_EQ(alone.count, back.count);
    const auto same = [](const ScreenVertex& u, const ScreenVertex& v) {
      return u.x == v.x && u.y == v.y && u.z == v.z && u.inverse_w == v.inverse_w;
    };
    if (alone.count == 0) continue;
    ASSERT_EQ(alone.count, 2);
    for (const ScreenVertex& v : {alone.vertices[0], alone.vertices[1]}) expect_inside(v);
    EXPECT_TRUE(same(alone.vertices[0], back.vertices[1]) && same(alone.vertices[1], back.vertices[0])) << round;
    if (!is_inside(a) || !is_inside(b)) ++crossings;
    for (const Corners& triangle : {Corners{a, b, corner(random)}, Corners{b, a, corner(random)}}) {
      const ClippedPolygon polygon = clip_triangle(triangle, kTransform);
      for (const ScreenVertex& end : {alone.vertices[0], alone.vertices[1]}) {
        const auto last = polygon.vertices.begin() + polygon.count;
        EXPECT_TRUE(polygon.count < 3 ||
                    std::any_of(polygon.vertices.begin(), last, [&](const ScreenVertex& v) { return same(v, end); }))
            << round;
      }
    }
  }
  EXPECT_GT(crossings, 3000);
}

TEST(Clip, WhatIsNotFiniteOrOutsideLeavesNothing) {
  const Corners inside = {glm::vec4(0, 0, 0.5F, 1), glm::vec4(0.5F, 0, 0.5F, 1), glm::vec4(0, 0.5F, 0.5F, 1)};
  ASSERT_EQ(clip_triangle(inside, kTransform).count, 3);
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (int c = 0; c < 4; ++c) {
        Corners corners = inside;
        corners[k][c] = bad;
        EXPECT_EQ(clip_triangle(corners, kTransform).count, 0);
        EXPECT_EQ(clip_segment({corners[k], inside[(k + 1) % 3]}, kTransform).count, 0);
      }
    }
  }
  Corners behind = inside;
  for (glm::vec4& c : behind) c.w = -1;
  EXPECT_EQ(clip_triangle(behind, kTransform).count, 0);
  EXPECT_EQ(clip_triangle({glm::vec4(0), glm::vec4(0), glm::vec4(0)}, kTransform).count, 0);
  Corners beyond = inside;
  for (glm::vec4& c : beyond) c.z = -0.1F;
  EXPECT_EQ(clip_triangle(beyond, kTransform).count, 0);
}

}  // namespace
}  // namespace azulejo
