#include "azulejo/modelling/polygon.h"

#include <chrono>
#include <limits>
#include <string>

#include "azulejo/core/error.h"
#include "azulejo/modelling/polygon_testing.h"

namespace azulejo {
namespace {

using namespace polygon_testing;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// What snapping may change: each line moves by less than a step, half of it at its ends.
double tolerance(const Polygon& polygon) { return 1.5 * grid_step(polygon) * perimeter(polygon); }

/// Triangles and rings are sound and have the area of brute force, by both rules.
void expect_right(const Polygon& polygon) {
  for (const FillRule rule : {FillRule::NonZero, FillRule::EvenOdd}) {
    const double area = brute_area(polygon, rule);
    const TriangulatedPolygon triangles = tessellate(polygon, rule);
    expect_sound(triangles);
    ASSERT_NEAR(area_of(triangles), area, tolerance(polygon));
    const Polygon rings = simplified(polygon, rule);
    ASSERT_NEAR(signed_area(rings), area_of(triangles), 1e-9 * area + 1e-30);  // the same, but for the sums' rounding
    for (std::size_t r = 0; r < rings.ring_count(); ++r) ASSERT_TRUE(is_simple(rings.ring(r)));
    // What is simplified is left as it is.
    ASSERT_EQ(signed_area(simplified(rings, rule)), signed_area(rings));
  }
}

/// The middles of triangles are inside.
void expect_inside(const Polygon& polygon, FillRule rule, const TriangulatedPolygon& triangles) {
  const std::vector<Line> lines = lines_of(polygon);
  for (std::size_t t = 0; t < triangles.corners.size(); t += 3) {
    glm::dvec2 middle(0);
    for (std::size_t i = 0; i < 3; ++i) middle += glm::dvec2(triangles.points[triangles.corners[t + i]]) / 3.0;
    ASSERT_TRUE(polygon_testing::is_inside(rule, winding(lines, middle)));
  }
}

TEST(Polygon, ATriangleIsATriangle) {
  const TriangulatedPolygon result = tessellate(polygon_of({{{0, 0}, {2, 0}, {1, 1}}}));
  EXPECT_EQ(result.points, (Array<glm::vec2>{{0, 0}, {1, 1}, {2, 0}}));
  ASSERT_EQ(result.corners.size(), 3U);
  EXPECT_EQ(area_of(result), 1);
  EXPECT_EQ(area_of(tessellate(polygon_of({{{0, 0}, {1, 1}, {2, 0}}}))), 1);  // the other way around, too
}

TEST(Polygon, SimplePolygonsWithHolesGiveTheirTriangles) {
  // n points and h holes: n + 2 h − 2 triangles.
  const Polygon ring = polygon_of({square(0, 0, 10), reversed(square(2, 2, 3)), reversed(square(6, 6, 2))});
  const TriangulatedPolygon result = tessellate(ring);
  EXPECT_EQ(result.corners.size(), 3U * (12 + 4 - 2));
  EXPECT_EQ(area_of(result), 100 - 9 - 4);
  expect_sound(result);
  expect_inside(ring, FillRule::NonZero, result);
}

TEST(Polygon, RulesTellWhatIsInside) {
  // The pentagram, and two squares one in the other of the same direction.
  Ring pentagram;
  for (int i = 0; i < 5; ++i) {
    const double angle = 2 * std::numbers::pi * 2 * i / 5;
    pentagram.emplace_back(1000 * std::cos(angle), 1000 * std::sin(angle));
  }
  expect_right(polygon_of({pentagram}));
  const Polygon squares = polygon_of({square(0, 0, 4), square(1, 1, 2)});
  EXPECT_EQ(area_of(tessellate(squares, FillRule::NonZero)), 16);
  EXPECT_EQ(area_of(tessellate(squares, FillRule::EvenOdd)), 12);
  EXPECT_EQ(tessellate(squares, FillRule::NonZero).points.size(), 4U);  // no edge inside is left
}

TEST(Polygon, TouchingAndDegenerateRings) {
  expect_right(polygon_of({square(0, 0, 1), square(1, 1, 1)}));                          // in a corner
  expect_right(polygon_of({square(0, 0, 1), square(1, 0, 1)}));                          // along a side
  expect_right(polygon_of({square(0, 0, 1), square(1, 0.5F, 1)}));                       // along a part of it
  expect_right(polygon_of({square(0, 0, 4), reversed({{0, 2}, {2, 1}, {2, 3}})}));       // a hole on the outline
  expect_right(polygon_of({square(0, 0, 4), reversed({{0, 0}, {2, 1}, {1, 2}})}));       // in its corner
  expect_right(polygon_of({square(0, 0, 4), reversed({{0, 0}, {4, 4}, {1, 3}})}));       // that divides it
  expect_right(polygon_of({square(0, 0, 1), square(0, 0, 1)}));                          // twice
  expect_right(polygon_of({square(0, 0, 1), reversed(square(0, 0, 1))}));                // and back
  expect_right(polygon_of({{{0, 0}, {2, 0}, {2, 2}, {1, 2}, {1, 5}, {1, 2}, {0, 2}}}));  // a whisker
  expect_right(polygon_of({{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 3}, {3, 1}, {1, 3}, {0, 3}}}));
  expect_right(polygon_of({{{0, 0}, {0, 0}, {2, 0}, {2, 0}, {2, 0}, {1, 2}, {0, 0}}}));
  for (const Polygon& nothing : {Polygon(), polygon_of({{}}), polygon_of({{{1, 1}}}), polygon_of({{{0, 0}, {1, 1}}}),
                                 polygon_of({{{0, 0}, {1, 1}, {2, 2}}}), polygon_of({{{3, 3}, {3, 3}, {3, 3}, {3, 3}}}),
                                 polygon_of({{{0, 0}, {5, 5}, {1, 1}, {3, 3}, {2, 2}}})}) {
    EXPECT_TRUE(tessellate(nothing).corners.empty());
    EXPECT_EQ(simplified(nothing).ring_count(), 0U);
  }
  EXPECT_EQ(simplified(polygon_of({square(0, 0, 1), square(1, 1, 1)})).ring_count(), 2U);
  EXPECT_EQ(simplified(polygon_of({square(0, 0, 4), reversed({{0, 2}, {2, 1}, {2, 3}})})).ring_count(), 2U);
}

TEST(Polygon, LeavesOutPointsThatAreNotFinite) {
  const Polygon with = polygon_of({{{0, 0}, {kNan, 7}, {2, 0}, {2, kInfinity}, {2, 2}, {0, 2}, {-kInfinity, 0}}});
  EXPECT_EQ(area_of(tessellate(with)), 4);
  EXPECT_EQ(signed_area(with), 4);
  EXPECT_TRUE(tessellate(polygon_of({{{kNan, kNan}, {1, kNan}, {0, 0}}})).corners.empty());
  // The largest and the smallest of floats.
  const float top = std::numeric_limits<float>::max();
  EXPECT_EQ(tessellate(polygon_of({{{-top, -top}, {top, -top}, {top, top}, {-top, top}}})).corners.size(), 6U);
  const float least = std::numeric_limits<float>::denorm_min();
  EXPECT_EQ(area_of(tessellate(polygon_of({{{0, 0}, {least, 0}, {least, least}, {0, least}}}))), 0x1p-298);
}

TEST(Polygon, RandomCrossingRingsHaveTheAreaOfBruteForce) {
  for (unsigned seed = 0; seed < 1500; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const float scale = seed % 5 == 0 ? 1e9F : seed % 5 == 1 ? 1e-20F : 1000;
    const float offset = seed % 7 == 0 ? 3 * scale : 0;
    std::uniform_real_distribution<float> place(-scale + offset, scale + offset);
    Polygon polygon;
    for (std::size_t rings = 1 + seed % 3; rings-- > 0;) {
      Ring ring;
      for (std::size_t points = 3 + random() % 12; points-- > 0;) ring.emplace_back(place(random), place(random));
      polygon.add_ring(ring);
    }
    expect_right(polygon);
  }
}

TEST(Polygon, LatticePolygonsTouchAndOverlapEverywhere) {
  for (unsigned seed = 0; seed < 3000; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const unsigned size = 2 + seed % 9;
    const auto place = [&] { return static_cast<float>(random() % size); };
    Polygon polygon;
    for (std::size_t rings = 1 + seed % 4; rings-- > 0;) {
      Ring ring;
      for (std::size_t points = 3 + random() % 12; points-- > 0;) ring.emplace_back(place(), place());
      polygon.add_ring(ring);
    }
    expect_right(polygon);
  }
}

/// Coordinates of the last places: nearly every line passes squares of others, and is bent.
TEST(Polygon, LinesBentToTheGridNeverCross) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const unsigned size = 5 + seed % 60;
    const auto place = [&] { return 0x1p24F - 1 - static_cast<float>(random() % size); };  // the step is 1
    Polygon polygon;
    for (std::size_t rings = 1 + seed % 3; rings-- > 0;) {
      Ring ring;
      for (std::size_t points = 3 + random() % 30; points-- > 0;) ring.emplace_back(place(), place());
      polygon.add_ring(ring);
    }
    for (const FillRule rule : {FillRule::NonZero, FillRule::EvenOdd}) {
      const TriangulatedPolygon triangles = tessellate(polygon, rule);
      expect_sound(triangles);
      ASSERT_NEAR(area_of(triangles), brute_area(polygon, rule), tolerance(polygon));
      ASSERT_EQ(signed_area(simplified(polygon, rule)), area_of(triangles));
    }
  }
}

