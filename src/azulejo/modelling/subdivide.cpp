#include "azulejo/modelling/subdivide.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/engine/operation.h"
#include "azulejo/engine/stages.h"
#include "azulejo/modelling/normals.h"
#include "azulejo/modelling/picked_attribute.h"
#include "azulejo/modelling/subdivided_values.h"
#include "azulejo/modelling/subdivision_level.h"
#include "azulejo/modelling/subdivision_rules.h"
#include "azulejo/modelling/subdivision_source.h"
#include "azulejo/modelling/subdivision_values.h"

namespace azulejo {
namespace subdivision {
namespace {

constexpr int kMostLevels = 16;

/// Refuses what would not fit, by what the mesh can become at most.
void check_size(const Mesh& mesh, const SubdivideOptions& options, const Run& run) {
  constexpr double kMostCorners = 4294967294.0;
  constexpr double kBytesPerCorner = 40;  // of a level with its edges
  const bool triangles = options.scheme == SubdivisionScheme::Loop || options.scheme == SubdivisionScheme::Sqrt3;
  const double factor = options.scheme == SubdivisionScheme::Sqrt3 ? 3 : 4;
  // Where midpoint cuts a face into triangles first, these have more corners: three for each but two of the face's.
  const bool cuts = options.scheme == SubdivisionScheme::Midpoint && !mesh.all_triangles();
  const double source =
      triangles || cuts ? 3.0 * static_cast<double>(mesh.triangle_count()) : static_cast<double>(mesh.corner_count());
  const double before = source * std::pow(factor, options.levels - 1);
  const double corners = before * factor;
  double per_vertex = 12;
  double per_corner = 5;  // with the offsets of quads
  double per_face = mesh.material.empty() ? 0 : 8;
  for (const Attribute& each : mesh.attributes) {
    double& of_domain = each.domain == Domain::Vertex   ? per_vertex
                        : each.domain == Domain::Corner ? per_corner
                                                        : per_face;
    of_domain += 4.0 * each.components;
  }
  per_vertex += 12.0 * static_cast<double>(mesh.morph_targets.size());
  const double vertices = static_cast<double>(mesh.vertex_count()) + corners / 4;  // an edge has two corners as a rule
  const double bytes = vertices * per_vertex + corners * (per_corner + per_face / 3) +
                       kBytesPerCorner * (options.limit ? before + corners : before);
  if (corners > kMostCorners || bytes > static_cast<double>(run.limits.memory_bytes)) {
    throw Error(
        Error::Resource,
        fmt::format("subdivide: levels is {}: {:.0f} corners of faces need about {:.0f} bytes, expected at most "
                    "{:.0f} corners and {} bytes",
                    options.levels, corners, bytes, kMostCorners, run.limits.memory_bytes));
  }
}

float* floats(Array<glm::vec3>& positions) { return positions.empty() ? nullptr : &positions[0].x; }

/// A mesh on its way through the levels.
class Subdivision {
 public:
  Subdivision(Mesh source, const SubdivideOptions& options, const Run& run)
      : mesh_(std::move(source)), options_(options), run_(run) {
    const bool midpoint = options.scheme == SubdivisionScheme::Midpoint;
    quads_ = options.scheme == SubdivisionScheme::CatmullClark || (midpoint && !mesh_.all_triangles());
    Sharpness sharpness;
    if (options.crease_angle_deg && !midpoint) {
      sharpness.least_cosine = std::cos(*options.crease_angle_deg * std::numbers::pi_v<float> / 180);
    }
    sharpness.lines = options.crease_lines;
    sharpness.lone_corners = options.keep_corners;
    sharpness.turned = options.scheme == SubdivisionScheme::Sqrt3;
    level_ = first_level(mesh_, sharpness, line_edges_, run);
    take_values();
  }

  Mesh run() {
    for (int i = 1; i <= options_.levels; ++i) {
      check_cancelled(run_);
      const bool whole = i < options_.levels || options_.limit;
      if (options_.scheme == SubdivisionScheme::Sqrt3) {
        refine_by_sqrt3(i % 2 == 0, whole);
      } else {
        refine(whole);
      }
      if (run_.stages != nullptr) run_.stages->mesh("subdivide", fmt::format("level_{}", i), shape());
    }
    if (options_.limit) move_to_limit();
    return finished();
  }

