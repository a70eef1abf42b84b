#include "azulejo/rendering/wireframe.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/engine/field_group.h"
#include "azulejo/engine/operation.h"
#include "azulejo/io/weld.h"
#include "azulejo/math/transfer.h"
#include "azulejo/modelling/mesh_edges.h"
#include "azulejo/modelling/normals.h"
#include "azulejo/rendering/camera_fields.h"
#include "azulejo/rendering/clip.h"
#include "azulejo/rendering/edge_chains.h"
#include "azulejo/rendering/render.h"
#include "azulejo/rendering/vertex_stage.h"
#include "azulejo/rendering/viewing_stages.h"

namespace azulejo {
namespace {

constexpr double kRadians = 3.14159265358979323846 / 180;
constexpr std::size_t kLongest = 1024;                     ///< edges of a line
constexpr std::size_t kPathPoints = std::size_t{1} << 14;  ///< about that many of a path
constexpr std::size_t kVertices = std::size_t{1} << 15;    ///< of a task
constexpr std::uint32_t kNoMaterial = MaterialId::kNone;

/// The edges of a mesh that are wanted, end to end, of one material.
struct Lines {
  std::uint32_t material = kNoMaterial;
  EdgeChains chains;
};

/// What is drawn of a mesh, wherever it stands.
struct Outline {
  std::vector<Lines> lines;
  Array<std::uint32_t> points;
  std::size_t edges = 0;
};

/// Whether an edge is wanted by edges=feature.
class Features {
 public:
  Features(const Mesh& mesh, float crease_angle_deg, const Run& run)
      : normals_(face_normals(mesh, run)),
        cosine_(static_cast<float>(std::cos(static_cast<double>(crease_angle_deg) * kRadians))) {}
  bool operator()(const MeshEdge& edge) const {
    if (edge.faces != 2) return true;
    const glm::vec3& a = normals_[edge.face];
    const glm::vec3& b = normals_[edge.other_face];
    if (a == glm::vec3(0) || b == glm::vec3(0)) return false;  // has no direction
    return (edge.turned ? -1.0F : 1.0F) * glm::dot(a, b) < cosine_;
  }

