#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "azulejo/math/predicates.h"
#include "azulejo/modelling/polygon.h"

/// Polygons for tests, and what is true of them by brute force.
namespace azulejo::polygon_testing {

using Ring = std::vector<glm::vec2>;

inline Polygon polygon_of(std::initializer_list<Ring> rings) {
  Polygon polygon;
  for (const Ring& ring : rings) polygon.add_ring(ring);
  return polygon;
}

inline Ring square(float x, float y, float size) {
  return {{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}};
}
inline Ring reversed(Ring ring) {
  std::reverse(ring.begin(), ring.end());
  return ring;
}

struct Line {
  glm::dvec2 a;
  glm::dvec2 b;
};

inline std::vector<Line> lines_of(const Polygon& polygon) {
  std::vector<Line> lines;
  for (std::size_t r = 0; r < polygon.ring_count(); ++r) {
    const auto ring = polygon.ring(r);
    for (std::size_t i = 0; i < ring.size(); ++i) lines.push_back({ring[i], ring[(i + 1) % ring.size()]});
  }
  return lines;
}

inline double perimeter(const Polygon& polygon) {
  double length = 0;
  for (const Line& line : lines_of(polygon)) length += glm::length(line.b - line.a);
  return length;
}

/// Around a place that isn't on a line, counter-clockwise with y up.
inline int winding(const std::vector<Line>& lines, const glm::dvec2& place) {
  int around = 0;
  for (const Line& line : lines) {
    if (line.a.y <= place.y && line.b.y > place.y && orient2d(line.a, line.b, place) > 0) ++around;
    if (line.a.y > place.y && line.b.y <= place.y && orient2d(line.a, line.b, place) < 0) --around;
  }
  return around;
}
inline bool is_inside(FillRule rule, int winding) {
  return rule == FillRule::NonZero ? winding != 0 : (winding & 1) != 0;
}

/// The area where `inside` says so of the windings of the polygons: between all heights where something begins, ends or
/// crosses, lines don't change their order, and what lies between two of them is a trapezoid. Cost O(n³).
template <class Inside>
double brute_area(const std::vector<const Polygon*>& polygons, Inside inside) {
  std::vector<std::pair<Line, std::size_t>> lines;
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    for (const Line& line : lines_of(*polygons[p])) lines.emplace_back(line, p);
  }
  std::vector<double> heights;
  for (const auto& [line, p] : lines) {
    heights.push_back(line.a.y);
    for (const auto& [other, q] : lines) {
      const glm::dvec2 d = line.b - line.a;
      const glm::dvec2 e = other.b - other.a;
      const double parts = d.x * e.y - d.y * e.x;
      if (parts == 0) continue;
      const double t = ((other.a.x - line.a.x) * e.y - (other.a.y - line.a.y) * e.x) / parts;
      if (t > 0 && t < 1) heights.push_back(line.a.y + t * d.y);
    }
  }
  std::sort(heights.begin(), heights.end());
  double area = 0;
  for (std::size_t i = 0; i + 1 < heights.size(); ++i) {
    const double middle = 0.5 * (heights[i] + heights[i + 1]);
    std::vector<std::pair<double, std::pair<std::size_t, int>>> cuts;
    for (const auto& [line, p] : lines) {
      if ((line.a.y < middle) == (line.b.y < middle)) continue;
      const double t = (middle - line.a.y) / (line.b.y - line.a.y);
      cuts.push_back({line.a.x + t * (line.b.x - line.a.x), {p, line.b.y < line.a.y ? 1 : -1}});
    }
    std::sort(cuts.begin(), cuts.end());
    std::vector<int> windings(polygons.size(), 0);
    for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
      windings[cuts[c].second.first] += cuts[c].second.second;
      if (inside(windings)) area += (cuts[c + 1].first - cuts[c].first) * (heights[i + 1] - heights[i]);
    }
  }
  return area;
}

inline double brute_area(const Polygon& polygon, FillRule rule) {
  return brute_area({&polygon}, [&](const std::vector<int>& windings) { return is_inside(rule, windings[0]); });
}

/// Of the grid on which polygons are computed with.
inline double grid_step(const Polygon& polygon) {
  double largest = 1e-45;
  for (const glm::vec2& point : polygon.points) {
    largest = std::max({largest, std::abs(double{point.x}), std::abs(double{point.y})});
  }
  return std::ldexp(1.0, std::ilogb(largest) + 1 - 24);
}

inline double area_of(const TriangulatedPolygon& triangles) {
  double area = 0;
  for (std::size_t t = 0; t < triangles.corners.size(); t += 3) {
    area += 0.5 * orient2d(triangles.points[triangles.corners[t]], triangles.points[triangles.corners[t + 1]],
                           triangles.points[triangles.corners[t + 2]]);
  }
  return area;
}

/// Every triangle has a positive area, and every side has a triangle at most on either side of it.
inline void expect_sound(const TriangulatedPolygon& triangles) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sides;
  for (std::size_t t = 0; t < triangles.corners.size(); t += 3) {
    const std::uint32_t* c = &triangles.corners[t];
    ASSERT_GT(orient2d(triangles.points[c[0]], triangles.points[c[1]], triangles.points[c[2]]), 0)
        << "triangle " << t / 3;
    for (std::size_t i = 0; i < 3; ++i) sides.emplace_back(c[i], c[(i + 1) % 3]);
  }
  std::sort(sides.begin(), sides.end());
  ASSERT_TRUE(std::adjacent_find(sides.begin(), sides.end()) == sides.end());
}

inline Ring star(std::size_t spikes, float inner, float outer, std::mt19937* random = nullptr) {
  std::uniform_real_distribution<float> radius(inner, outer);
  Ring ring;
  for (std::size_t i = 0; i < 2 * spikes; ++i) {
    const double angle = std::numbers::pi * static_cast<double>(i) / static_cast<double>(spikes);
    const double r = random != nullptr ? radius(*random) : i % 2 == 0 ? outer : inner;
    ring.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  return ring;
}

inline Ring comb(std::size_t teeth) {
  Ring ring;
  for (std::size_t i = 0; i < teeth; ++i) {
    ring.emplace_back(static_cast<float>(i), 0.0F);
    ring.emplace_back(static_cast<float>(i) + 0.5F, 100.0F + static_cast<float>(i % 7));
  }
  ring.emplace_back(static_cast<float>(teeth), -1.0F);
  ring.emplace_back(0.0F, -1.0F);
  return reversed(ring);
}

/// A band that goes around `turns` times.
inline Ring spiral(std::size_t points, double turns) {
  Ring ring;
  for (const double width : {0.0, 0.5}) {
    for (std::size_t i = 0; i < points / 2; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(points / 2 - 1);
      const double angle = 2 * std::numbers::pi * turns * (width > 0 ? 1 - share : share);
      const double r = 1 + angle / (2 * std::numbers::pi) + width;
      ring.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
  }
  return ring;
}

}  // namespace azulejo::polygon_testing
