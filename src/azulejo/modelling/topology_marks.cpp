#include "azulejo/modelling/topology_marks.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

#include "azulejo/core/parallel.h"
#include "azulejo/math/color.h"
#include "azulejo/modelling/primitive.h"
#include "azulejo/modelling/sight.h"

namespace azulejo {
namespace {

constexpr double kTube = 0.003;        // radius of an edge's mark, of the diagonal of all
constexpr double kBall = 0.007;        // and of a vertex's
constexpr double kApart = 0.04;        // how far balls of one kind are apart, about
constexpr double kSmallFace = 0.03;    // a face of less gets a ball, too
constexpr double kAround = 0.06;       // what a camera for one kind sees around a mark
constexpr float kSlope = 0.31529879F;  // tangent of half the cameras' angle, 35°
constexpr float kAspect = 4.0F / 3.0F;
constexpr double kFilled = 0.9;                               // of the picture
constexpr float kFaintAlpha = 0.4F;                           // of a surface that something is to be seen through
constexpr std::size_t kCellsLookedAt = std::size_t{1} << 20;  // of a mesh, from one direction
constexpr std::size_t kLookedAt = 500;                        // marks of each kind that choose the direction

enum class Shape { Edge, Vertex, Face };
Shape shape_of(MeshFaultKind kind) {
  switch (kind) {
    case MeshFaultKind::BorderEdge:
    case MeshFaultKind::SingularEdge:
    case MeshFaultKind::TurnedEdge:
    case MeshFaultKind::LooseEdge: return Shape::Edge;
    case MeshFaultKind::SingularVertex:
    case MeshFaultKind::UnusedVertex:
    case MeshFaultKind::DoubledVertex:
    case MeshFaultKind::NotFiniteVertex: return Shape::Vertex;
    default: return Shape::Face;
  }
}

bool drawable(const glm::dvec3& p) {
  return std::abs(p.x) < 1e30 && std::abs(p.y) < 1e30 && std::abs(p.z) < 1e30;  // no NaN
}

/// A mesh as a visible node shows it.
struct Shown {
  const Mesh* mesh = nullptr;
  std::size_t number = 0;
  glm::dmat4 world_from_mesh{1.0};
  glm::dvec3 place(std::uint32_t vertex) const {
    return glm::dvec3(world_from_mesh * glm::dvec4(mesh->positions[vertex], 1));
  }
};

struct Box {
  glm::dvec3 lower{1e300};
  glm::dvec3 upper{-1e300};
  void add(const glm::dvec3& p) {
    for (int i = 0; i < 3; ++i) {
      lower[i] = std::min(lower[i], p[i]);
      upper[i] = std::max(upper[i], p[i]);
    }
  }
  bool empty() const { return lower.x > upper.x; }
};

/// The marks of one kind, in the world.
struct Marks {
  std::vector<std::array<glm::dvec3, 2>> tubes;
  std::vector<glm::dvec3> balls;
  std::vector<glm::dvec3> places;  ///< the middle of each mark
};

/// Copies of a shape that has triangles only.
class Copies {
 public:
  explicit Copies(const PrimitiveOptions& options) : shape_(primitive(options)) {}
  void add(Mesh& mesh, const glm::dmat4& world_from_shape) const {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::vec3& p : shape_.positions) mesh.positions.emplace_back(world_from_shape * glm::dvec4(p, 1));
    for (std::size_t f = 0; f < shape_.face_count(); ++f) {
      for (std::size_t c = shape_.face_begin(f) + 2; c < shape_.face_end(f); ++c) {
        for (const std::size_t corner : {shape_.face_begin(f), c - 1, c}) {
          mesh.corners.push_back(first + shape_.corners[corner]);
        }
      }
    }
  }