TEST(Polygon, StarsCombsAndSpiralsGiveNMinusTwoTriangles) {
  std::mt19937 random(5);
  for (const std::size_t count : {10U, 1000U, 50000U}) {
    for (const Ring& ring : {star(count, 0.4F, 1), star(count, 0.2F, 1, &random), comb(count), spiral(2 * count, 8)}) {
      const Polygon polygon = polygon_of({ring});
      const TriangulatedPolygon triangles = tessellate(polygon);
      ASSERT_EQ(triangles.corners.size(), 3 * (ring.size() - 2));
      expect_sound(triangles);
      ASSERT_NEAR(area_of(triangles), std::abs(signed_area(ring)), tolerance(polygon));
      ASSERT_TRUE(is_simple(ring));
    }
  }
}

TEST(Polygon, AHundredThousandSmallOnes) {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> place(0, 1000);
  for (int i = 0; i < 100000; ++i) {
    Ring ring;
    for (std::size_t points = 3 + random() % 6; points-- > 0;) ring.emplace_back(place(random), place(random));
    if (i % 3 == 0) ring.insert(ring.begin() + 1, ring[0]);
    if (i % 4 == 0) ring.push_back(ring[1]);
    const Polygon polygon = polygon_of({ring});
    const TriangulatedPolygon odd = tessellate(polygon, FillRule::EvenOdd);
    expect_sound(odd);
    const TriangulatedPolygon all = tessellate(polygon, FillRule::NonZero);
    expect_sound(all);
    ASSERT_NEAR(area_of(odd), brute_area(polygon, FillRule::EvenOdd), tolerance(polygon)) << i;
    ASSERT_NEAR(area_of(all), brute_area(polygon, FillRule::NonZero), tolerance(polygon)) << i;
  }
}

