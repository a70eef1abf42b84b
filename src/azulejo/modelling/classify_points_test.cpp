#include "azulejo/modelling/classify_points.h"

#include <limits>

#include "azulejo/modelling/polygon_testing.h"

namespace azulejo {
namespace {

using namespace polygon_testing;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

bool on_line(const Line& line, const glm::dvec2& p) {
  return orient2d(line.a, line.b, p) == 0 && std::min(line.a.x, line.b.x) <= p.x &&
         p.x <= std::max(line.a.x, line.b.x) && std::min(line.a.y, line.b.y) <= p.y &&
         p.y <= std::max(line.a.y, line.b.y);
}

PointClass by_brute_force(const std::vector<Line>& lines, FillRule rule, const glm::dvec2& p) {
  for (const Line& line : lines) {
    if (on_line(line, p)) return PointClass::Border;
  }
  return polygon_testing::is_inside(rule, winding(lines, p)) ? PointClass::Inside : PointClass::Outside;
}

double distance_to(const Line& line, const glm::dvec2& p) {
  const glm::dvec2 d = line.b - line.a;
  const double t = glm::dot(d, d) > 0 ? std::clamp(glm::dot(p - line.a, d) / glm::dot(d, d), 0.0, 1.0) : 0.0;
  return glm::length(p - line.a - t * d);
}

TEST(ClassifyPoints, AgreesWithBruteForceExactly) {
  int borders = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const unsigned size = 3 + seed % 40;
    const auto place = [&] { return static_cast<float>(random() % size) * (seed % 3 == 0 ? 0.1F : 1.0F); };
    Polygon polygon;
    for (std::size_t rings = 1 + seed % 3; rings-- > 0;) {
      Ring ring;
      for (std::size_t points = random() % 60; points-- > 0;) ring.emplace_back(place(), place());
      polygon.add_ring(ring);
    }
    const std::vector<Line> lines = lines_of(polygon);
    for (const FillRule rule : {FillRule::NonZero, FillRule::EvenOdd}) {
      const PointClassifier classifier(polygon, rule);
      for (int i = 0; i < 200; ++i) {
        const glm::vec2 p = i % 2 == 0 ? glm::vec2(place(), place()) : glm::vec2(place() + 0.37F, place() - 0.21F);
        const PointClass truth = by_brute_force(lines, rule, p);
        ASSERT_EQ(classifier(p), truth) << p.x << ", " << p.y;
        borders += truth == PointClass::Border;
      }
    }
  }
  EXPECT_GT(borders, 1000);
}

TEST(ClassifyPoints, CombsStarsAndSpirals) {
  std::mt19937 random(7);
  for (const Ring& ring : {comb(2000), star(2000, 0.2F, 1, &random), spiral(4000, 30), Ring{{0, 0}, {1, 0}, {2, 0}},
                           Ring{{0, 0}, {0, 1}, {0, 2}}, Ring{{1, 1}, {1, 1}, {1, 1}}}) {
    const Polygon polygon = polygon_of({ring});
    const std::vector<Line> lines = lines_of(polygon);
    const PointClassifier classifier(polygon);
    glm::vec2 lower = ring[0];
    glm::vec2 upper = ring[0];
    for (const glm::vec2& p : ring) {
      lower = glm::min(lower, p);
      upper = glm::max(upper, p);
    }
    std::uniform_real_distribution<float> share(-0.1F, 1.1F);
    for (int i = 0; i < 1000; ++i) {
      const glm::vec2 p =
          i % 5 == 0 ? ring[random() % ring.size()] : lower + glm::vec2(share(random), share(random)) * (upper - lower);
      ASSERT_EQ(classifier(p), by_brute_force(lines, FillRule::NonZero, p)) << p.x << ", " << p.y;
    }
  }
}

TEST(ClassifyPoints, BorderHasAWidth) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-2, 12);
  const Polygon polygon = polygon_of({square(0, 0, 10), reversed(square(3, 4, 2)), {{0, 0}, {10, 10}, {10, 9}}});
  const std::vector<Line> lines = lines_of(polygon);
  const PointClassifier classifier(polygon, FillRule::EvenOdd, 0.5F);
  for (int i = 0; i < 20000; ++i) {
    const glm::vec2 p(place(random), place(random));
    double distance = 1e9;
    for (const Line& line : lines) distance = std::min(distance, distance_to(line, p));
    const PointClass truth = distance <= 0.5 ? PointClass::Border : by_brute_force(lines, FillRule::EvenOdd, p);
    ASSERT_EQ(classifier(p), truth) << p.x << ", " << p.y;
  }
}

TEST(ClassifyPoints, WhatIsNotFiniteIsOutside) {
  const PointClassifier classifier(polygon_of({{{0, 0}, {kNan, 1}, {4, 0}, {4, 4}, {0, 4}}}));
  EXPECT_EQ(classifier({1, 1}), PointClass::Inside);
  EXPECT_EQ(classifier({0, 1}), PointClass::Border);
  EXPECT_EQ(classifier({kNan, 1}), PointClass::Outside);
  EXPECT_EQ(classifier({std::numeric_limits<float>::infinity(), 1}), PointClass::Outside);
  EXPECT_EQ(PointClassifier(Polygon())({0, 0}), PointClass::Outside);
  const float top = std::numeric_limits<float>::max();
  const PointClassifier large(polygon_of({{{-top, -top}, {top, -top}, {top, top}, {-top, top}}}));
  EXPECT_EQ(large({0, 0}), PointClass::Inside);
  EXPECT_EQ(large({top, 1}), PointClass::Border);
}

TEST(ClassifyPoints, OfADrawingGivesAnAttributeAndCounts) {
  Drawing drawing;
  drawing.add_path(Path().move_to({0, 0}).line_to({4, 0}).line_to({4, 4}).line_to({0, 4}).close(),
                   drawing.add_style(DrawingStyle()));
  Mesh points;
  points.positions = {{1, -1, 5}, {4, -2, 0}, {9, -1, 0}, {1, 1, 0}};
  const ClassifiedPoints result = classify_points(drawing, points);
  const Attribute* classes = result.points.find("class");
  ASSERT_NE(classes, nullptr);
  EXPECT_EQ(*classes->get<std::uint32_t>(), (Array<std::uint32_t>{1, 2, 0, 0}));
  EXPECT_EQ(result.report.json["inside"].number(), 1);
  EXPECT_EQ(result.report.json["outside"].number(), 2);
  EXPECT_EQ(result.report.json["border"].number(), 1);
}

}  // namespace
}  // namespace azulejo
