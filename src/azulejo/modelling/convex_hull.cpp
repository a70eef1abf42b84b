#include "azulejo/modelling/convex_hull.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/parallel.h"
#include "azulejo/engine/operation.h"
#include "azulejo/modelling/hull_candidates.h"
#include "azulejo/modelling/hull_polygons.h"
#include "azulejo/modelling/path_polygon.h"
#include "azulejo/modelling/picked_attribute.h"
#include "azulejo/modelling/plane_hull.h"
#include "azulejo/modelling/quick_hull.h"

namespace azulejo {
namespace {

/// Points, and which vertices of the mesh they are.
struct Points {
  std::vector<glm::vec3> positions;
  Array<std::uint32_t> vertices;
};

Points finite_points(const Mesh& mesh, const Run& run) {
  Points points;
  const auto is_finite = [](const glm::vec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  };
  points.positions.reserve(mesh.vertex_count());
  points.vertices.reserve(mesh.vertex_count());
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    if (!is_finite(mesh.positions[v])) continue;
    points.positions.push_back(mesh.positions[v]);
    points.vertices.push_back(static_cast<std::uint32_t>(v));
  }
  const std::size_t left_out = mesh.vertex_count() - points.positions.size();
  if (left_out > 0) {
    warn(run, fmt::format("convex_hull: {} of {} vertices are left out, whose coordinates are not finite", left_out,
                          mesh.vertex_count()));
  }
  return points;
}

Points chosen(const Points& points, std::span<const std::uint32_t> indices) {
  Points result;
  result.positions.reserve(indices.size());
  result.vertices.reserve(indices.size());
  for (const std::uint32_t each : indices) {
    result.positions.push_back(points.positions[each]);
    result.vertices.push_back(points.vertices[each]);
  }
  return result;
}

/// The polygon around points in a plane, which a triangle of them spans.
std::vector<std::uint32_t> flat_polygon(const Points& points, const std::vector<std::uint32_t>& simplex,
                                        const Run& run) {
  const glm::dvec3 a(points.positions[simplex[0]]);
  const glm::dvec3 normal =
      glm::cross(glm::dvec3(points.positions[simplex[1]]) - a, glm::dvec3(points.positions[simplex[2]]) - a);
  const glm::dvec3 size = glm::abs(normal);
  // Seen along the axis that the plane lies across most; the other two in turn.
  const int axis = size.z >= size.x && size.z >= size.y ? 2 : size.y >= size.x ? 1 : 0;
  std::vector<glm::vec2> seen(points.positions.size());
  for (std::size_t i = 0; i < seen.size(); ++i) {
    seen[i] = {points.positions[i][(axis + 1) % 3], points.positions[i][(axis + 2) % 3]};
  }
  return plane_hull(seen, run);
}

/// The polygons as faces of a mesh, whose corners are still indices of points.
void set_faces(Mesh& mesh, const HullPolygons& polygons, HullFaces faces, std::span<const glm::vec3> positions) {
  if (faces == HullFaces::Polygons) {
    mesh.corners.assign(polygons.corners.begin(), polygons.corners.end());
    mesh.face_offsets.assign(polygons.offsets.begin(), polygons.offsets.end());
    return;
  }
  const auto less = [&](std::uint32_t i, std::uint32_t j) {
    const glm::vec3& a = positions[i];
    const glm::vec3& b = positions[j];
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
  };
  mesh.corners.reserve(3 * (polygons.corners.size() - 2 * (polygons.offsets.size() - 1)));
  for (std::size_t p = 0; p + 1 < polygons.offsets.size(); ++p) {
    const std::span<const std::uint32_t> polygon = polygons[p];
    const auto first =
        static_cast<std::size_t>(std::min_element(polygon.begin(), polygon.end(), less) - polygon.begin());
    const auto corner = [&](std::size_t step) { return polygon[(first + step) % polygon.size()]; };
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
      mesh.corners.insert(mesh.corners.end(), {corner(0), corner(i), corner(i + 1)});
    }
  }
}

/// Gives the mesh the vertices that its corners and lines use, in their order.
void set_vertices(Mesh& mesh, const Mesh& source, const Points& points, const std::vector<std::uint32_t>& single) {
  Array<std::uint32_t> place(points.positions.size());
  std::fill(place.begin(), place.end(), 0U);
  for (const std::uint32_t each : mesh.corners) place[each] = 1;
  for (const std::uint32_t each : mesh.lines) place[each] = 1;
  for (const std::uint32_t each : single) place[each] = 1;
  Array<std::uint32_t> used;
  for (std::size_t i = 0; i < place.size(); ++i) {
    if (std::exchange(place[i], static_cast<std::uint32_t>(used.size())) == 0) continue;
    used.push_back(points.vertices[i]);
    mesh.positions.push_back(points.positions[i]);
  }
  for (std::uint32_t& each : mesh.corners) each = place[each];
  for (std::uint32_t& each : mesh.lines) each = place[each];
  for (const Attribute& each : source.attributes) {
    if (each.domain != Domain::Vertex || each.name == "NORMAL" || each.name == "TANGENT") continue;
    mesh.attributes.push_back(picked(each, used));
  }
}