 private:
  using Rules = std::function<void(const Level& level, int components, const float* in, float* out)>;

  void take_values() {
    for (const Attribute& each : mesh_.attributes) {
      const bool numbers = each.get<std::uint32_t>() != nullptr;
      if (each.domain == Domain::Face) continue;
      const bool of_vertices = each.domain == Domain::Vertex;
      if (numbers) {
        (of_vertices ? inherited_of_vertices_ : inherited_of_corners_).emplace_back(each);
      } else {
        (of_vertices ? of_vertices_ : of_corners_).emplace_back(each);
      }
    }
    for (const MorphTarget& each : mesh_.morph_targets) {
      if (!each.positions.empty()) morphs_.emplace_back(each);
    }
    const auto of_faces = [](const Attribute& each) { return each.domain == Domain::Face; };
    has_faces_ = !mesh_.material.empty() || std::any_of(mesh_.attributes.begin(), mesh_.attributes.end(), of_faces);
    if (!has_faces_) return;
    parents_.resize(level_.face_count());
    for (std::size_t f = 0; f < parents_.size(); ++f) parents_[f] = static_cast<std::uint32_t>(f);
  }

  /// All values of vertices at the next level, by the rules.
  void weigh(std::size_t vertices, const Rules& rules) {
    Array<glm::vec3> positions(vertices);
    rules(level_, 3, floats(mesh_.positions), floats(positions));
    mesh_.positions = std::move(positions);
    for (std::vector<Weighed>* list : {&of_vertices_, &morphs_}) {
      for (Weighed& each : *list) {
        Array<float> values(vertices * static_cast<std::size_t>(each.components));
        rules(level_, each.components, each.values.data(), values.data());
        each.values = std::move(values);
      }
    }
  }

  void refine(bool whole) {
    Level next = quads_ ? split_into_quads(level_, whole, run_) : split_triangles(level_, whole, run_);
    weigh(next.vertex_count, [&](const Level& level, int components, const float* in, float* out) {
      switch (options_.scheme) {
        case SubdivisionScheme::Loop: return refine_loop(level, components, in, out, run_);
        case SubdivisionScheme::CatmullClark: return refine_catmull_clark(level, components, in, out, run_);
        default: return refine_linear(level, quads_, components, in, out, run_);
      }
    });
    for (Weighed& each : of_corners_) split_corners(level_, quads_, each, run_);
    for (Inherited& each : inherited_of_corners_) split_corners(level_, quads_, each, run_);
    for (Inherited& each : inherited_of_vertices_) split_vertices(level_, quads_, each, run_);
    if (has_faces_) {
      Array<std::uint32_t> parents(next.face_count());
      with_faces(level_, [&](auto faces) {
        for_each(parents.size(), run_,
                 [&](std::size_t face) { parents[face] = parents_[quads_ ? faces.face_of(face) : face / 4]; });
      });
      parents_ = std::move(parents);
    }
    split_lines();
    level_ = std::move(next);
  }

  /// Lines along edges, in the middle.
  void split_lines() {
    Array<std::uint32_t> lines;
    Array<std::uint32_t> edges;
    for (std::size_t i = 0; i < line_edges_.size(); ++i) {
      const std::uint32_t a = mesh_.lines[2 * i];
      const std::uint32_t b = mesh_.lines[2 * i + 1];
      const std::uint32_t edge = line_edges_[i];
      if (edge == kNone) {
        lines.insert(lines.end(), {a, b});
        edges.push_back(kNone);
        continue;
      }
      const auto middle = static_cast<std::uint32_t>(level_.vertex_count + edge);
      const std::uint32_t half = level_.edges[edge][0] == a ? 0 : 1;
      lines.insert(lines.end(), {a, middle, middle, b});
      edges.insert(edges.end(), {2 * edge + half, 2 * edge + 1 - half});
    }
    mesh_.lines = std::move(lines);
    line_edges_ = std::move(edges);
  }