 private:
  Mesh shape_;
};

/// From a tube of height 1 around y to one from a to b.
glm::dmat4 along(const glm::dvec3& a, const glm::dvec3& b, double radius) {
  const glm::dvec3 step = b - a;
  const double length = glm::length(step);
  const glm::dvec3 y = length > 0 ? step / length : glm::dvec3(0, 1, 0);
  const glm::dvec3 x = glm::normalize(glm::cross(y, std::abs(y.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
  const glm::dvec3 z = glm::cross(x, y);
  return {glm::dvec4(radius * x, 0), glm::dvec4(step, 0), glm::dvec4(radius * z, 0), glm::dvec4(0.5 * (a + b), 1)};
}

class Marker {
 public:
  Marker(const Scene& scene, std::span<const Topology> topologies, std::size_t at_most, const Run& run)
      : source_(scene), topologies_(topologies), at_most_(at_most), run_(run) {
    for (const PlacedNode& each : walk(scene)) {
      const Node& node = scene.nodes[each.node.index];
      if (!each.visible || !node.mesh) continue;
      shown_.push_back({scene.meshes[node.mesh.index].get(), node.mesh.index, glm::dmat4(each.world_from_node)});
    }
  }

  MarkedScene done() {
    measure();
    result_.scene.name = source_.name;
    result_.scene.space = source_.space;
    copy_nodes();
    for (std::size_t k = 0; k < kMeshFaultKinds; ++k) mark(static_cast<MeshFaultKind>(k));
    for (std::size_t k = 0; k < kMeshFaultKinds; ++k) add_mesh(static_cast<MeshFaultKind>(k));
    add_cameras();
    add_painted_meshes();
    return std::move(result_);
  }

 private:
  void measure() {
    for (const Shown& each : shown_) {
      const Box box = parallel_reduce(
          each.mesh->vertex_count(), 1U << 14, run_, Box(),
          [&](std::size_t begin, std::size_t end) {
            Box part;
            for (std::size_t v = begin; v < end; ++v) {
              const glm::dvec3 place = each.place(static_cast<std::uint32_t>(v));
              if (drawable(place)) part.add(place);
            }
            return part;
          },
          [](Box a, const Box& b) {
            if (b.empty()) return a;
            a.add(b.lower);
            a.add(b.upper);
            return a;
          });
      if (box.empty()) continue;
      box_.add(box.lower);
      box_.add(box.upper);
    }
    if (box_.empty()) box_.lower = box_.upper = glm::dvec3(0);
    size_ = glm::distance(box_.lower, box_.upper);
    if (size_ == 0) size_ = 1;
  }

  void copy_nodes() {
    Scene& scene = result_.scene;
    scene.nodes = source_.nodes;
    scene.roots = source_.roots;
    for (Node& each : scene.nodes) {
      each.camera = {};
      each.light = {};
      each.skin = {};
      each.morph_weights.clear();
    }
    painted_.resize(source_.meshes.size());
    add_material({0.62F, 0.66F, 0.72F, 1}, MaterialModel::MetalRough, "surface");
  }

  std::uint32_t add_material(const glm::vec4& color, MaterialModel model, std::string_view name) {
    Material material;
    material.name = std::string(name);
    material.model = model;
    material.base_color = color;
    material.double_sided = true;
    result_.scene.materials.push_back(std::move(material));
    return static_cast<std::uint32_t>(result_.scene.materials.size() - 1);
  }

  std::uint32_t material_of(MeshFaultKind kind, MaterialModel model) {
    auto& known = materials_[static_cast<std::size_t>(kind)][model == MaterialModel::Unlit ? 1 : 0];
    if (!known) {
      const std::array<float, 4> c = to_linear(parse_color(mark_color(kind)).value_or(Color()));
      known = add_material({c[0], c[1], c[2], 1}, model, enum_names(kind)[static_cast<std::size_t>(kind)]);
    }
    return *known;
  }

  void mark(MeshFaultKind kind) {
    const auto k = static_cast<std::size_t>(kind);
    for (const Shown& shown : shown_) {
      for (const MeshFault& fault : topologies_[shown.number].of(kind).listed) {
        if (result_.marks[k] == at_most_) return;
        if (mark(kind, shown, fault)) ++result_.marks[k];
      }
    }
  }

  bool mark(MeshFaultKind kind, const Shown& shown, const MeshFault& fault) {
    Marks& marks = marks_[static_cast<std::size_t>(kind)];
    if (shape_of(kind) == Shape::Face) {
      bool any = mark_face(kind, shown, fault.index);
      if (kind == MeshFaultKind::IntersectingFace) any = mark_face(kind, shown, fault.other) || any;
      return any;
    }
    const glm::dvec3 a = shown.place(fault.index);
    const glm::dvec3 b = shape_of(kind) == Shape::Edge ? shown.place(fault.other) : a;
    if (!drawable(a) || !drawable(b)) return false;
    marks.places.push_back(0.5 * (a + b));
    if (shape_of(kind) == Shape::Edge) {
      marks.tubes.push_back({a, b});
    } else {
      marks.balls.push_back(a);
    }
    return true;
  }

  /// Tints a face, of all nodes that show it; one without an area becomes a tube.
  bool mark_face(MeshFaultKind kind, const Shown& shown, std::uint32_t face) {
    std::vector<glm::dvec3> corners;
    for (std::size_t c = shown.mesh->face_begin(face); c < shown.mesh->face_end(face); ++c) {
      corners.push_back(shown.place(shown.mesh->corners[c]));
      if (!drawable(corners.back())) return false;
    }
    if (corners.empty()) return false;
    const auto farthest = [&](const glm::dvec3& from) {
      return *std::max_element(corners.begin(), corners.end(), [&](const glm::dvec3& p, const glm::dvec3& q) {
        return glm::distance(from, p) < glm::distance(from, q);
      });
    };
    const glm::dvec3 middle =
        std::accumulate(corners.begin(), corners.end(), glm::dvec3(0)) / static_cast<double>(corners.size());
    const glm::dvec3 a = farthest(middle);
    const glm::dvec3 b = farthest(a);
    Marks& marks = marks_[static_cast<std::size_t>(kind)];
    marks.places.push_back(middle);
    if (kind == MeshFaultKind::FlatFace || kind == MeshFaultKind::DegenerateFace) marks.tubes.push_back({a, b});
    if (glm::distance(a, b) < kSmallFace * size_) marks.balls.push_back(middle);
    Array<std::uint32_t>& material = painted_[shown.number];
    if (material.empty()) material.resize(shown.mesh->face_count(), 0);
    material[face] = material_of(kind, MaterialModel::MetalRough);
    return true;
  }

  /// The tubes and balls of a kind, as a node of its name.
  void add_mesh(MeshFaultKind kind) {
    const auto k = static_cast<std::size_t>(kind);
    const Marks& marks = marks_[k];
    if (marks.tubes.empty() && marks.balls.empty()) return;
    const Copies tube({.kind = PrimitiveKind::Cylinder, .radius = 1, .height = 1, .segments = 6});
    const Copies ball({.kind = PrimitiveKind::IcoSphere, .radius = 1, .subdivisions = 1});
    Mesh mesh;
    mesh.name = std::string(enum_names(kind)[k]);
    mesh.space = source_.space;
    for (const auto& [a, b] : marks.tubes) tube.add(mesh, along(a, b, kTube * size_));
    for (const glm::dvec3& at : thinned(marks.balls)) {
      glm::dmat4 world_from_ball(kBall * size_);
      world_from_ball[3] = glm::dvec4(at, 1);
      ball.add(mesh, world_from_ball);
    }
    mesh.material.resize(mesh.face_count(), material_of(kind, MaterialModel::Unlit));
    Node node;
    node.name = mesh.name;
    node.mesh = MeshId(source_.meshes.size() + mark_meshes_.size());
    mark_meshes_.push_back(std::make_shared<const Mesh>(std::move(mesh)));
    add_node(std::move(node));
  }

  /// One place of those that lie so near that their balls would hide all else.
  std::vector<glm::dvec3> thinned(const std::vector<glm::dvec3>& places) const {
    std::set<std::array<std::int64_t, 3>> taken;
    std::vector<glm::dvec3> kept;
    for (const glm::dvec3& each : places) {
      std::array<std::int64_t, 3> cell{};
      for (int i = 0; i < 3; ++i) {
        cell[static_cast<std::size_t>(i)] = std::llround((each[i] - box_.lower[i]) / (kApart * size_));
      }
      if (taken.insert(cell).second) kept.push_back(each);
    }
    return kept;
  }

  void add_node(Node node) {
    result_.scene.roots.emplace_back(result_.scene.nodes.size());
    result_.scene.nodes.push_back(std::move(node));
  }

  /// Of triangles that are large and many, those that are enough to hide what is behind them.
  Sight sight_from(const SightAxes& axes) const {
    Sight sight(0.5 * (box_.lower + box_.upper), 0.5 * size_, axes);
    std::vector<glm::vec3> cells;
    for (const Shown& each : shown_) {
      cells.resize(each.mesh->vertex_count());
      for (std::uint32_t v = 0; v < cells.size(); ++v) cells[v] = sight.cell(each.place(v));
      std::size_t looked_at = 0;
      each_triangle(*each.mesh, cells, 1,
                    [&](const auto& a, const auto& b, const auto& c) { looked_at += Sight::extent(a, b, c); });
      each_triangle(*each.mesh, cells, looked_at / kCellsLookedAt + 1,
                    [&](const auto& a, const auto& b, const auto& c) { sight.cover(a, b, c); });
    }
    return sight;
  }

  /// Every so-many-th triangle of the faces' fans.
  template <class F>
  static void each_triangle(const Mesh& mesh, const std::vector<glm::vec3>& cells, std::size_t step, F f) {
    std::size_t left_out = step - 1;
    for (std::size_t face = 0; face < mesh.face_count(); ++face) {
      const std::uint32_t* const corners = mesh.corners.data() + mesh.face_begin(face);
      const std::size_t count = mesh.face_end(face) - mesh.face_begin(face);
      for (std::size_t c = 2; c < count; ++c) {
        if (++left_out < step) continue;
        left_out = 0;
        f(cells[corners[0]], cells[corners[c - 1]], cells[corners[c]]);
      }
    }
  }

  /// Of each direction and kind, the share of marks that are seen.
  using Shares = std::array<double, kMeshFaultKinds>;
  std::vector<Shares> look(const std::vector<SightAxes>& axes) const {
    std::vector<Shares> shares(axes.size());
    // The first alone, then each with the one behind it.
    parallel_tasks(axes.size() / 2 + 1, run_, [&](std::size_t pair, int) {
      const std::size_t front = pair == 0 ? 0 : 2 * pair - 1;
      const Sight sight = sight_from(axes[front]);
      for (std::size_t k = 0; k < kMeshFaultKinds; ++k) {
        const std::vector<glm::dvec3>& places = marks_[k].places;
        const std::size_t step = places.size() / kLookedAt + 1;
        std::array<std::size_t, 3> seen{};  // from here, from behind, and of how many
        for (std::size_t i = 0; i < places.size(); i += step) {
          const glm::vec3 cell = sight.cell(places[i]);
          seen[0] += sight.sees(cell, false) ? 1 : 0;
          seen[1] += sight.sees(cell, true) ? 1 : 0;
          ++seen[2];
        }
        if (seen[2] == 0) continue;
        shares[front][k] = static_cast<double>(seen[0]) / static_cast<double>(seen[2]);
        if (pair > 0) shares[front + 1][k] = static_cast<double>(seen[1]) / static_cast<double>(seen[2]);
      }
    });
    return shares;
  }

  void add_cameras() {
    const bool z_up = source_.space.up == UpAxis::Z;
    const glm::dvec3 up = z_up ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    const glm::dvec3 front = z_up ? glm::dvec3(0, -1, 0) : glm::dvec3(0, 0, 1);
    std::vector<SightAxes> axes;
    for (const glm::dvec3& each : sight_directions(front, up)) axes.push_back(sight_axes(each, up));
    const bool any = std::any_of(marks_.begin(), marks_.end(), [](const Marks& each) { return !each.places.empty(); });
    const std::vector<Shares> shares = any ? look(axes) : std::vector<Shares>(1);
    const auto best = [&](const auto& score) {
      const auto less = [&](const Shares& a, const Shares& b) { return score(a) < score(b); };
      return static_cast<std::size_t>(std::max_element(shares.begin(), shares.end(), less) - shares.begin());
    };
    const std::size_t of_all = best([](const Shares& each) {
      double sum = 0;
      for (const double share : each) sum += share;
      return std::floor(sum * 1e6);  // sums in another order are no reason
    });
    for (std::size_t k = 0; k < kMeshFaultKinds; ++k) {
      const double hidden = 1 - shares[of_all][k];
      if (!marks_[k].places.empty()) {
        result_.hidden[k] = static_cast<std::size_t>(std::ceil(hidden * static_cast<double>(result_.marks[k])));
      }
    }
    add_camera("faults", axes[of_all], 0, [&](const auto& frame) {
      for (const Shown& each : shown_) {
        for (std::uint32_t v = 0; v < each.mesh->vertex_count(); ++v) frame(each.place(v));
      }
    });
    for (std::size_t k = 0; k < kMeshFaultKinds; ++k) {
      if (marks_[k].places.empty()) continue;
      add_camera(enum_names(MeshFaultKind{})[k], axes[best([k](const Shares& each) { return each[k]; })],
                 kAround * size_, [&](const auto& frame) {
                   for (const glm::dvec3& each : marks_[k].places) frame(each);
                 });
    }
  }

  /// A camera that sees all places, with as much around them.
  template <class Places>
  void add_camera(std::string_view name, const SightAxes& axes, double around, Places places) {
    const glm::dvec3 center = 0.5 * (box_.lower + box_.upper);
    const auto turned = [&](const glm::dvec3& p) {
      const glm::dvec3 from = p - center;
      return glm::dvec3(glm::dot(from, axes.right), glm::dot(from, axes.up), glm::dot(from, axes.to_eye));
    };
    // For |x - eye.x| ≤ slope (eye.z - z), as near as that allows: ± x + slope z is at most ± eye.x + slope eye.z.
    const glm::dvec2 slope(kSlope * kFilled * static_cast<double>(kAspect), kSlope * kFilled);
    glm::dvec2 right(-1e300);
    glm::dvec2 left(-1e300);
    double nearest = -1e300;
    places([&](const glm::dvec3& p) {
      if (!drawable(p)) return;
      const glm::dvec3 at = turned(p);
      for (int i = 0; i < 2; ++i) {
        right[i] = std::max(right[i], at[i] + slope[i] * at.z + around);
        left[i] = std::max(left[i], -at[i] + slope[i] * at.z + around);
      }
      nearest = std::max(nearest, at.z);
    });
    if (nearest == -1e300) nearest = right.x = right.y = left.x = left.y = 0;
    const glm::dvec2 middle = 0.5 * (right - left);
    const double distance =
        std::max({0.5 * (right.x + left.x) / slope.x, 0.5 * (right.y + left.y) / slope.y, nearest + 0.05 * size_});
    const glm::dvec3 eye = center + middle.x * axes.right + middle.y * axes.up + distance * axes.to_eye;
    Camera camera;
    camera.name = std::string(name);
    camera.fov_y = 2 * std::atan(kSlope);
    camera.aspect = kAspect;
    Node node;
    node.name = camera.name;
    node.placement =
        glm::mat4(glm::vec4(axes.right, 0), glm::vec4(axes.up, 0), glm::vec4(axes.to_eye, 0), glm::vec4(eye, 1));
    node.camera = CameraId(result_.scene.cameras.size());
    result_.scene.cameras.push_back(std::move(camera));
    add_node(std::move(node));
  }

  void add_painted_meshes() {
    Scene& scene = result_.scene;
    for (std::size_t m = 0; m < source_.meshes.size(); ++m) {
      const Mesh& from = *source_.meshes[m];
      Mesh mesh;
      mesh.name = from.name;
      mesh.space = from.space;
      mesh.positions = from.positions;
      mesh.corners = from.corners;
      mesh.face_offsets = from.face_offsets;
      mesh.material = std::move(painted_[m]);
      if (mesh.material.empty()) mesh.material.resize(mesh.face_count(), 0);
      scene.meshes.push_back(std::make_shared<const Mesh>(std::move(mesh)));
    }
    for (auto& each : mark_meshes_) scene.meshes.push_back(std::move(each));
    const bool all_seen =
        std::all_of(result_.hidden.begin(), result_.hidden.end(), [](auto count) { return count == 0; });
    if (!all_seen) {
      scene.materials[0].base_color.a = kFaintAlpha;
      scene.materials[0].alpha_mode = AlphaMode::Blend;
    }
  }

  const Scene& source_;
  std::span<const Topology> topologies_;
  std::size_t at_most_;
  const Run& run_;
  std::vector<Shown> shown_;
  Box box_;
  double size_ = 1;
  std::array<Marks, kMeshFaultKinds> marks_;
  std::array<std::array<std::optional<std::uint32_t>, 2>, kMeshFaultKinds> materials_;
  std::vector<Array<std::uint32_t>> painted_;  ///< of each mesh, the faces' materials; empty: all are the first
  std::vector<std::shared_ptr<const Mesh>> mark_meshes_;
  MarkedScene result_;
};

}  // namespace

std::string_view mark_color(MeshFaultKind kind) {
  constexpr std::array<std::string_view, kMeshFaultKinds> kColors = {"#0b5fff", "#e00020", "#b000d0", "#ff00a0",
                                                                     "#505050", "#00a0a0", "#303030", "#000000",
                                                                     "#8b4a00", "#f0a000", "#008a20", "#ff5a00"};
  return kColors[static_cast<std::size_t>(kind)];
}

MarkedScene mark_faults(const Scene& scene, std::span<const Topology> topologies, std::size_t at_most, const Run& run) {
  return Marker(scene, topologies, at_most, run).done();
}

}  // namespace azulejo
