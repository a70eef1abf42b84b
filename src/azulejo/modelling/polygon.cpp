#include "azulejo/modelling/polygon.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "azulejo/modelling/plane_overlay.h"

namespace azulejo {
namespace {

plane::Inside inside(FillRule rule) {
  return rule == FillRule::NonZero ? plane::Inside::NonZero : plane::Inside::EvenOdd;
}

plane::Inside inside(BooleanMode mode) {
  switch (mode) {
    case BooleanMode::Union: return plane::Inside::Union;
    case BooleanMode::Intersection: return plane::Inside::Intersection;
    case BooleanMode::Difference: return plane::Inside::Difference;
    case BooleanMode::Xor: return plane::Inside::Xor;
  }
  return plane::Inside::Union;
}

}  // namespace

TriangulatedPolygon tessellate(const Polygon& polygon, FillRule rule, const Run& run) {
  const plane::Grid grid(plane::largest_coordinate(polygon));
  plane::GraphBuilder builder(grid);
  builder.add(polygon, {1, 0});
  plane::Triangles triangles = plane::triangles_of(builder.graph(), inside(rule), run);
  TriangulatedPolygon result;
  result.corners = std::move(triangles.corners);
  // Points that no triangle names are left out.
  std::vector<std::uint32_t> place(triangles.graph.points.size(), 0);
  for (const std::uint32_t corner : result.corners) place[corner] = 1;
  for (std::size_t i = 0; i < place.size(); ++i) {
    if (place[i] == 0) continue;
    place[i] = static_cast<std::uint32_t>(result.points.size());
    result.points.push_back(grid.place(triangles.graph.points[i]));
  }
  for (std::uint32_t& corner : result.corners) corner = place[corner];
  return result;
}

Polygon simplified(const Polygon& polygon, FillRule rule, const Run& run) {
  const plane::Grid grid(plane::largest_coordinate(polygon));
  plane::GraphBuilder builder(grid);
  builder.add(polygon, {1, 0});
  return rings_of(outline(builder.graph(), inside(rule), run), grid);
}

Polygon boolean(const Polygon& a, const Polygon& b, BooleanMode mode, const Run& run) {
  const plane::Grid grid(std::max(plane::largest_coordinate(a), plane::largest_coordinate(b)));
  plane::GraphBuilder builder(grid);
  builder.add(a, {1, 0});
  builder.add(b, {0, 1});
  return rings_of(outline(builder.graph(), inside(mode), run), grid);
}

}  // namespace azulejo