  void refine_by_sqrt3(bool even, bool whole) {
    Sqrt3Step step = split_sqrt3(level_, even, whole, run_);
    weigh(step.next.vertex_count, [&](const Level& level, int components, const float* in, float* out) {
      refine_sqrt3(level, step, components, in, out, run_);
    });
    for (Inherited& each : inherited_of_vertices_) inherit_by_sqrt3(step, each);
    if (has_faces_) {
      Array<std::uint32_t> parents(step.next.face_count());
      for (std::size_t f = 0; f < parents.size(); ++f) parents[f] = parents_[f / 3];
      parents_ = std::move(parents);
    }
    if (even) cut_lines(step);
    if (whole) line_edges_ = edges_along(step.next, mesh_.lines, run_);
    level_ = std::move(step.next);
  }

  void inherit_by_sqrt3(const Sqrt3Step& step, Inherited& each) const {
    const auto count = static_cast<std::size_t>(each.components);
    each.values.resize(count * step.next.vertex_count);
    const auto copy = [&](std::size_t place, std::size_t vertex) {
      std::copy_n(each.values.data() + count * vertex, count, each.values.data() + count * place);
    };
    for (std::size_t f = 0; f < step.centers.size(); ++f) {
      if (step.centers[f] != kNone) copy(step.centers[f], level_.corners[3 * f]);
    }
    for (std::size_t e = 0; e < step.thirds.size(); ++e) {
      if (step.thirds[e] == kNone) continue;
      for (std::size_t end = 0; end < 2; ++end) copy(step.thirds[e] + end, level_.edges[e][end]);
    }
  }

  /// Lines along sharp edges, in three.
  void cut_lines(const Sqrt3Step& step) {
    Array<std::uint32_t> lines;
    for (std::size_t i = 0; i < line_edges_.size(); ++i) {
      const std::uint32_t a = mesh_.lines[2 * i];
      const std::uint32_t b = mesh_.lines[2 * i + 1];
      const std::uint32_t edge = line_edges_[i];
      if (edge == kNone || step.thirds[edge] == kNone) {
        lines.insert(lines.end(), {a, b});
        continue;
      }
      const std::uint32_t near_a = step.thirds[edge] + (level_.edges[edge][0] == a ? 0 : 1);
      const std::uint32_t near_b = step.thirds[edge] + (level_.edges[edge][0] == a ? 1 : 0);
      lines.insert(lines.end(), {a, near_a, near_a, near_b, near_b, b});
    }
    mesh_.lines = std::move(lines);
  }

  void move_to_limit() {
    if (options_.scheme == SubdivisionScheme::Midpoint) return;
    weigh(level_.vertex_count, [&](const Level& level, int components, const float* in, float* out) {
      switch (options_.scheme) {
        case SubdivisionScheme::Loop: return loop_limit(level, components, in, out, run_);
        case SubdivisionScheme::CatmullClark: return catmull_clark_limit(level, components, in, out, run_);
        default: return sqrt3_limit(level, components, in, out, run_);
      }
    });
  }

  /// Of the level's faces, which are of one kind.
  Array<std::uint32_t> face_offsets() const {
    Array<std::uint32_t> offsets;
    if (!quads_) return offsets;
    offsets.resize(level_.face_count() + 1);
    for_each(offsets.size(), run_, [&](std::size_t face) { offsets[face] = static_cast<std::uint32_t>(4 * face); });
    return offsets;
  }

  /// Of the level, without attributes.
  Mesh shape() const {
    Mesh shape;
    shape.positions = mesh_.positions;
    shape.corners = level_.corners;
    shape.face_offsets = face_offsets();
    shape.lines = mesh_.lines;
    shape.space = mesh_.space;
    return shape;
  }

  Mesh finished() {
    mesh_.face_offsets = face_offsets();
    mesh_.corners = std::move(level_.corners);
    finish_attributes();
    if (!mesh_.material.empty()) {
      for (std::uint32_t& parent : parents_) parent = mesh_.material[parent];
      mesh_.material = std::move(parents_);
    }
    auto morph = morphs_.begin();
    for (MorphTarget& each : mesh_.morph_targets) {
      if (!each.positions.empty()) std::move(*morph++).into(each);
    }
    return std::move(mesh_);
  }