 private:
  Array<glm::vec3> normals_;
  float cosine_;
};

using Edge = std::pair<std::uint32_t, std::uint32_t>;
using EdgesByMaterial = std::map<std::uint32_t, std::vector<Edge>>;

/// The wanted edges in vertices; where several are at one position, the first of them stands for all.
EdgesByMaterial wanted_edges(const Mesh& mesh, const WireframeOptions& options, const Run& run) {
  const Array<std::uint32_t> welded = weld_exactly(mesh.positions, run).corners;
  Array<std::uint32_t> first(welded.size(), 0);
  for (std::size_t v = welded.size(); v-- > 0;) first[welded[v]] = static_cast<std::uint32_t>(v);
  const bool by_material = options.material_colors && !mesh.material.empty();
  std::optional<Features> features;
  if (options.edges == WireframeEdges::Feature) features.emplace(mesh, options.crease_angle_deg, run);
  EdgesByMaterial result;
  std::vector<Edge>* list = &result[kNoMaterial];
  std::uint32_t current = kNoMaterial;
  for (const MeshEdge& edge : mesh_edges(mesh, welded, run)) {
    if (options.edges == WireframeEdges::Border && edge.faces != 1) continue;
    if (features && !(*features)(edge)) continue;
    const std::uint32_t material = by_material ? mesh.material[edge.face] : kNoMaterial;
    if (material != current) list = &result[current = material];
    list->emplace_back(first[welded[mesh.corners[edge.begin]]], first[welded[mesh.corners[edge.end]]]);
  }
  if (options.edges == WireframeEdges::Border) return result;
  for (std::size_t l = 0; l + 1 < mesh.lines.size(); l += 2) {
    const Edge line(first[welded[mesh.lines[l]]], first[welded[mesh.lines[l + 1]]]);
    if (line.first != line.second) result[kNoMaterial].push_back(line);
  }
  return result;
}

Outline outline_of(const Mesh& mesh, const WireframeOptions& options, const Run& run) {
  Outline outline;
  const bool alone = mesh.face_count() == 0 && mesh.lines.empty();
  std::vector<bool> marked(options.point_size > 0 ? mesh.vertex_count() : 0, alone);
  for (const auto& [material, edges] : wanted_edges(mesh, options, run)) {
    outline.edges += edges.size();
    if (!marked.empty()) {
      for (const Edge& edge : edges) marked[edge.first] = marked[edge.second] = true;
    }
    if (!edges.empty()) {
      outline.lines.push_back({material, edge_chains(edges, mesh.vertex_count(), options.edge_ids ? 1 : kLongest)});
    }
  }
  for (std::uint32_t v = 0; v < marked.size(); ++v) {
    if (marked[v]) outline.points.push_back(v);
  }
  return outline;
}

/// A segment of the page, and which of its ends are where the edge's are.
struct Segment {
  glm::dvec2 a;
  glm::dvec2 b;
  bool from_a = true;
  bool to_b = true;
};

/// The part of a segment inside a rectangle. Source: Liang & Barsky, 1984
bool clip_to(Segment& segment, const Window& box) {
  const glm::dvec2 d = segment.b - segment.a;
  double from = 0;
  double to = 1;
  const double steps[4] = {-d.x, d.x, -d.y, d.y};
  const double rooms[4] = {segment.a.x - box.x0, box.x1 - segment.a.x, segment.a.y - box.y0, box.y1 - segment.a.y};
  for (int side = 0; side < 4; ++side) {
    if (steps[side] == 0 && rooms[side] < 0) return false;
    if (steps[side] < 0) from = std::max(from, rooms[side] / steps[side]);
    if (steps[side] > 0) to = std::min(to, rooms[side] / steps[side]);
  }
  if (from > to) return false;
  const glm::dvec2 a = segment.a;
  if (from > 0) segment.a = a + from * d;
  if (to < 1) segment.b = a + to * d;
  segment.from_a = segment.from_a && from == 0;
  segment.to_b = segment.to_b && to == 1;
  return true;
}

glm::vec2 in_steps(const glm::dvec2& point) {
  constexpr double kSteps = 100;
  return glm::vec2(glm::dvec2(std::nearbyint(point.x * kSteps), std::nearbyint(point.y * kSteps)) / kSteps);
}

/// Where the vertices of a mesh at a place are on the page.
class Projection {
 public:
  /// margin  beyond the viewport, in pixels, that lines may reach
  Projection(const Mesh& mesh, const glm::mat4& world_from_mesh, const View& view, double margin, const Run& run)
      : mesh_(mesh),
        clip_from_mesh_(view.clip_from_world() * world_from_mesh),
        transform_(screen_transform(view.viewport)),
        box_(window_of(view.viewport)),
        vertices_(mesh.vertex_count()) {
    box_ = {box_.x0 - margin, box_.y0 - margin, box_.x1 + margin, box_.y1 + margin};
    parallel_for(mesh.vertex_count(), kVertices, run, [&](std::size_t begin, std::size_t end) {
      kernels::transform_vertices(mesh.positions.data() + begin, end - begin, clip_from_mesh_, transform_,
                                  vertices_.data() + begin);
    });
  }

  std::optional<Segment> segment(std::uint32_t from, std::uint32_t to) const {
    const ScreenVertex& a = vertices_[from];
    const ScreenVertex& b = vertices_[to];
    Segment segment{{a.x, a.y}, {b.x, b.y}};
    if (std::isnan(a.x) || std::isnan(b.x)) {
      const ClippedPolygon line = clip_segment({clip(from), clip(to)}, transform_);
      if (line.count < 2) return std::nullopt;
      segment = {{line.vertices[0].x, line.vertices[0].y},
                 {line.vertices[1].x, line.vertices[1].y},
                 !std::isnan(a.x),
                 !std::isnan(b.x)};
    }
    if (inside(segment.a) && inside(segment.b)) return segment;
    if (!clip_to(segment, box_)) return std::nullopt;
    return segment;
  }

  std::optional<glm::dvec2> point(std::uint32_t vertex) const {
    const glm::dvec2 at(vertices_[vertex].x, vertices_[vertex].y);
    return inside(at) ? std::optional(at) : std::nullopt;
  }

 private:
  /// False for NaN.
  bool inside(const glm::dvec2& p) const {
    return p.x >= box_.x0 && p.x <= box_.x1 && p.y >= box_.y0 && p.y <= box_.y1;
  }
  glm::vec4 clip(std::uint32_t vertex) const { return to_clip(clip_from_mesh_, mesh_.positions[vertex]); }

  const Mesh& mesh_;
  glm::mat4 clip_from_mesh_;
  ScreenTransform transform_;
  Window box_;
  Array<ScreenVertex> vertices_;
};

/// Lines into the paths of a group.
class PathWriter {
 public:
  PathWriter(Drawing& drawing, std::uint32_t style, std::string id, std::uint32_t group)
      : drawing_(drawing), style_(style), id_(std::move(id)), group_(group) {}

