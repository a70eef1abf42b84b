#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/modelling/plane_graph.h"
#include "azulejo/modelling/plane_triangulate.h"
#include "azulejo/modelling/polygon.h"

namespace azulejo::plane {

/// Collects rings on the grid.
class GraphBuilder {
 public:
  explicit GraphBuilder(const Grid& grid) : grid_(grid) {}
  /// Points that aren't finite are left out.
  void add(std::span<const glm::vec2> ring, const Winding& winding);
  void add(const Polygon& polygon, const Winding& winding);
  void add(std::span<const GridPoint> ring, const Winding& winding);
  Graph graph() const { return make_graph(points_, segments_); }

 private:
  void close_ring(std::uint32_t first, const Winding& winding);
  const Grid& grid_;
  Array<GridPoint> points_;
  Array<Segment> segments_;
};

/// The largest coordinate of those that are finite; 0: there are none.
float largest_coordinate(const Polygon& polygon);

/// The edges between inside and outside: their winding a is 1 where the inside is above, else −1.
Graph outline(Graph graph, Inside rule, const Run& run);

/// Rings as `simplified` says.
Polygon rings_of(const Graph& outline, const Grid& grid);

/// Triangles of the inside, and the graph that they are of (whose edges may be cut where they crossed).
struct Triangles {
  Graph graph;
  Array<std::uint32_t> corners;
};
Triangles triangles_of(Graph graph, Inside rule, const Run& run,
                       const std::function<void(const Graph& graph, const MonotonePiece& piece)>& on_piece = {});

}  // namespace azulejo::plane
