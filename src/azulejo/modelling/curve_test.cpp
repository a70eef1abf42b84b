#include "azulejo/modelling/curve.h"

#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

using Kind = CurveKind;
using Floats = std::vector<float>;

PathView path_of(const Drawing& drawing) { return drawing.view(drawing.paths.back()); }

/// Points of the path in page units as they were given, 32 a segment.
std::vector<glm::dvec2> samples_of(const PathView& path) {
  std::vector<glm::dvec2> samples;
  std::size_t next = 0;
  glm::dvec2 start(0);
  for (const PathCommand command : path.commands) {
    const std::size_t count = points_of(command);
    std::vector<glm::dvec2> p{samples.empty() ? glm::dvec2(0) : samples.back()};
    for (std::size_t i = 0; i < count; ++i) p.emplace_back(path.points[next++]);
    if (command == PathCommand::Move) {
      samples.push_back(start = p[1]);
      continue;
    }
    if (command == PathCommand::Close) p.push_back(start);
    for (int k = 1; k <= 32; ++k) {
      std::vector<glm::dvec2> q = p;
      for (std::size_t n = q.size() - 1; n > 0; --n) {
        for (std::size_t i = 0; i < n; ++i) q[i] += (q[i + 1] - q[i]) * (k / 32.0);
      }
      samples.push_back(q[0]);
    }
  }
  return samples;
}

std::string message_of(const CurveOptions& options) {
  try {
    curve(options);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Curve, EveryKindIsADrawingOnAPage) {
  for (std::size_t kind = 0; kind < enum_names(Kind{}).size(); ++kind) {
    for (const bool closed : {false, true}) {
      const Drawing drawing = curve({.kind = static_cast<Kind>(kind), .closed = closed, .controls = closed});
      SCOPED_TRACE(enum_names(Kind{})[kind]);
      drawing.check("curve");
      EXPECT_EQ(drawing.paths.back().id, "curve");
      const Box2 box = bounds(drawing);
      // In the middle of the page, with a margin.
      EXPECT_NEAR(box.lower.x, drawing.width - box.upper.x, 0.01F);
      EXPECT_NEAR(box.lower.y, drawing.height - box.upper.y, 0.01F);
      EXPECT_GE(box.lower.x, 8);
      EXPECT_LT(box.lower.x, 12);
      const Drawing placed = curve({.kind = static_cast<Kind>(kind), .page = glm::vec2(300, 200)});
      EXPECT_EQ(placed.width, 300);
      EXPECT_EQ(placed.height, 200);
    }
  }
}

TEST(Curve, WhatIsCubicItselfStaysSo) {
  const Drawing drawing = curve({.points = {0, 1, 2, 3, 4, 5, 6, 8}});
  const PathView path = path_of(drawing);
  ASSERT_EQ(path.commands.size(), 2U);
  EXPECT_EQ(path.commands[1], PathCommand::Cubic);
  EXPECT_EQ(path.points[2], glm::vec2(4, 5));
  EXPECT_EQ(path_of(curve({.points = {0, 1, 2, 3, 4, 5}})).commands[1], PathCommand::Quadratic);
  EXPECT_EQ(path_of(curve({.points = {0, 1, 2, 3}})).commands[1], PathCommand::Line);
  EXPECT_EQ(
      path_of(curve({.kind = Kind::BSpline, .points = {0, 1, 2, 3, 4, 5, 6, 9, 7, 1}, .degree = 2})).commands.size(),
      4U);
  EXPECT_EQ(path_of(curve({.kind = Kind::CatmullRom})).points.size(), 1U + 3 * 3);
}

TEST(Curve, CirclesAndArcsAreRound) {
  const auto expect_round = [](const CurveOptions& options, double radius, double tolerance) {
    for (const glm::dvec2& p : samples_of(path_of(curve(options)))) {
      EXPECT_NEAR(glm::distance(p, glm::dvec2(options.center)), radius, tolerance);
    }
  };
  for (const float tolerance : {1.0F, 0.01F, 1e-4F}) {
    expect_round({.kind = Kind::Circle, .center = {10, 20}, .radii = {50, 1}, .tolerance = tolerance}, 50, tolerance);
    expect_round({.kind = Kind::Arc, .radii = {50, 50}, .tolerance = tolerance}, 50, tolerance + 1e-5);
    // The circle of nine weighted points on a square, Piegl & Tiller 7.5.
    const float w = std::sqrt(0.5F);
    expect_round({.kind = Kind::Nurbs,
                  .points = {50, 0, 50, 50, 0, 50, -50, 50, -50, 0, -50, -50, 0, -50, 50, -50, 50, 0},
                  .weights = {1, w, 1, w, 1, w, 1, w, 1},
                  .knots = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4},
                  .degree = 2,
                  .center = {0, 0},
                  .tolerance = tolerance},
                 50, tolerance + 1e-4);
  }
}