TEST(Polygon, NestedHolesToAnyDepth) {
  Polygon polygon;
  double area = 0;
  const int depth = 2000;
  for (int i = 0; i < depth; ++i) {
    const auto inset = static_cast<float>(i);
    const float size = 2.0F * static_cast<float>(depth - i);
    polygon.add_ring(i % 2 == 0 ? square(inset, inset, size) : reversed(square(inset, inset, size)));
    area += (i % 2 == 0 ? 1 : -1) * double{size} * size;
  }
  EXPECT_EQ(area_of(tessellate(polygon)), area);
  EXPECT_EQ(area_of(tessellate(polygon, FillRule::EvenOdd)), area);
  EXPECT_EQ(simplified(polygon).ring_count(), static_cast<std::size_t>(depth));
}

TEST(Polygon, TooManyCrossingsAreRefused) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> place(0, 1);
  Ring ring;
  for (int i = 0; i < 3000; ++i) ring.emplace_back(place(random), place(random));
  azulejo::Run run;
  run.limits.memory_bytes = 1 << 20;
  try {
    tessellate(polygon_of({ring}), FillRule::NonZero, run);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Error::Resource);
  }
}

TEST(Polygon, BooleansHaveTheAreaOfBruteForce) {
  for (unsigned seed = 0; seed < 800; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const bool lattice = seed % 2 == 0;
    std::uniform_real_distribution<float> anywhere(0, 8);
    const auto place = [&] { return lattice ? static_cast<float>(random() % 8) : anywhere(random); };
    std::array<Polygon, 2> operands;
    for (Polygon& each : operands) {
      Ring ring;
      for (std::size_t points = 3 + random() % 8; points-- > 0;) ring.emplace_back(place(), place());
      each.add_ring(ring);
      if (seed % 3 == 0) each.add_ring(square(place(), place(), 3));
    }
    const auto& [a, b] = operands;
    const double allowed = tolerance(a) + tolerance(b);
    const auto truth = [&](auto inside) {
      return brute_area({&a, &b}, [&](const std::vector<int>& w) { return inside(w[0] != 0, w[1] != 0); });
    };
    const auto area = [&](BooleanMode mode) {
      const Polygon result = boolean(a, b, mode);
      for (std::size_t r = 0; r < result.ring_count(); ++r) EXPECT_TRUE(is_simple(result.ring(r)));
      EXPECT_NEAR(area_of(tessellate(result)), signed_area(result), 1e-9);
      return signed_area(result);
    };
    EXPECT_NEAR(area(BooleanMode::Union), truth([](bool x, bool y) { return x || y; }), allowed);
    EXPECT_NEAR(area(BooleanMode::Intersection), truth([](bool x, bool y) { return x && y; }), allowed);
    EXPECT_NEAR(area(BooleanMode::Difference), truth([](bool x, bool y) { return x && !y; }), allowed);
    EXPECT_NEAR(area(BooleanMode::Xor), truth([](bool x, bool y) { return x != y; }), allowed);
  }
}

