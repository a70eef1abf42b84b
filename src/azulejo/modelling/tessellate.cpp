#include "azulejo/modelling/tessellate.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "azulejo/core/parallel.h"
#include "azulejo/engine/operation.h"
#include "azulejo/engine/stages.h"
#include "azulejo/modelling/path_polygon.h"
#include "azulejo/modelling/picked_attribute.h"
#include "azulejo/modelling/plane_overlay.h"
#include "azulejo/modelling/triangulate.h"

namespace azulejo {
namespace {

/// A path that is filled, and what becomes of it.
struct FilledPath {
  PlacedPath placed;
  Polygon polygon;
  plane::Triangles triangles;
  std::vector<std::vector<glm::vec2>> pieces;
};

std::uint8_t byte_of(float share) { return static_cast<std::uint8_t>(std::lrint(255 * std::clamp(share, 0.0F, 1.0F))); }

std::array<std::uint8_t, 4> color_of(const Drawing& drawing, const FilledPath& path) {
  const DrawingStyle& style = drawing.styles[drawing.paths[path.placed.path].style];
  glm::vec4 color = style.fill->color;
  if (style.fill->pattern) {
    const auto* gradient = std::get_if<Gradient>(&drawing.patterns[*style.fill->pattern]);
    if (gradient != nullptr && !gradient->stops.empty()) {
      const glm::vec4& first = gradient->stops.front().color;
      color = {first.x, first.y, first.z, first.w * color.w};
    }
  }
  return {byte_of(color.x), byte_of(color.y), byte_of(color.z), byte_of(color.w * style.opacity * path.placed.opacity)};
}

std::vector<glm::vec2> outline_of(const plane::Graph& graph, const plane::MonotonePiece& piece,
                                  const plane::Grid& grid) {
  std::vector<glm::vec2> points;
  const auto add = [&](std::uint32_t point) {
    const glm::vec2 place = grid.place(graph.points[point]);
    points.emplace_back(place.x, -place.y);
  };
  for (const std::uint32_t point : piece.lower) add(point);
  for (std::size_t i = piece.upper.size() - 1; i-- > 1;) add(piece.upper[i]);
  return points;
}

void triangulate(const Drawing& drawing, FilledPath& path, const plane::Grid& grid, const Run& run) {
  const DrawingStyle& style = drawing.styles[drawing.paths[path.placed.path].style];
  plane::GraphBuilder builder(grid);
  builder.add(path.polygon, {1, 0});
  std::function<void(const plane::Graph&, const plane::MonotonePiece&)> on_piece;
  if (run.stages != nullptr) {
    on_piece = [&](const plane::Graph& graph, const plane::MonotonePiece& piece) {
      path.pieces.push_back(outline_of(graph, piece, grid));
    };
  }
  const plane::Inside rule = style.fill_rule == FillRule::NonZero ? plane::Inside::NonZero : plane::Inside::EvenOdd;
  path.triangles = plane::triangles_of(builder.graph(), rule, run, on_piece);
}

void report_pieces(const Drawing& drawing, const std::vector<FilledPath>& paths, const Run& run) {
  Drawing pieces;
  pieces.width = drawing.width;
  pieces.height = drawing.height;
  pieces.unit = drawing.unit;
  DrawingStyle style;
  style.stroke = Paint({0, 0, 0, 1});
  style.stroke_width = 1;
  style.fixed_stroke = true;
  std::uint32_t shade = 0;
  for (const FilledPath& path : paths) {
    for (const std::vector<glm::vec2>& piece : path.pieces) {
      Polygon polygon;
      polygon.add_ring(piece);
      const float light = 0.6F + 0.1F * static_cast<float>(shade++ % 4);  // neighbours can be told apart
      style.fill = Paint({light, light, light, 1});
      pieces.add_path(path_of(polygon), pieces.add_style(style), drawing.paths[path.placed.path].id);
    }
  }
  run.stages->drawing("tessellate", "monotone_pieces", pieces);
}

Mesh mesh_of(const Drawing& drawing, const std::vector<FilledPath>& paths, const plane::Grid& grid) {
  Mesh mesh;
  Array<std::uint8_t> colors;
  Array<std::uint32_t> path_of_face;
  std::vector<std::uint32_t> place;
  for (const FilledPath& path : paths) {
    const plane::Graph& graph = path.triangles.graph;
    place.assign(graph.points.size(), 0);
    for (const std::uint32_t corner : path.triangles.corners) place[corner] = 1;
    const std::array<std::uint8_t, 4> color = color_of(drawing, path);
    for (std::size_t i = 0; i < place.size(); ++i) {
      if (place[i] == 0) continue;
      place[i] = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.emplace_back(grid.place(graph.points[i]), 0.0F);
      colors.insert(colors.end(), color.begin(), color.end());
    }
    for (const std::uint32_t corner : path.triangles.corners) mesh.corners.push_back(place[corner]);
    path_of_face.resize(mesh.corners.size() / 3, path.placed.path);
  }
  mesh.attributes.push_back({"COLOR_0", Domain::Vertex, 4, std::move(colors)});
  mesh.attributes.push_back({"path", Domain::Face, 1, std::move(path_of_face)});
  return mesh;
}

std::vector<Value> run_tessellate(std::span<const Value> inputs, const TessellateOptions& options, const Run& run) {
  std::vector<Value> results;
  results.emplace_back(tessellate(*inputs[0].drawing(), options, run));
  return results;
}

}  // namespace

namespace {

struct NoOptions {};

const Operation kTessellateMesh = value_operation<NoOptions>(
    "tessellate", "Turns what a drawing fills, or the faces of a mesh, into triangles.",
    {{"source", "the mesh", ValueKind::Mesh}}, {{"mesh", "the same surface, of triangles only", ValueKind::Mesh}}, {},
    [](std::span<const Value> inputs, const NoOptions&, const Run& run) {
      return std::vector<Value>{Value(tessellate(*inputs[0].mesh(), run))};
    });

}  // namespace

extern const Operation kTessellate = with_examples(
    with_variants(
        value_operation<TessellateOptions>(
            "tessellate", "Turns what a drawing fills, or the faces of a mesh, into triangles.",
            {{"source", "the drawing: its fills, not its lines", ValueKind::Drawing}},
            {{"mesh", "triangles in the plane z = 0, y up, with the colors of the fills", ValueKind::Mesh}},
            {field("tolerance", &TessellateOptions::tolerance, {1e-6, 1e6}, "", "how far lines may be from curves")},
            run_tessellate),
        {&kTessellateMesh}),
    {{"star.svg tessellate wireframe:view=front,width=480,height=360",
      "The star as triangles: where its line crosses itself there are new points."},
     {"disk.svg tessellate:tolerance=2 wireframe:view=front,width=480,height=360",
      "A circle, with lines that are up to 2 px from it."}});

Mesh tessellate(const Mesh& mesh, const Run& run) {
  const Triangulation parts = triangulate(mesh, run);
  Mesh result = mesh.clone();
  result.face_offsets.clear();
  result.corners.resize(parts.corners.size());
  for (std::size_t c = 0; c < parts.corners.size(); ++c) result.corners[c] = mesh.corners[parts.corners[c]];
  for (Attribute& each : result.attributes) {
    if (each.domain == Domain::Corner) each = picked(each, parts.corners);
    if (each.domain == Domain::Face) each = picked(each, parts.face);
  }
  if (!mesh.material.empty()) {
    result.material.resize(parts.face.size());
    for (std::size_t t = 0; t < parts.face.size(); ++t) result.material[t] = mesh.material[parts.face[t]];
  }
  return result;
}

Mesh tessellate(const Drawing& drawing, const TessellateOptions& options, const Run& run) {
  kTessellate.check(&options);
  warn_of_unfilled(drawing, run);
  std::vector<FilledPath> paths;
  for (const PlacedPath& placed : walk(drawing)) {
    if (drawing.styles[drawing.paths[placed.path].style].fill) paths.push_back({placed, {}, {}, {}});
  }
  std::vector<float> largest(paths.size(), 0);
  parallel_tasks(paths.size(), run, [&](std::size_t p, int) {
    const PlacedPath& placed = paths[p].placed;
    const glm::mat3x2 upright = combined({1, 0, 0, -1, 0, 0}, placed.page_from_path);
    paths[p].polygon = polygon_of(drawing.view(drawing.paths[placed.path]), upright, options.tolerance);
    largest[p] = plane::largest_coordinate(paths[p].polygon);
  });
  // One grid for all: what has a border in common has it there, too.
  const plane::Grid grid(paths.empty() ? 0 : *std::max_element(largest.begin(), largest.end()));
  parallel_tasks(paths.size(), run, [&](std::size_t p, int) { triangulate(drawing, paths[p], grid, run); });
  if (run.stages != nullptr) report_pieces(drawing, paths, run);
  return mesh_of(drawing, paths, grid);
}

}  // namespace azulejo
