#include "azulejo/modelling/winged_edge_report.h"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "azulejo/engine/operation.h"
#include "azulejo/engine/stages.h"
#include "azulejo/modelling/polygon_soup.h"

namespace azulejo {
namespace {

Json number(std::size_t value) { return Json(static_cast<std::uint64_t>(value)); }

/// An element's number, null for none.
Json element(std::uint32_t index) { return index == kNoElement ? Json() : number(index); }

template <class List>
Json elements(const List& list) {
  Json json = Json::array();
  for (const std::uint32_t each : list) json.push(element(each));
  return json;
}

template <class Halves>
Json edges_of(const Halves& halves) {
  Json json = Json::array();
  for (const WingedEdge::Half half : halves) json.push(number(half >> 1));
  return json;
}

Json records(const WingedEdge& solid) {
  Json vertices = Json::array();
  Json edges = Json::array();
  Json faces = Json::array();
  for (std::uint32_t f = 0; f < solid.face_slots(); ++f) {
    if (!solid.face_alive(f)) {
      faces.push(Json());
      continue;
    }
    Json loops = Json::array();
    for (const std::uint32_t loop : solid.loops_of(f)) loops.push(edges_of(solid.halves_of(loop)));
    faces.push(Json::object().set("loops", loops).set("source", element(solid.face(f).source)));
  }
  for (std::uint32_t e = 0; e < solid.edge_slots(); ++e) {
    if (!solid.edge_alive(e)) {
      edges.push(Json());
      continue;
    }
    const WingedEdge::Edge& edge = solid.edge(e);
    edges.push(Json::object()
                   .set("vertices", elements(edge.vertex))
                   .set("faces", elements(edge.face))
                   .set("wings", elements(edge.wing)));
  }
  for (std::uint32_t v = 0; v < solid.vertex_slots(); ++v) {
    if (!solid.vertex_alive(v)) {
      vertices.push(Json());
      continue;
    }
    const glm::vec3& at = solid.vertex(v).position;
    vertices.push(Json::object()
                      .set("position", Json::array().push(at.x).push(at.y).push(at.z))
                      .set("edges", edges_of(solid.edges_of(v)))
                      .set("source", element(solid.vertex(v).source)));
  }
  return Json::object().set("faces", faces).set("edges", edges).set("vertices", vertices);
}

Json lines(std::string_view text) {
  Json json = Json::array();
  for (std::size_t at = 0, end = 0; (end = text.find('\n', at)) != std::string_view::npos; at = end + 1) {
    json.push(text.substr(at, end - at));
  }
  return json;
}

Json splits(const std::vector<std::array<std::uint32_t, 2>>& edges, std::size_t at_most) {
  Json json = Json::array();
  for (std::size_t i = 0; i < std::min(edges.size(), at_most); ++i) json.push(elements(edges[i]));
  return json;
}

Json first_of(const std::vector<std::uint32_t>& list, std::size_t at_most) {
  return elements(std::span(list).first(std::min(list.size(), at_most)));
}

std::vector<Value> run_winged_edge(std::span<const Value> inputs, const WingedEdgeOptions& options, const Run& run) {
  const Mesh& mesh = *inputs[0].mesh();
  const WingedEdgeOfMesh made = winged_edge(mesh, run);
  Report report = report_of(made, mesh, options);
  Mesh back = mesh_of(made.solid, &mesh);
  if (options.soup) back = polygon_soup(back, run);
  if (run.stages != nullptr) {
    const StageReporter stages(*run.stages, "winged_edge");
    stages.mesh("polygon_soup", polygon_soup(mesh, run));
    stages.mesh("vertex_list", mesh);
    stages.report("winged_edge", report.json);
  }
  std::vector<Value> values;
  values.emplace_back(std::move(report));
  values.emplace_back(std::move(back));
  return values;
}

}  // namespace

Report report_of(const WingedEdgeOfMesh& made, const Mesh& mesh, const WingedEdgeOptions& options) {
  const WingedEdge& solid = made.solid;
  const WingedEdgeChanges& changes = made.changes;
  const auto at_most = static_cast<std::size_t>(options.listed);
  Report report;
  Json& json = report.json;
  json.set("vertices", number(solid.vertex_count())).set("edges", number(solid.edge_count()));
  json.set("faces", number(solid.face_count())).set("loops", number(solid.loop_count()));
  json.set("shells", number(solid.shell_count())).set("border_loops", number(solid.border_loop_count()));
  json.set("edges_split", number(changes.split_edges.size()))
      .set("vertices_split", number(changes.split_vertices.size()));
  json.set("faces_dropped", number(changes.dropped_faces.size()));
  json.set("bytes_polygon_soup", number(polygon_soup_bytes(mesh)));
  json.set("bytes_vertex_list", number(vertex_list_bytes(mesh)));
  json.set("bytes_winged_edge", number(solid.memory_bytes()));
  if (!changes.none()) {
    json.set("changes", Json::object()
                            .set("split_edges", splits(changes.split_edges, at_most))
                            .set("split_vertices", first_of(changes.split_vertices, at_most))
                            .set("dropped_faces", first_of(changes.dropped_faces, at_most)));
  }
  const bool small = solid.edge_count() <= at_most;
  json.set("table", small ? lines(solid.table()) : Json()).set("records", small ? records(solid) : Json());
  return report;
}

extern const Operation kWingedEdge = with_examples(
    value_operation<WingedEdgeOptions>(
        "winged_edge", "Tells the faces, edges and vertices of a mesh as a winged edge.",
        {{"source", "the mesh", ValueKind::Mesh}},
        {{"report", "a table, its records as numbers, what was split, and the memory of each representation",
          ValueKind::Report},
         {"mesh", "what the winged edge holds: no edge has three faces, no vertex two fans of them", ValueKind::Mesh}},
        {field("listed", &WingedEdgeOptions::listed, {0, 1e6}, "", "edges up to which the table is told"),
         field("soup", &WingedEdgeOptions::soup, "the mesh comes back as polygons that share no vertices")},
        run_winged_edge),
    {{"primitive:kind=tetrahedron winged_edge",
      "Four faces with their edges; six edges, each with two vertices, the faces left and right of it and four wings; "
      "four vertices with their places and edges."}});

}  // namespace azulejo