const Operation kDrawingHull = value_operation<DrawingHullOptions>(
    "convex_hull", "Makes the smallest convex solid around a mesh, or area around a drawing.",
    {{"source", "the drawing", ValueKind::Drawing}},
    {{"hull", "one path around all of its paths, in the style of the first", ValueKind::Drawing}},
    {field("tolerance", &DrawingHullOptions::tolerance, {1e-6, 1e6}, "", "how far lines may be from curves")},
    [](std::span<const Value> inputs, const DrawingHullOptions& options, const Run& run) {
      return std::vector<Value>{Value(convex_hull(*inputs[0].drawing(), options, run))};
    });

}  // namespace

extern const Operation kConvexHull = with_examples(
    with_variants(value_operation<ConvexHullOptions>(
                      "convex_hull", "Makes the smallest convex solid around a mesh, or area around a drawing.",
                      {{"source", "the mesh: its vertices count, used by faces or not", ValueKind::Mesh}},
                      {{"hull", "a closed surface with the outermost of its vertices", ValueKind::Mesh}},
                      {field("faces", &ConvexHullOptions::faces, "what is made of corners that lie in one plane")},
                      [](std::span<const Value> inputs, const ConvexHullOptions& options, const Run& run) {
                        return std::vector<Value>{Value(convex_hull(*inputs[0].mesh(), options, run))};
                      }),
                  {&kDrawingHull}),
    {{"primitive:kind=teapot convex_hull render:width=480,height=360",
      "The hull of a teapot: flat where it bridges what is hollow."},
     {"star.svg convex_hull draw", "The hull of a star, in its style."}});

Mesh convex_hull(const Mesh& mesh, const ConvexHullOptions& options, const Run& run) {
  kConvexHull.check(&options);
  Points points = finite_points(mesh, run);
  if (const std::vector<std::uint32_t> kept = hull_candidates(points.positions, run);
      kept.size() < points.positions.size()) {
    points = chosen(points, kept);
  }
  const QuickHull hull = quick_hull(points.positions, run);
  Mesh result;
  result.name = mesh.name;
  result.space = mesh.space;
  if (hull.dimension == 3) {
    set_faces(result, hull_polygons(points.positions, hull), options.faces, points.positions);
  } else if (hull.dimension == 2) {
    HullPolygons flat;
    flat.corners = flat_polygon(points, hull.simplex, run);
    flat.offsets.push_back(static_cast<std::uint32_t>(flat.corners.size()));
    set_faces(result, flat, options.faces, points.positions);
  } else if (hull.dimension == 1) {
    result.lines.assign(hull.simplex.begin(), hull.simplex.end());
  }
  set_vertices(result, mesh, points, hull.dimension == 0 ? hull.simplex : std::vector<std::uint32_t>());
  return result;
}

Drawing convex_hull(const Drawing& drawing, const DrawingHullOptions& options, const Run& run) {
  kDrawingHull.check(&options);
  warn_of_clips(drawing, run);
  Drawing result;
  result.width = drawing.width;
  result.height = drawing.height;
  result.unit = drawing.unit;
  result.patterns = drawing.patterns;
  std::vector<glm::vec2> points;
  std::optional<DrawingStyle> style;
  for (const PlacedPath& placed : walk(drawing)) {
    const Polygon polygon =
        polygon_of(drawing.view(drawing.paths[placed.path]), placed.page_from_path, options.tolerance);
    const std::size_t before = points.size();
    std::copy_if(polygon.points.begin(), polygon.points.end(), std::back_inserter(points),
                 [](const glm::vec2& p) { return std::isfinite(p.x) && std::isfinite(p.y); });
    if (!style && points.size() > before) style = placed_style(drawing, placed, result);
  }
  const std::vector<std::uint32_t> hull = plane_hull(points, run);
  if (hull.size() < 2) return result;
  Path path;
  path.move_to(points[hull[0]]);
  for (std::size_t i = 1; i < hull.size(); ++i) path.line_to(points[hull[i]]);
  if (hull.size() > 2) path.close();
  result.add_path(path, result.add_style(*style));
  return result;
}

}  // namespace azulejo