  void add_line(const Projection& projection, std::span<const std::uint32_t> vertices) {
    bool open = false;
    bool whole = vertices.front() == vertices.back();
    for (std::size_t i = 1; i < vertices.size(); ++i) {
      const std::optional<Segment> segment = projection.segment(vertices[i - 1], vertices[i]);
      if (!segment) {
        open = whole = false;
        continue;
      }
      const glm::vec2 from = in_steps(segment->a);
      const glm::vec2 to = in_steps(segment->b);
      whole = whole && segment->from_a && segment->to_b;
      if (!open || !segment->from_a) {
        drop_move();
        path_.move_to(from);
      }
      const bool begun = path_.commands.back() != PathCommand::Move;
      const bool closes = whole && i + 1 == vertices.size();
      if (begun ? closes || to != path_.points.back() : to != from || to != dot_) {
        if (!begun && to == from) dot_ = to;  // what is smaller than a step is one dot
        closes ? path_.close() : path_.line_to(to);
      }
      open = segment->to_b;
    }
    drop_move();
    if (path_.points.size() >= kPathPoints) flush();
  }

  void add_point(const glm::dvec2& point) {
    path_.move_to(in_steps(point)).close();
    if (path_.points.size() >= kPathPoints) flush();
  }

  void flush(const std::string& id = {}) {
    if (!path_.commands.empty()) drawing_.add_path(path_, style_, id.empty() ? id_ : id, group_);
    path_ = {};
  }

 private:
  /// Begun, and nothing followed.
  void drop_move() {
    if (path_.commands.empty() || path_.commands.back() != PathCommand::Move) return;
    path_.commands.pop_back();
    path_.points.pop_back();
  }

  Drawing& drawing_;
  std::uint32_t style_;
  std::string id_;
  std::uint32_t group_;
  Path path_;
  glm::vec2 dot_{-1e30F, -1e30F};  ///< the last line without length
};

class Wireframe {
 public:
  Wireframe(const Scene& scene, const View& view, const WireframeOptions& options)
      : scene_(scene), view_(view), options_(options) {
    drawing_.width = static_cast<float>(view.width);
    drawing_.height = static_cast<float>(view.height);
    const Rect& viewport = view.viewport;
    if (viewport == Rect{0, 0, view.width, view.height}) return;
    const std::uint32_t clip = drawing_.add_clip();
    const Window box = window_of(viewport);
    const auto corner = [](double x, double y) { return glm::vec2(glm::dvec2(x, y)); };
    Path path;
    path.move_to(corner(box.x0, box.y0)).line_to(corner(box.x1, box.y0));
    path.line_to(corner(box.x1, box.y1)).line_to(corner(box.x0, box.y1)).close();
    drawing_.add_path(path, drawing_.add_style({}), {}, clip);
    parent_ = drawing_.add_group({1, 0, 0, 1, 0, 0});
    drawing_.groups[parent_].clip = clip;
    drawing_.groups[parent_].id = "viewport";
  }

  void add(const Outline& outline, const Mesh& mesh, const PlacedNode& placed, const Run& run) {
    const double margin = 0.5 * static_cast<double>(std::max(options_.line_width, options_.point_size)) + 1;
    const Projection projection(mesh, placed.world_from_node, view_, margin, run);
    const std::uint32_t group = drawing_.add_group({1, 0, 0, 1, 0, 0}, options_.color.a, parent_);
    const Node& node = scene_.nodes[placed.node.index];
    drawing_.groups[group].id = !node.name.empty()   ? node.name
                                : !mesh.name.empty() ? mesh.name
                                                     : fmt::format("node-{}", placed.node.index);
    for (const Lines& lines : outline.lines) add_lines(lines, projection, group);
    if (outline.points.empty()) return;
    DrawingStyle marks;
    marks.fill.reset();
    marks.points = Paint(opaque(options_.color));
    marks.point_size = options_.point_size;
    marks.point_shape = options_.point_shape;
    PathWriter writer(drawing_, drawing_.add_style(marks), "points", group);
    for (const std::uint32_t vertex : outline.points) {
      if (const std::optional<glm::dvec2> point = projection.point(vertex)) writer.add_point(*point);
    }
    writer.flush();
  }

  Drawing take() { return std::move(drawing_); }

 private:
  static glm::vec4 opaque(const Color& color) { return {color.r, color.g, color.b, 1}; }