TEST(Polygon, BooleanRingsAreOutlinesAndHoles) {
  const Polygon a = polygon_of({square(0, 0, 6)});
  const Polygon b = polygon_of({square(2, 2, 2)});
  const Polygon difference = boolean(a, b, BooleanMode::Difference);
  ASSERT_EQ(difference.ring_count(), 2U);
  EXPECT_EQ(signed_area(difference.ring(0)), 36);
  EXPECT_EQ(signed_area(difference.ring(1)), -4);
  EXPECT_EQ(boolean(a, b, BooleanMode::Union).points.size(), 4U);
  EXPECT_EQ(boolean(b, a, BooleanMode::Difference).ring_count(), 0U);
  EXPECT_EQ(boolean(a, Polygon(), BooleanMode::Xor).points.size(), 4U);
  // A cut through the middle leaves two polygons.
  const Polygon halves = boolean(a, polygon_of({{{2, -1}, {3, -1}, {3, 7}, {2, 7}}}), BooleanMode::Difference);
  ASSERT_EQ(halves.ring_count(), 2U);
  EXPECT_EQ(signed_area(halves), 30);
}

TEST(Polygon, MeasuresOfRings) {
  EXPECT_EQ(signed_area(square(5, 5, 3)), 9);
  EXPECT_EQ(signed_area(reversed(square(5, 5, 3))), -9);
  EXPECT_EQ(centroid(square(5, 5, 3)), glm::dvec2(6.5));
  EXPECT_EQ(centroid(Ring{{0, 0}, {3, 0}, {0, 3}}), glm::dvec2(1));
  EXPECT_EQ(centroid(Ring{{0, 0}, {2, 2}}), glm::dvec2(1));
  EXPECT_EQ(centroid(Ring{}), glm::dvec2(0));
  EXPECT_TRUE(is_convex(square(0, 0, 1)));
  EXPECT_TRUE(is_convex(reversed(square(0, 0, 1))));
  EXPECT_TRUE(is_convex(Ring{{0, 0}, {1, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 0}}));
  EXPECT_FALSE(is_convex(Ring{{0, 0}, {4, 0}, {4, 4}, {3, 1}}));
  EXPECT_FALSE(is_convex(Ring{{0, 0}, {1, 1}, {2, 2}}));
  EXPECT_FALSE(is_convex(Ring{{0, 0}, {2, 0}, {1, 0}, {1, 1}}));  // back along itself
  EXPECT_FALSE(is_convex(Ring{{0, 0}, {1, 0}, {kNan, 1}}));
  Ring twice = star(8, 1, 1);
  twice.insert(twice.end(), twice.begin(), twice.begin() + 16);
  EXPECT_FALSE(is_convex(twice));
  EXPECT_TRUE(is_convex(star(1000, 1000, 1000)));
  // A dent of the last place.
  EXPECT_TRUE(is_convex(Ring{{0, 0}, {1, 0}, {2, 0}, {1, 3}}));
  EXPECT_FALSE(is_convex(Ring{{0, 0}, {1, 0x1p-149F}, {2, 0}, {1, 3}}));
}

