#include "azulejo/rendering/stroke_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "azulejo/modelling/path_testing.h"

namespace azulejo {
namespace {

constexpr glm::mat3x2 kSame{1, 0, 0, 1, 0, 0};
constexpr double kPi = 3.141592653589793;

FlatPath stroke(const Path& path, const DrawingStyle& style, const glm::mat3x2& matrix = kSame,
                const StrokeOptions& options = {}) {
  FlatPath result;
  StrokeScratch scratch;
  stroke_path(view_of(path), style, matrix, options, scratch, result);
  return result;
}

DrawingStyle line_style(float width, LineCap cap = LineCap::Butt, LineJoin join = LineJoin::Miter) {
  DrawingStyle style;
  style.stroke_width = width;
  style.cap = cap;
  style.join = join;
  return style;
}

Path polyline(const std::vector<glm::dvec2>& points, bool closed) {
  Path path;
  path.move_to(points[0]);
  for (std::size_t i = 1; i < points.size(); ++i) path.line_to(points[i]);
  if (closed) path.close();
  return path;
}

/// What a line of these points covers, by the definition: rectangles, wedges and caps, each tested for itself.
struct Definition {
  std::vector<glm::dvec2> points;
  bool closed = false;
  double radius = 1;
  LineCap cap = LineCap::Butt;
  LineJoin join = LineJoin::Miter;
  double miter_limit = 4;

  bool covers(const glm::dvec2& at) const {
    const std::size_t count = points.size();
    const std::size_t segments = closed ? count : count - 1;
    for (std::size_t i = 0; i < segments; ++i) {
      const bool first = i == 0 && !closed;
      const bool last = i + 1 == segments && !closed;
      if (on_segment(at, points[i], points[(i + 1) % count], first, last)) return true;
      if (!last && on_join(at, points[i], points[(i + 1) % count], points[(i + 2) % count])) return true;
    }
    return false;
  }

  bool on_segment(const glm::dvec2& at, const glm::dvec2& a, const glm::dvec2& b, bool first, bool last) const {
    const glm::dvec2 along = glm::normalize(b - a);
    const double u = glm::dot(at - a, along);
    const double v = std::abs(cross_of(along, at - a));
    const double out = cap == LineCap::Square ? radius : 0;
    if (v <= radius && u >= (first ? -out : 0) && u <= glm::length(b - a) + (last ? out : 0)) return true;
    if (cap != LineCap::Round) return false;
    return (first && glm::length(at - a) <= radius) || (last && glm::length(at - b) <= radius);
  }

  bool on_join(const glm::dvec2& at, const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) const {
    const glm::dvec2 d = glm::normalize(b - a);
    const glm::dvec2 e = glm::normalize(c - b);
    const double side = cross_of(d, e) > 0 ? -1 : 1;
    const glm::dvec2 n = side * radius * glm::dvec2(-d.y, d.x);
    const glm::dvec2 m = side * radius * glm::dvec2(-e.y, e.x);
    if (in_triangle(at, b, b + n, b + m)) return true;
    const glm::dvec2 middle = glm::normalize(n + m);
    const double cosine = glm::dot(middle, n) / radius;
    if (join == LineJoin::Round) {
      const double turn = cross_of(n, m) > 0 ? 1 : -1;
      return glm::length(at - b) <= radius && turn * cross_of(n, at - b) >= 0 && turn * cross_of(at - b, m) >= 0;
    }
    if (join == LineJoin::Bevel || !(1 / cosine <= miter_limit)) return false;
    return in_triangle(at, b + n, b + m, b + middle * (radius / cosine));
  }