  void add_lines(const Lines& lines, const Projection& projection, std::uint32_t group) {
    DrawingStyle style;
    style.fill.reset();
    style.stroke = Paint(opaque(options_.color));
    style.stroke_width = options_.line_width;
    style.cap = LineCap::Round;
    style.join = LineJoin::Round;
    std::string id = "edges";
    if (lines.material != kNoMaterial) {
      const Material& material = scene_.materials[lines.material];
      const auto encoded = [&](int c) { return linear_to_srgb(std::clamp(material.base_color[c], 0.0F, 1.0F)); };
      style.stroke = Paint(glm::vec4(encoded(0), encoded(1), encoded(2), 1));
      id += ":" + (material.name.empty() ? fmt::format("{}", lines.material) : material.name);
    }
    PathWriter writer(drawing_, drawing_.add_style(style), id, group);
    for (std::size_t line = 0; line < lines.chains.size(); ++line) {
      const std::span<const std::uint32_t> vertices = lines.chains[line];
      writer.add_line(projection, vertices);
      if (options_.edge_ids) writer.flush(fmt::format("edge-{}-{}", vertices[0], vertices[1]));
    }
    writer.flush();
  }

  const Scene& scene_;
  const View& view_;
  const WireframeOptions& options_;
  Drawing drawing_;
  std::uint32_t parent_ = 0;
};

void check(const WireframeOptions& options) {
  const auto refuse = [](const char* name, float got, const char* wanted) {
    throw Error(Error::Argument, fmt::format("{}: {}, expected {}", name, got, wanted));
  };
  if (!(options.line_width >= 0 && options.line_width <= 1000)) refuse("line_width", options.line_width, "0 to 1000");
  if (!(options.point_size >= 0 && options.point_size <= 1000)) refuse("point_size", options.point_size, "0 to 1000");
  if (!(options.crease_angle_deg >= 0 && options.crease_angle_deg <= 180)) {
    refuse("crease_angle_deg", options.crease_angle_deg, "0 to 180");
  }
}

std::vector<Field> page_fields() {
  using Options = WireframeOptions;
  return {field("width", &Options::width, {1, 65536}, "px", "of the page"),
          field("height", &Options::height, {1, 65536}, "px", "of the page")};
}

std::vector<Field> line_fields() {
  using Options = WireframeOptions;
  return {
      field("edges", &Options::edges, "which edges: of all faces; sharp ones and borders; borders alone"),
      field("crease_angle_deg", &Options::crease_angle_deg, {0, 180}, "deg",
            "of edges=feature: sharper edges are drawn"),
      field("color", &Options::color, "of lines and marks"),
      field("material_colors", &Options::material_colors, "edges have the base color of their face's material"),
      field("line_width", &Options::line_width, {0, 1000}, "px", "of lines"),
      field("point_size", &Options::point_size, {0, 1000}, "px", "of a mark on each vertex; 0: none"),
      field("point_shape", &Options::point_shape, "of the marks"),
      field("edge_ids", &Options::edge_ids, "a path for each edge, named by its vertices: edge-12-57"),
      field("animation", &Options::animation, "which animation, by name or number"),
      field("time_s", &Options::time_s, {-1e9, 1e9}, "s", "time in the animation"),
  };
}

std::vector<Value> run_wireframe(std::span<const Value> inputs, const WireframeOptions& options, const Run& run) {
  std::vector<Value> results;
  results.emplace_back(wireframe(*inputs[0].scene(), options, run));
  return results;
}

}  // namespace

extern const Operation kWireframe = value_operation<WireframeOptions>(
    "wireframe", "Draws the edges of a model as lines.", {{"scene", "the model", ValueKind::Scene}},
    {{"drawing", "the lines, named after nodes and materials", ValueKind::Drawing}},
    joined({page_fields(), nested(&WireframeOptions::camera, camera_fields()), line_fields()}), run_wireframe);

Drawing wireframe(const Scene& scene, const WireframeOptions& options, const Run& run) {
  check(options);
  const std::optional<Scene> posed = posed_scene(scene, options.animation, options.time_s, run);
  const Scene& now = posed ? *posed : scene;
  const View view = choose_camera(now, options.camera, options.width, options.height, run).view;
  report_viewing(now, view, "wireframe", run);
  Wireframe result(now, view, options);
  std::vector<std::optional<Outline>> outlines(now.meshes.size());
  constexpr std::int64_t kEdgeBytes = 12;
  std::int64_t bytes = 0;
  for (const PlacedNode& placed : walk(now)) {
    const MeshId id = now.nodes[placed.node.index].mesh;
    if (!placed.visible || !id) continue;
    check_cancelled(run);
    const Mesh& mesh = *now.meshes[id.index];
    std::optional<Outline>& outline = outlines[id.index];
    if (!outline) outline = outline_of(mesh, options, run);
    bytes += kEdgeBytes * static_cast<std::int64_t>(outline->edges + outline->points.size());
    if (bytes > run.limits.memory_bytes) {
      throw Error(Error::Resource,
                  fmt::format("wireframe: the edges over all nodes need more than the limit of {} bytes",
                              run.limits.memory_bytes));
    }
    result.add(*outline, mesh, placed, run);
  }
  return result.take();
}

}  // namespace azulejo