TEST(Polygon, IsSimpleAgreesWithBruteForce) {
  const auto meet = [](const Line& p, const Line& q) {
    const auto sign = [](double value) { return value > 0 ? 1 : value < 0 ? -1 : 0; };
    const int a = sign(orient2d(p.a, p.b, q.a));
    const int b = sign(orient2d(p.a, p.b, q.b));
    const int c = sign(orient2d(q.a, q.b, p.a));
    const int d = sign(orient2d(q.a, q.b, p.b));
    const auto within = [](const Line& line, const glm::dvec2& x) {
      return std::min(line.a.x, line.b.x) <= x.x && x.x <= std::max(line.a.x, line.b.x) &&
             std::min(line.a.y, line.b.y) <= x.y && x.y <= std::max(line.a.y, line.b.y);
    };
    return (a * b < 0 && c * d < 0) || (a == 0 && within(p, q.a)) || (b == 0 && within(p, q.b)) ||
           (c == 0 && within(q, p.a)) || (d == 0 && within(q, p.b));
  };
  int simple = 0;
  for (unsigned seed = 0; seed < 4000; ++seed) {
    std::mt19937 random(seed);
    const unsigned size = 3 + seed % 30;
    Ring ring;
    for (std::size_t points = 3 + random() % 6; points-- > 0;) {
      ring.emplace_back(static_cast<float>(random() % size), static_cast<float>(random() % size));
    }
    const std::vector<Line> lines = lines_of(polygon_of({ring}));
    bool truth = true;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      truth = truth && lines[i].a != lines[i].b;
      for (std::size_t j = i + 1; j < lines.size(); ++j) {
        const bool follows = j == i + 1;
        const bool precedes = i == 0 && j + 1 == lines.size();
        if (!follows && !precedes) {
          truth = truth && !meet(lines[i], lines[j]);
          continue;
        }
        // Neighbours: only their common end.
        const glm::dvec2 far_i = follows ? lines[i].a : lines[i].b;
        const glm::dvec2 far_j = follows ? lines[j].b : lines[j].a;
        truth = truth && !meet({far_i, far_i}, lines[j]) && !meet({far_j, far_j}, lines[i]);
      }
    }
    EXPECT_EQ(is_simple(ring), truth) << seed;
    simple += truth;
  }
  EXPECT_GT(simple, 100);
  EXPECT_FALSE(is_simple(Ring{{0, 0}, {1, 0}}));
}

TEST(Polygon, IsPlanarExactlyOrNearly) {
  using Ring3 = std::vector<glm::vec3>;
  EXPECT_TRUE(is_planar(Ring3{{0, 0, 0}, {1, 0, 1}, {1, 1, 2}, {0, 1, 1}}));
  EXPECT_FALSE(is_planar(Ring3{{0, 0, 0}, {1, 0, 1}, {1, 1, 2}, {0, 1, 1.0000001F}}));
  EXPECT_TRUE(is_planar(Ring3{{0, 0, 0}, {1, 0, 1}, {1, 1, 2}, {0, 1, 1.0000001F}}, 1e-6F));
  EXPECT_FALSE(is_planar(Ring3{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.1F}, {0, 1, 0}}, 0.01F));
  EXPECT_TRUE(is_planar(Ring3{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}));
  EXPECT_TRUE(is_planar(Ring3{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}));
  EXPECT_FALSE(is_planar(Ring3{{0, 0, 0}, {1, 0, 0}, {1, kNan, 0}, {0, 1, 0}}));
}

}  // namespace
}  // namespace azulejo
