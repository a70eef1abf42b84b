#include "azulejo/modelling/offset.h"

#include "azulejo/modelling/classify_points.h"
#include "azulejo/modelling/polygon_testing.h"

namespace azulejo {
namespace {

using namespace polygon_testing;

TEST(Offset, ASquareWithEachJoin) {
  const Polygon square_10 = polygon_of({square(0, 0, 16)});
  const auto area = [&](float distance, LineJoin join, float limit = 4) {
    return signed_area(
        offset(square_10, {.distance = distance, .join = join, .miter_limit = limit, .tolerance = 1e-4F}));
  };
  EXPECT_EQ(area(2, LineJoin::Miter), 20 * 20);
  EXPECT_EQ(area(2, LineJoin::Bevel), 20 * 20 - 4 * 2);
  EXPECT_EQ(area(2, LineJoin::Miter, 1.2F), 20 * 20 - 4 * 2);  // a right angle's miter is √2 long
  // The sector's polygon is within the tolerance of the circle: its area is short of it by less than 10⁻⁴ · arc.
  EXPECT_NEAR(area(2, LineJoin::Round), 16 * 16 + 4 * 32 + 4 * std::numbers::pi, 1e-4 * 4 * std::numbers::pi);
  EXPECT_EQ(area(-2, LineJoin::Round), 12 * 12);
  EXPECT_EQ(area(-2, LineJoin::Miter), 12 * 12);
  EXPECT_EQ(area(-8, LineJoin::Miter), 0);
  EXPECT_EQ(area(-9, LineJoin::Miter), 0);
  EXPECT_EQ(area(0, LineJoin::Miter), 16 * 16);
}

TEST(Offset, HolesCloseAndPartsFallApart) {
  const Polygon ring = polygon_of({square(0, 0, 16), reversed(square(6, 6, 4))});
  EXPECT_EQ(offset(ring, {.distance = 1, .join = LineJoin::Miter}).ring_count(), 2U);
  EXPECT_EQ(signed_area(offset(ring, {.distance = 1, .join = LineJoin::Miter})), 18 * 18 - 2 * 2);
  EXPECT_EQ(offset(ring, {.distance = 3, .join = LineJoin::Miter}).ring_count(), 1U);
  // Two rooms and a corridor of width 2.
  const Polygon rooms = polygon_of(
      {{{0, 0}, {8, 0}, {8, 3}, {12, 3}, {12, 0}, {20, 0}, {20, 8}, {12, 8}, {12, 5}, {8, 5}, {8, 8}, {0, 8}}});
  EXPECT_EQ(offset(rooms, {.distance = -0.5F}).ring_count(), 1U);
  EXPECT_EQ(offset(rooms, {.distance = -1.5F}).ring_count(), 2U);
  EXPECT_EQ(signed_area(offset(rooms, {.distance = -1.5F, .join = LineJoin::Miter})), 2 * 5 * 5);
}

/// With round corners a point is inside where it was or is nearer than the distance; of a negative one, where it was and
/// is further from the outline.
TEST(Offset, AgreesWithDistances) {
  for (unsigned seed = 0; seed < 120; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> place(0, 100);
    Polygon polygon;
    for (std::size_t rings = 1 + seed % 2; rings-- > 0;) {
      Ring ring;
      for (std::size_t points = 3 + random() % 7; points-- > 0;) ring.emplace_back(place(random), place(random));
      polygon.add_ring(ring);
    }
    const float distance = seed % 2 == 0 ? 7.0F : -5.0F;
    const float tolerance = 0.01F;
    const Polygon rings = simplified(polygon);
    const Polygon moved = offset(polygon, {.distance = distance, .tolerance = tolerance});
    const std::vector<Line> lines = lines_of(rings);
    const PointClassifier before(rings);
    const PointClassifier after(moved);
    for (int i = 0; i < 300; ++i) {
      const glm::vec2 p(place(random) * 1.2F - 10, place(random) * 1.2F - 10);
      double nearest = 1e9;
      for (const Line& line : lines) {
        const glm::dvec2 d = line.b - line.a;
        const double t = std::clamp(glm::dot(glm::dvec2(p) - line.a, d) / glm::dot(d, d), 0.0, 1.0);
        nearest = std::min(nearest, glm::length(glm::dvec2(p) - line.a - t * d));
      }
      if (std::abs(nearest - std::abs(distance)) < 2 * tolerance) continue;
      const bool was = before(p) == PointClass::Inside;
      const bool truth = distance > 0 ? was || nearest < distance : was && nearest > -distance;
      ASSERT_EQ(after(p) == PointClass::Inside, truth) << p.x << ", " << p.y;
    }
  }
}

TEST(Offset, OfADrawingKeepsStylesAndPlaces) {
  Drawing drawing;
  DrawingStyle red;
  red.fill = Paint({1, 0, 0, 1});
  const std::uint32_t group = drawing.add_group({2, 0, 0, 2, 100, 0});
  drawing.add_path(Path().move_to({0, 0}).line_to({8, 0}).line_to({8, 8}).line_to({0, 8}).close(),
                   drawing.add_style(red), "box", group);
  const Drawing moved = offset(drawing, {.distance = 2, .join = LineJoin::Miter});
  ASSERT_EQ(moved.paths.size(), 1U);
  EXPECT_EQ(moved.paths[0].id, "box");
  EXPECT_EQ(moved.styles[moved.paths[0].style].fill, red.fill);
  EXPECT_EQ(bounds(moved), (Box2{{98, -2}, {118, 18}}));
  moved.check("offset");
}

}  // namespace
}  // namespace azulejo