  static bool in_triangle(const glm::dvec2& at, const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    const double u = cross_of(b - a, at - a);
    const double v = cross_of(c - b, at - b);
    const double w = cross_of(a - c, at - c);
    return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
  }
};

/// At places, near corners and anywhere, that aren't within `margin` of an outline: covered are those which the definition covers, and there
/// all contours turn the same way.
template <class Covers>
void expect_covered(const FlatPath& outline, const Covers& covers, double margin, std::mt19937& random,
                    const std::string& what, double size = 100) {
  std::uniform_real_distribution<double> place(-0.2 * size, 1.2 * size);
  std::uniform_real_distribution<double> beside(-4, 4);
  ASSERT_GT(outline.points.size(), 0U) << what;
  for (int i = 0; i < 160; ++i) {
    glm::dvec2 at(place(random), place(random));
    if (i % 2 == 0)
      at = glm::dvec2(outline.points[random() % outline.points.size()]) + glm::dvec2(beside(random), beside(random));
    if (distance_to_outline(outline, at) < margin) continue;
    const int winding = winding_at(outline, at);
    ASSERT_LE(winding, 0) << what << " at " << at.x << ", " << at.y;
    ASSERT_EQ(winding != 0, covers(at)) << what << " at " << at.x << ", " << at.y;
  }
}

std::vector<glm::dvec2> random_points(std::mt19937& random, int count) {
  std::uniform_real_distribution<float> place(0, 100);
  std::vector<glm::dvec2> points;
  for (int i = 0; i < count; ++i) points.emplace_back(place(random), place(random));
  return points;
}

TEST(StrokePath, CoversWhatTheDefinitionSays) {
  std::mt19937 random(11);
  int case_number = 0;
  for (const LineJoin join : {LineJoin::Miter, LineJoin::Round, LineJoin::Bevel}) {
    for (const LineCap cap : {LineCap::Butt, LineCap::Round, LineCap::Square}) {
      for (const bool closed : {false, true}) {
        for (const float width : {1.0F, 6.0F, 25.0F, 80.0F}) {
          for (int i = 0; i < 4; ++i) {
            const auto points = random_points(random, 3 + i * 2);
            const FlatPath outline = stroke(polyline(points, closed), line_style(width, cap, join));
            const Definition wanted{points, closed, width / 2.0, cap, join, 4};
            // Arcs and flat joins are within the tolerance.
            expect_covered(
                outline, [&](const glm::dvec2& at) { return wanted.covers(at); }, 0.11, random,
                "case " + std::to_string(case_number++));
          }
        }
      }
    }
  }
}

TEST(StrokePath, JoinsOfLongSegmentsDontOverlap) {
  // So the area is that of the parts: a zigzag of right angles, without caps, its corners cut by bevels.
  const FlatPath outline = stroke(Path().move_to({0, 0}).line_to({30, 0}).line_to({30, 40}).line_to({60, 40}),
                                  line_style(6, LineCap::Butt, LineJoin::Bevel));
  // Each corner: two rectangles share 3 × 3, and a triangle of 3 × 3 / 2 is added.
  EXPECT_NEAR(std::abs(signed_area(outline)), 100 * 6 - 2 * 9 + 2 * 4.5, 1e-3);
  const FlatPath mitered = stroke(Path().move_to({0, 0}).line_to({30, 0}).line_to({30, 40}).line_to({60, 40}),
                                  line_style(6, LineCap::Square, LineJoin::Miter));
  EXPECT_NEAR(std::abs(signed_area(mitered)), 106 * 6, 1e-3);
}

TEST(StrokePath, ThinLinesKeepTheirArea) {
  for (const float width : {1.0F, 0.25F, 0.01F}) {
    const FlatPath outline = stroke(Path().move_to({10, 10}).line_to({110, 40}).line_to({20, 90}), line_style(width));
    const double length = std::hypot(100, 30) + std::hypot(90, 50);
    // A miter adds what the inside loses. Floats near 100 are within 2⁻¹⁸: of a width of 0.01 within 1e-3.
    EXPECT_NEAR(std::abs(signed_area(outline)) / (length * width), 1, 2e-3);
  }
  EXPECT_EQ(stroke(Path().move_to({10, 10}).line_to({110, 40}), line_style(0)).points.size(), 0U);
  EXPECT_EQ(stroke(Path().move_to({10, 10}).line_to({110, 40}), line_style(1e-7F)).points.size(), 0U);
}

TEST(StrokePath, MitersReachAsFarAsTheAngleSays) {
  for (int degrees = 15; degrees < 180; degrees += 15) {
    const double angle = degrees * kPi / 180;  // between the segments
    const glm::dvec2 other(100 * std::cos(angle), 100 * std::sin(angle));
    DrawingStyle style = line_style(10);
    style.miter_limit = 5;
    const FlatPath outline = stroke(polyline({{100, 0}, {0, 0}, other}, false), style);
    double farthest = 0;
    const glm::dvec2 out = -glm::dvec2(std::cos(angle / 2), std::sin(angle / 2));
    for (const glm::vec2& point : outline.points) farthest = std::max(farthest, glm::dot(glm::dvec2(point), out));
    const double ratio = 1 / std::sin(angle / 2);
    EXPECT_NEAR(farthest, ratio <= 5 ? 5 * ratio : 5 * std::sin(angle / 2), 1e-3) << degrees;
  }
}

TEST(StrokePath, ClosedHasNoCaps) {
  const std::vector<glm::dvec2> square = {{0, 0}, {40, 0}, {40, 40}, {0, 40}};
  // The inner quarter of the first corner is in two outlines.
  EXPECT_NEAR(std::abs(signed_area(stroke(polyline(square, true), line_style(4)))), 44 * 44 - 36 * 36 + 4, 1e-3);
  auto back = square;
  back.push_back(square[0]);
  // Open, though it ends where it began: the first corner lacks its outer quarter.
  EXPECT_NEAR(std::abs(signed_area(stroke(polyline(back, false), line_style(4)))), 44 * 44 - 36 * 36, 1e-3);
  EXPECT_EQ(winding_at(stroke(polyline(back, false), line_style(4)), {-1, -1}), 0);
  EXPECT_NE(winding_at(stroke(polyline(square, true), line_style(4)), {-1, -1}), 0);
}

TEST(StrokePath, DotsOfSubpathsWithoutLength) {
  const Path here = Path().move_to({20, 20}).line_to({20, 20});
  const Path closed = Path().move_to({20, 20}).close();
  const Path moved = Path().move_to({20, 20});
  for (const Path& path : {here, closed}) {
    EXPECT_EQ(stroke(path, line_style(10)).points.size(), 0U);
    EXPECT_NEAR(std::abs(signed_area(stroke(path, line_style(10, LineCap::Square)))), 100, 1e-3);
    // An inscribed polygon within 0.05 of radius 5 lacks less than 2/3 of 0.05 around.
    EXPECT_NEAR(std::abs(signed_area(stroke(path, line_style(10, LineCap::Round)))), 25 * kPi, 0.05 * 10 * kPi);
  }
  EXPECT_EQ(stroke(moved, line_style(10, LineCap::Round)).points.size(), 0U);
  // The square is along the path's x axis.
  const glm::mat3x2 turned(0.6F, 0.8F, -0.8F, 0.6F, 0, 0);
  double farthest = 0;
  for (const glm::vec2& point :
       stroke(Path().move_to({0, 0}).close(), line_style(10, LineCap::Square), turned).points) {
    farthest = std::max(farthest, glm::dot(glm::dvec2(point), glm::dvec2(0.6, 0.8)));
  }
  EXPECT_NEAR(farthest, 5, 1e-4);
}

TEST(StrokePath, SegmentsWithoutLengthCountForNothing) {
  const FlatPath with = stroke(Path().move_to({0, 0}).line_to({0, 0}).line_to({9, 0}).line_to({9, 0}).line_to({9, 9}),
                               line_style(2, LineCap::Square));
  const FlatPath without =
      stroke(Path().move_to({0, 0}).line_to({9, 0}).line_to({9, 9}), line_style(2, LineCap::Square));
  EXPECT_EQ(with.points, without.points);
}

TEST(StrokePath, TransformsThePen) {
  std::mt19937 random(5);
  const glm::mat3x2 matrix(2, 0.5F, -0.3F, 0.4F, 5, 7);
  for (const LineJoin join : {LineJoin::Miter, LineJoin::Round}) {
    const auto points = random_points(random, 6);
    const FlatPath outline = stroke(polyline(points, false), line_style(8, LineCap::Round, join), matrix);
    const Definition wanted{points, false, 4, LineCap::Round, join, 4};
    const glm::dmat2 inverse = glm::inverse(glm::dmat2(glm::dvec2(matrix[0]), glm::dvec2(matrix[1])));
    expect_covered(
        outline, [&](const glm::dvec2& at) { return wanted.covers(inverse * (at - glm::dvec2(matrix[2]))); }, 0.11,
        random, "ellipse", 200);
    DrawingStyle fixed = line_style(8, LineCap::Round, join);
    fixed.fixed_stroke = true;
    Definition in_picture = wanted;
    for (glm::dvec2& point : in_picture.points) point = glm::dvec2(transformed(matrix, glm::vec2(point)));
    expect_covered(
        stroke(polyline(points, false), fixed, matrix), [&](const glm::dvec2& at) { return in_picture.covers(at); },
        0.11, random, "circle", 200);
  }
  EXPECT_NEAR(std::abs(signed_area(stroke(Path().move_to({0, 0}).line_to({10, 0}), line_style(2), {0, 3, 3, 0, 0, 0}))),
              30 * 6, 1e-3);
}

/// By definition: all that is within the radius of the curve, and behind no butt end. Sampled finely.
TEST(StrokePath, CurvesWithTightTurnsAndCusps) {
  std::mt19937 random(6);
  std::uniform_real_distribution<float> place(0, 100);
  const auto point = [&] { return glm::vec2(place(random), place(random)); };
  for (int i = 0; i < 200; ++i) {
    std::array<glm::vec2, 4> p = {point(), point(), point(), point()};
    if (i % 5 == 1) p = {glm::vec2(20, 80), {80, 20}, {20, 20}, {80, 80}};  // a cusp
    if (i % 5 == 2) p[1] = p[0];
    if (i % 5 == 3) p[2] = p[3];
    if (i % 5 == 4) p = {glm::vec2(20, 50), {90, 50}, {10, 50}, {70, 50}};  // turns back twice
    const float width = std::array{1.0F, 5.0F, 30.0F, 60.0F}[static_cast<std::size_t>(i % 4)];
    const FlatPath outline =
        stroke(Path().move_to(p[0]).cubic_to(p[1], p[2], p[3]), line_style(width, LineCap::Round, LineJoin::Bevel));
    std::vector<glm::dvec2> samples;
    for (int k = 0; k <= 2000; ++k) {
      const double t = k / 2000.0;
      const double s = 1 - t;
      samples.push_back(s * s * s * glm::dvec2(p[0]) + 3 * t * s * s * glm::dvec2(p[1]) +
                        3 * s * t * t * glm::dvec2(p[2]) + t * t * t * glm::dvec2(p[3]));
    }
    const auto near = [&](const glm::dvec2& at) {
      double nearest = 1e300;
      for (const glm::dvec2& sample : samples) nearest = std::min(nearest, glm::length(sample - at));
      return nearest <= width / 2;
    };
    expect_covered(outline, near, 0.15, random, "curve " + std::to_string(i));
  }
}

TEST(StrokePath, ButtEndsOfCurvesAreAcrossTheirDirection) {
  // A half circle of radius 6 with a width of 20, whose ends look down.
  const float k = 8.0F;
  const FlatPath outline =
      stroke(Path().move_to({40, 60}).cubic_to({40, 60 - k}, {52, 60 - k}, {52, 60}), line_style(20));
  double lowest = 0;
  for (const glm::vec2& point : outline.points) lowest = std::max<double>(lowest, point.y);
  EXPECT_GT(winding_at(outline, {46, 59.9}), -100);
  EXPECT_NE(winding_at(outline, {31, 59.9}), 0);
  EXPECT_NE(winding_at(outline, {61, 59.9}), 0);
  EXPECT_EQ(winding_at(outline, {31, 60.1}), 0);
  EXPECT_EQ(winding_at(outline, {61, 60.1}), 0);
}

TEST(StrokePath, LongLinesAreCutWithoutTrace) {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> step(-3, 3);
  Path path = Path().move_to({50, 50});
  for (int i = 0; i < 5000; ++i) path.line_to(path.points.back() + glm::vec2(step(random), step(random)));
  for (const bool closed : {false, true}) {
    if (closed) path.close();
    std::vector<glm::dvec2> points(path.points.begin(), path.points.end());
    const FlatPath outline = stroke(path, line_style(2, LineCap::Square));
    EXPECT_GT(outline.contour_count(), 4U);
    const Definition wanted{points, closed, 1, LineCap::Square, LineJoin::Miter, 4};
    expect_covered(
        outline, [&](const glm::dvec2& at) { return wanted.covers(at); }, 0.01, random, "long");
  }
}

TEST(StrokePath, WhatIsOutsideOfTheWindowIsLeftOut) {
  std::mt19937 random(10);
  const Box2 window{{30, 30}, {70, 70}};
  for (const LineJoin join : {LineJoin::Miter, LineJoin::Round}) {
    for (int i = 0; i < 20; ++i) {
      DrawingStyle style = line_style(5, LineCap::Square, join);
      if (i % 2 == 1) style.dash = {7, 9};
      auto points = random_points(random, 40);
      for (glm::dvec2& point : points) point = glm::dvec2(glm::vec2((point - 50.0) * (i % 3 == 0 ? 1e4 : 4.0) + 50.0));
      const FlatPath all = stroke(polyline(points, i % 4 == 0), style);
      const FlatPath seen = stroke(polyline(points, i % 4 == 0), style, kSame, {0.1F, window});
      EXPECT_LT(seen.points.size(), all.points.size());
      std::uniform_real_distribution<double> place(30, 70);
      for (int k = 0; k < 200; ++k) {
        const glm::dvec2 at(place(random), place(random));
        // Far away floats are 1/16 apart, and the sum of lengths shifts dashes.
        if (distance_to_outline(seen, at) < (i % 3 == 0 ? 0.3 : 1e-3)) continue;
        if (i % 3 == 0 && i % 2 == 1) continue;
        EXPECT_EQ(winding_at(seen, at) != 0, winding_at(all, at) != 0) << i;
      }
    }
  }
}

TEST(StrokePath, HugeCoordinatesDontBreakLines) {
  const StrokeOptions options{0.1F, {{0, 0}, {100, 100}}};
  const FlatPath line = stroke(Path().move_to({-3e38F, 50}).line_to({3e38F, 50}), line_style(4), kSame, options);
  EXPECT_NE(winding_at(line, {50, 51.9}), 0);
  EXPECT_EQ(winding_at(line, {50, 52.1}), 0);
  const FlatPath slanted = stroke(Path().move_to({-1e9F, -1e9F}).line_to({1e9F, 1e9F}), line_style(4), kSame, options);
  EXPECT_NE(winding_at(slanted, {51.3, 50}), 0);
  EXPECT_EQ(winding_at(slanted, {53, 50}), 0);
  DrawingStyle dashed = line_style(4);
  dashed.dash = {1, 1};
  EXPECT_LT(stroke(Path().move_to({-1e9F, 0}).line_to({1e9F, 100}), dashed, kSame, options).points.size(), 10000U);
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(stroke(Path().move_to({0, 0}).line_to({kNan, 0}).line_to({1, 1}), line_style(4)).points.size(), 0U);
}

TEST(StrokePath, DashesAreWhatTheyMeasure) {
  std::mt19937 random(12);
  for (const LineCap cap : {LineCap::Butt, LineCap::Round, LineCap::Square}) {
    for (int i = 0; i < 24; ++i) {
      const bool closed = i % 2 == 1;
      DrawingStyle style = line_style(3, cap, LineJoin::Round);
      style.dash = std::array<std::vector<float>, 4>{
          {{9, 7}, {12, 5, 3}, {0, 8}, {20, 0, 4, 9}}}[static_cast<std::size_t>(i / 2 % 4)];
      style.dash_offset = std::array{0.0F, 13.0F, -5.0F}[static_cast<std::size_t>(i / 8)];
      auto points = random_points(random, 6);
      const FlatPath outline = stroke(polyline(points, closed), style);
      // The same as lines of their own: a place on the path is on where the pattern is at its length.
      std::vector<double> lengths(style.dash.begin(), style.dash.end());
      if (lengths.size() % 2 == 1) lengths.insert(lengths.end(), style.dash.begin(), style.dash.end());
      double period = 0;
      for (const double each : lengths) period += each;
      if (closed) points.push_back(points[0]);
      std::vector<Definition> dashes;
      double total = 0;
      for (std::size_t k = 1; k < points.size(); ++k) total += glm::length(points[k] - points[k - 1]);
      const auto cut = [&](double begin, double end) {
        Definition dash{{}, false, 1.5, cap, LineJoin::Round, 4};
        double at = 0;
        for (std::size_t k = 1; k < points.size(); ++k) {
          const double length = glm::length(points[k] - points[k - 1]);
          const auto point = [&](double s) {
            return points[k - 1] + (points[k] - points[k - 1]) * ((s - at) / length);
          };
          if (begin >= at && begin < at + length) dash.points.push_back(point(begin));
          if (at > begin && at < end) dash.points.push_back(points[k - 1]);
          if (end > at && end <= at + length && end > begin) dash.points.push_back(point(end));
          if (end == begin && begin >= at && begin < at + length) {
            dash.points.push_back(point(begin) + 1e-9 * (points[k] - points[k - 1]));
          }
          at += length;
        }
        if (dash.points.size() > 1) dashes.push_back(dash);
      };
      bool first_on = false;
      bool last_on = false;
      double place = -style.dash_offset;
      while (place > 0) place -= period;
      for (std::size_t k = 0; place < total; k = (k + 1) % lengths.size()) {
        const double end = place + lengths[k];
        if (k % 2 == 0 && (end > 0 || (end == 0 && lengths[k] == 0))) {
          cut(std::max(0.0, place), std::min(total, end));
          first_on |= place <= 0 && end > 0;
          last_on |= end >= total && place < total;
        }
        place = end;
      }
      const auto covers = [&](const glm::dvec2& at) {
        if (closed && first_on && last_on && glm::length(at - points[0]) <= 1.5) return true;
        return std::any_of(dashes.begin(), dashes.end(), [&](const Definition& dash) { return dash.covers(at); });
      };
      // Where a closed line's dash goes on over its start there are no caps: square ones would stick out.
      if (closed && first_on && last_on && cap == LineCap::Square) continue;
      if (closed && first_on && last_on && cap == LineCap::Butt) {
        EXPECT_NE(winding_at(outline, points[0]), 0);
      }
      if (cap == LineCap::Butt && style.dash[0] == 0) {
        EXPECT_EQ(outline.points.size(), 0U);
        continue;
      }
      expect_covered(outline, covers, 0.11, random, "dash " + std::to_string(i));
    }
  }
}

TEST(StrokePath, DotsAlongCurvesAreSquares) {
  DrawingStyle style = line_style(6, LineCap::Square);
  style.dash = {0, 14};
  const FlatPath outline = stroke(Path().move_to({30, 90}).quadratic_to({150, 20}, {280, 75}), style);
  EXPECT_GT(outline.contour_count(), 18U);
  for (const std::uint8_t each : outline.summed) EXPECT_EQ(each, 1);
  const double dots = static_cast<double>(outline.contour_count());
  EXPECT_NEAR(std::abs(signed_area(outline)), 36 * dots, 1e-2);
}

TEST(StrokePath, DashesSumUp) {
  DrawingStyle style = line_style(2);
  style.dash = {3, 2};
  EXPECT_NEAR(std::abs(signed_area(stroke(Path().move_to({0, 0}).line_to({100, 0}), style))), 60 * 2, 1e-3);
  style.dash_offset = 4;  // a unit of gap, then 19 of 20 whole periods, and a dash and a unit of gap
  EXPECT_NEAR(std::abs(signed_area(stroke(Path().move_to({0, 0}).line_to({100, 0}), style))), 60 * 2, 1e-3);
  style.dash_offset = 0;
  // Scaled with the path, unless fixed.
  const glm::mat3x2 twice(2, 0, 0, 2, 0, 0);
  EXPECT_EQ(stroke(Path().move_to({0, 0}).line_to({50, 0}), style, twice).contour_count(), 10U);
  style.fixed_stroke = true;
  EXPECT_EQ(stroke(Path().move_to({0, 0}).line_to({50, 0}), style, twice).contour_count(), 20U);
}

TEST(StrokePath, StippleOfSixteenBits) {
  DrawingStyle style = line_style(1);
  for (const unsigned bits : {0x00FFU, 0xAAAAU, 0x0F01U, 0x8001U}) {
    const LineStipple stipple = line_stipple(static_cast<std::uint16_t>(bits), 3);
    style.dash = stipple.dash;
    style.dash_offset = stipple.dash_offset;
    const FlatPath outline = stroke(Path().move_to({0, 0}).line_to({200, 0}), style);
    for (int x = 0; x < 200; ++x) {
      EXPECT_EQ(winding_at(outline, {x + 0.5, 0.1}) != 0, (bits >> (x / 3 % 16) & 1) != 0) << bits << " at " << x;
    }
  }
  style.dash = line_stipple(0, 3).dash;
  EXPECT_EQ(stroke(Path().move_to({0, 0}).line_to({200, 0}), style).points.size(), 0U);
}

TEST(StrokePath, PatternsTooFineAreThinnerLines) {
  DrawingStyle style = line_style(4);
  style.dash = {0.05F, 0.15F};
  EXPECT_NEAR(std::abs(signed_area(stroke(Path().move_to({0, 0}).line_to({100, 0}), style))), 100, 1e-2);
  style.cap = LineCap::Square;
  style.dash = {0, 4e-5F};
  EXPECT_NEAR(std::abs(signed_area(stroke(Path().move_to({0, 0}).line_to({100, 0}), style))), 104 * 4, 1e-2);
  style.cap = LineCap::Butt;
  style.dash = {0.2F, 0.2F};
  EXPECT_NEAR(std::abs(signed_area(stroke(Path().move_to({0, 0}).line_to({1e7F, 0}), style))) / 2e7, 1, 1e-2);
  style.dash = {0, 0};
  EXPECT_NEAR(std::abs(signed_area(stroke(Path().move_to({0, 0}).line_to({100, 0}), style))), 400, 1e-2);
}

}  // namespace
}  // namespace azulejo
