#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>

#include "azulejo/data/array.h"

namespace azulejo::plane {

/// Polygons are worked on where arithmetic is exact: on a grid whose coordinates have 24 bits and a sign, so that they
/// are floats, too. Differences have 25 bits, the orientation of three points 52: int64 holds them all.
inline constexpr std::int32_t kGridLimit = 1 << 24;

/// y up. In the order of a line that sweeps to the right, and upwards where it stands.
struct GridPoint {
  std::int32_t x = 0;
  std::int32_t y = 0;
  friend auto operator<=>(const GridPoint&, const GridPoint&) = default;
};

/// Positive where a, b, c turn counter-clockwise.
inline std::int64_t turn(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{b.y - a.y} * (c.x - a.x);
}

/// How often the outlines of two operands go around a place, counter-clockwise.
struct Winding {
  std::int32_t a = 0;
  std::int32_t b = 0;
  Winding operator+(const Winding& other) const { return {a + other.a, b + other.b}; }
  Winding operator-() const { return {-a, -b}; }
  friend bool operator==(const Winding&, const Winding&) = default;
};

/// Maps coordinates to the grid: its step is a power of two, the smallest with which the largest coordinate fits.
class Grid {
 public:
  /// largest  absolute coordinate, finite; 0 is taken as 1
  explicit Grid(float largest);
  /// Rounds to the nearest: by at most 2⁻²⁵ of the largest coordinate, not at all where that is a multiple of the step.
  GridPoint snap(const glm::vec2& point) const;
  /// Exact.
  glm::vec2 place(const GridPoint& point) const;
  double step() const { return step_; }

 private:
  double step_;
  double scale_;
};

/// A directed line whose left side has the winding of its right side plus `winding`.
struct Segment {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  Winding winding;
};

/// An edge between two points of a graph, seen from its left (lower) one.
struct Edge {
  std::uint32_t low = 0;
  std::uint32_t high = 0;  ///< greater than `low`
  Winding winding;         ///< what going across it upwards adds
};

/// Points in the order of the sweep, each once, and edges between them in the order of their lower points, each once.
struct Graph {
  Array<GridPoint> points;
  Array<Edge> edges;
  Array<std::uint32_t> first_edge;  ///< of each point, and the number of edges

  std::span<const Edge> edges_of(std::uint32_t low) const {
    return {edges.data() + first_edge[low], first_edge[low + 1] - first_edge[low]};
  }
};

/// Equal points become one, edges with the same ends one with the sum of windings; those without length or without
/// winding are left out, points without edges stay. Cost O(n), by sorting radices.
/// Any indices within `points`, in any order.
Graph make_graph(std::span<const GridPoint> points, std::span<const Segment> segments);

/// The graph with these edges (of its own points) instead; in any order.
Graph with_edges(Graph graph, const Array<Edge>& edges);

}  // namespace azulejo::plane