  void finish_attributes() {
    std::size_t next[2][2] = {};
    for (Attribute& each : mesh_.attributes) {
      if (each.domain == Domain::Face) {
        each = picked(each, parents_);
        continue;
      }
      const bool of_vertices = each.domain == Domain::Vertex;
      if (each.get<std::uint32_t>() != nullptr) {
        auto& list = of_vertices ? inherited_of_vertices_ : inherited_of_corners_;
        each = std::move(list[next[0][of_vertices ? 0 : 1]++]).attribute(each.domain);
      } else {
        auto& list = of_vertices ? of_vertices_ : of_corners_;
        each = std::move(list[next[1][of_vertices ? 0 : 1]++]).attribute(each.domain);
      }
      if (each.name == "NORMAL") normalize(each);
    }
  }

  static void normalize(Attribute& normals) {
    auto* const values = std::get_if<Array<float>>(&normals.values);
    if (values == nullptr || normals.components != 3) return;
    for (std::size_t i = 0; i + 2 < values->size(); i += 3) {
      float* const n = values->data() + i;
      const float length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
      if (length > 0) std::for_each(n, n + 3, [&](float& each) { each /= length; });
    }
  }

  Mesh mesh_;  ///< positions and lines are those of the level, the rest the source's until the end
  const SubdivideOptions& options_;
  const Run& run_;
  bool quads_ = false;
  Level level_;
  Array<std::uint32_t> line_edges_;  ///< of each line: along which edge of the level; kNone
  std::vector<Weighed> of_vertices_, of_corners_, morphs_;
  std::vector<Inherited> inherited_of_vertices_, inherited_of_corners_;
  bool has_faces_ = false;        ///< faces have materials or attributes
  Array<std::uint32_t> parents_;  ///< then, of each face of the level, the source's
};

}  // namespace
}  // namespace subdivision

extern const Operation kSubdivide = with_examples(
    value_operation<SubdivideOptions>(
        "subdivide", "Replaces each face by smaller ones: a smooth surface of a coarse one, or the same in more parts.",
        {{"source", "the mesh", ValueKind::Mesh}}, {{"mesh", "the finer mesh", ValueKind::Mesh}},
        {field("scheme", &SubdivideOptions::scheme, "how faces are divided, and where vertices go"),
         field("levels", &SubdivideOptions::levels, {1, subdivision::kMostLevels}, "", "how often"),
         field("limit", &SubdivideOptions::limit, "vertices move to where endless subdivision would take them"),
         field("crease_angle_deg", &SubdivideOptions::crease_angle_deg, {0, 180}, "deg",
               "edges whose faces turn by more than this stay sharp; auto: only borders do"),
         field("crease_lines", &SubdivideOptions::crease_lines, "edges that the mesh's lines run along stay sharp"),
         field("keep_corners", &SubdivideOptions::keep_corners,
               "border vertices of a single face stay where they are")},
        [](std::span<const Value> inputs, const SubdivideOptions& options, const Run& run) {
          return std::vector<Value>{Value(subdivide(*inputs[0].mesh(), options, run))};
        }),
    {{"primitive:kind=cube subdivide:scheme=catmull_clark,levels=3", "Quads of a cube, almost a sphere."},
     {"primitive:kind=icosahedron subdivide:levels=2,limit=true wireframe:width=480,height=360",
      "Triangles of an icosahedron, their vertices on the surface that endless subdivision ends at."},
     {"primitive:kind=cylinder,segments=12 subdivide:scheme=catmull_clark,levels=3,crease_angle_deg=60",
      "The rims of the cylinder stay sharp."}});

Mesh subdivide(const Mesh& mesh, const SubdivideOptions& options, const Run& run) {
  kSubdivide.check(&options);
  subdivision::check_size(mesh, options, run);
  Mesh result = subdivision::Subdivision(subdivision::source_of(mesh, options.scheme, run), options, run).run();
  if (options.scheme != SubdivisionScheme::Midpoint && mesh.find("NORMAL") != nullptr) {
    NormalsOptions normals;
    if (options.crease_angle_deg) normals.crease_angle = *options.crease_angle_deg * std::numbers::pi_v<float> / 180;
    result.attributes.push_back(vertex_normals(result, normals, run));
  }
  return result;
}

}  // namespace azulejo