TEST(Curve, AnglesTurnCounterClockwiseAsSeen) {
  const Drawing quarter = curve({.kind = Kind::Arc, .center = {0, 0}, .radii = {2, 1}, .sweep_deg = 90});
  const PathView path = path_of(quarter);
  EXPECT_LT(glm::distance(path.points.front(), glm::vec2(2, 0)), 1e-6F);
  EXPECT_LT(glm::distance(path.points.back(), glm::vec2(0, -1)), 1e-6F);  // up, where y points down
  const Drawing turned =
      curve({.kind = Kind::Arc, .center = {0, 0}, .radii = {2, 1}, .rotation_deg = 90, .sweep_deg = 90});
  EXPECT_LT(glm::distance(path_of(turned).points.front(), glm::vec2(0, -2)), 1e-6F);
  EXPECT_LT(glm::distance(path_of(turned).points.back(), glm::vec2(-1, 0)), 1e-6F);
}

TEST(Curve, PolygonsStarsAndRectanglesHaveTheirCorners) {
  const Drawing polygon = curve({.kind = Kind::Polygon, .center = {0, 0}, .radii = {10, 1}, .corners = 6});
  const PathView hexagon = path_of(polygon);
  ASSERT_EQ(hexagon.points.size(), 6U);
  EXPECT_LT(glm::distance(hexagon.points[0], glm::vec2(0, -10)), 1e-5F);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(glm::distance(hexagon.points[i], hexagon.points[(i + 1) % 6]), 10, 1e-5F);
  }
  // Edges of a pentagram are straight through the corners between.
  const float inner = static_cast<float>(1 / (std::numbers::phi * std::numbers::phi));
  const Drawing star = curve({.kind = Kind::Star, .center = {0, 0}, .radii = {10, 1}, .inner = inner});
  const PathView pentagram = path_of(star);
  ASSERT_EQ(pentagram.points.size(), 10U);
  const glm::vec2 a = glm::normalize(pentagram.points[1] - pentagram.points[0]);
  const glm::vec2 b = glm::normalize(pentagram.points[4] - pentagram.points[0]);
  EXPECT_LT(glm::distance(a, b), 1e-5F);
  const Box2 box = bounds(path_of(curve({.kind = Kind::Rectangle, .center = {5, 6}, .radii = {3, 2}})));
  EXPECT_EQ(box, (Box2{{2, 4}, {8, 8}}));
}

TEST(Curve, TheSpiralGrowsEvenly) {
  const CurveOptions options{.kind = Kind::Spiral, .center = {0, 0}, .radii = {100, 1}, .inner = 0.1F, .turns = 5};
  const std::vector<glm::dvec2> samples = samples_of(path_of(curve(options)));
  double angle = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i > 0) {
      const glm::dvec2 p = samples[i - 1];
      const glm::dvec2 q = samples[i];
      angle += std::atan2(p.y * q.x - p.x * q.y, p.x * q.x + p.y * q.y);  // y down
    }
    const double radius = 10 + 90 * angle / (10 * std::numbers::pi);
    EXPECT_NEAR(glm::length(samples[i]), radius, options.tolerance + 1e-5);
  }
  EXPECT_NEAR(angle, 10 * std::numbers::pi, 1e-5);
}

TEST(Curve, AClosedBSplineIsSmoothAllAround) {
  const CurveOptions options{.kind = Kind::BSpline, .points = {0, 0, 10, 0, 10, 10, 0, 10}, .closed = true};
  const Drawing drawing = curve(options);
  const PathView path = path_of(drawing);
  ASSERT_EQ(path.points.size(), 1U + 4 * 3);
  EXPECT_LT(glm::distance(path.points.front(), path.points.back()), 1e-5F);
  const glm::vec2 out = path.points[1] - path.points[0];
  const glm::vec2 in = path.points[12] - path.points[11];
  EXPECT_LT(glm::distance(out, in), 1e-5F);
}

TEST(Curve, SaysWhatDoesNotFit) {
  EXPECT_EQ(message_of({.points = {1, 2, 3}}), "bezier: 3 numbers in points, expected x and y of each");
  EXPECT_EQ(message_of({.points = {1, 2}}), "bezier: 1 points, expected 2 or more");
  EXPECT_EQ(message_of({.points = Floats(132, 1.0F)}), "bezier: 66 points, expected 65 at most");
  EXPECT_EQ(message_of({.weights = {1, 1, 1, 1}}), "bezier: weights are given, expected them with nurbs only");
  EXPECT_EQ(message_of({.kind = Kind::Nurbs, .weights = {1}}), "nurbs: 1 weights, expected 4, one a point");
  EXPECT_EQ(message_of({.kind = Kind::BSpline, .degree = 4}), "bspline: 4 points, expected 5 or more for degree 4");
  EXPECT_EQ(message_of({.kind = Kind::BSpline, .knots = {0, 1}, .closed = true}),
            "bspline: knots are given, expected none where it is closed");
  EXPECT_EQ(message_of({.kind = Kind::BSpline, .knots = {0, 1}}),
            "knots: 2 knots, expected 8: as many as control points, 4, and degree + 1");
  EXPECT_EQ(message_of({.kind = Kind::CatmullRom, .points = {1, 1, 1, 1}}),
            "catmull_rom: all points are the same, expected two others");
  EXPECT_EQ(message_of({.kind = Kind::Arc, .sweep_deg = 0}), "arc: sweep_deg is 0, expected an arc");
  EXPECT_NE(message_of({.points = {NAN, 2, 3, 4}}), "");
}

}  // namespace
}  // namespace azulejo
