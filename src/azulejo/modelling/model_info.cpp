#include "azulejo/modelling/model_info.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "azulejo/core/parallel.h"

namespace azulejo {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 14;
constexpr std::size_t kExactVertices = std::size_t{1} << 27;  ///< of all instances; above, boxes stand for them

bool finite(const glm::vec3& point) {
  return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

const char* type_name(const Attribute& attribute) {
  if (attribute.get<float>() != nullptr) return "f32";
  return attribute.get<std::uint8_t>() != nullptr ? "u8" : "u32";
}

/// Whether a face has no area, by Newell's sum; the products of differences of floats are exact in most doubles.
bool is_flat(const Mesh& mesh, std::size_t face) {
  const std::size_t begin = mesh.face_begin(face);
  const std::size_t end = mesh.face_end(face);
  if (end - begin < 3) return true;
  const glm::dvec3 first = mesh.positions[mesh.corners[begin]];
  glm::dvec3 area(0);
  for (std::size_t i = begin + 1; i + 1 < end; ++i) {
    const glm::dvec3 a = glm::dvec3(mesh.positions[mesh.corners[i]]) - first;
    const glm::dvec3 b = glm::dvec3(mesh.positions[mesh.corners[i + 1]]) - first;
    area += glm::cross(a, b);
  }
  return area == glm::dvec3(0);
}

template <class Counted>
std::size_t count_if(std::size_t size, const Run& run, const Counted& counted) {
  return parallel_reduce(
      size, kChunk, run, std::size_t{0},
      [&](std::size_t begin, std::size_t end) {
        std::size_t count = 0;
        for (std::size_t i = begin; i < end; ++i) count += counted(i) ? 1 : 0;
        return count;
      },
      [](std::size_t a, std::size_t b) { return a + b; });
}

MeshInfo mesh_info(const Mesh& mesh, const Run& run) {
  MeshInfo info;
  info.name = mesh.name;
  info.vertices = mesh.vertex_count();
  info.faces = mesh.face_count();
  info.triangles = mesh.triangle_count();
  info.corners = mesh.corner_count();
  info.lines = mesh.lines.size() / 2;
  info.morph_targets = mesh.morph_targets.size();
  for (std::size_t face = 0; !mesh.all_triangles() && face < info.faces; ++face) {
    ++info.polygons[mesh.face_end(face) - mesh.face_begin(face)];
  }
  if (info.polygons.size() == 1 && info.polygons.contains(3)) info.polygons.clear();
  for (const Attribute& each : mesh.attributes) {
    info.attributes.push_back({each.name, each.domain, each.components, type_name(each)});
  }
  info.flat_faces = count_if(info.faces, run, [&](std::size_t face) { return is_flat(mesh, face); });
  info.not_finite_vertices = count_if(info.vertices, run, [&](std::size_t v) { return !finite(mesh.positions[v]); });
  info.edges = count_edges(mesh, run);
  info.bounds = bounds(mesh);
  return info;
}

void add(MeshInfo& sum, const MeshInfo& mesh) {
  sum.vertices += mesh.vertices;
  sum.faces += mesh.faces;
  sum.triangles += mesh.triangles;
  sum.corners += mesh.corners;
  sum.lines += mesh.lines;
  sum.morph_targets += mesh.morph_targets;
  sum.flat_faces += mesh.flat_faces;
  sum.not_finite_vertices += mesh.not_finite_vertices;
  sum.edges = {sum.edges.edges + mesh.edges.edges, sum.edges.border + mesh.edges.border,
               sum.edges.turned + mesh.edges.turned, sum.edges.crowded + mesh.edges.crowded};
  sum.bounds = united(sum.bounds, mesh.bounds);
  for (const auto& [size, count] : mesh.polygons) sum.polygons[size] += count;
  if (mesh.polygons.empty() && mesh.faces > 0) sum.polygons[3] += mesh.faces;
  for (const AttributeInfo& each : mesh.attributes) {
    const auto same = std::find_if(sum.attributes.begin(), sum.attributes.end(), [&](const AttributeInfo& other) {
      return other.name == each.name && other.domain == each.domain && other.components == each.components &&
             other.type == each.type;
    });
    if (same == sum.attributes.end()) {
      sum.attributes.push_back(each);
    } else {
      ++same->meshes;
    }
  }
}

/// Levels of nodes below the roots.
std::size_t depth_of(const Scene& scene) {
  std::size_t deepest = 0;
  std::vector<std::pair<NodeId, std::size_t>> waiting;
  for (const NodeId root : scene.roots) waiting.emplace_back(root, 1);
  while (!waiting.empty()) {
    const auto [node, depth] = waiting.back();
    waiting.pop_back();
    deepest = std::max(deepest, depth);
    for (const NodeId child : scene.nodes[node.index].children) waiting.emplace_back(child, depth + 1);
  }
  return deepest;
}

Box3 box_of_corners(const Box3& box, const glm::mat4& world_from_node) {
  Box3 result;
  for (int corner = 0; corner < 8 && !box.empty(); ++corner) {
    const glm::vec3 point((corner & 1) != 0 ? box.upper.x : box.lower.x, (corner & 2) != 0 ? box.upper.y : box.lower.y,
                          (corner & 4) != 0 ? box.upper.z : box.lower.z);
    const glm::vec3 world(world_from_node * glm::vec4(point, 1.0F));
    if (finite(world)) result = united(result, world);
  }
  return result;
}

void count_instances(const Scene& scene, ModelInfo& info) {
  SceneInfo& counted = *info.scene;
  for (MeshInfo& each : counted.each_mesh) each.uses = 0;
  std::size_t vertices = 0;
  Box3 boxes;
  for (const PlacedNode& placed : walk(scene)) {
    if (!placed.visible) continue;
    ++counted.shown_nodes;
    const MeshId mesh = scene.nodes[placed.node.index].mesh;
    if (!mesh) continue;
    MeshInfo& shown = counted.each_mesh[mesh.index];
    ++shown.uses;
    ++counted.instances;
    counted.shown_triangles += shown.triangles;
    vertices += shown.vertices;
    boxes = united(boxes, box_of_corners(shown.bounds, placed.world_from_node));
  }
  info.bounds_exact = vertices <= kExactVertices;
  info.bounds = info.bounds_exact ? bounds(scene) : boxes;
}

void describe_parts(const Scene& scene, SceneInfo& info) {
  info.materials = scene.materials;
  info.cameras = scene.cameras;
  info.lights = scene.lights;
  for (const Texture& each : scene.textures) {
    TextureInfo texture{each.name, each.source};
    if (each.image != nullptr) {
      texture.width = each.image->width();
      texture.height = each.image->height();
      texture.channels = each.image->channels();
    }
    info.textures.push_back(std::move(texture));
  }
  for (const Animation& each : scene.animations) {
    AnimationInfo animation{each.name, 0, each.channels.size()};
    for (const AnimationChannel& channel : each.channels) {
      if (!channel.times.empty())
        animation.seconds = std::max(animation.seconds, static_cast<double>(channel.times.back()));
    }
    info.animations.push_back(std::move(animation));
  }
  for (const Skin& each : scene.skins) info.skins.emplace_back(each.name, each.joints.size());
}

ModelInfo begun(const char* kind, const std::string& name, float metres_per_unit) {
  ModelInfo info;
  info.kind = kind;
  info.name = name;
  info.metres_per_unit = metres_per_unit;
  return info;
}

ModelInfo info_of(const Mesh& mesh, const Run& run) {
  ModelInfo info = begun("mesh", mesh.name, mesh.space.metres_per_unit);
  info.up = mesh.space.up;
  info.mesh = mesh_info(mesh, run);
  info.bounds = info.mesh->bounds;
  return info;
}

ModelInfo info_of(const Scene& scene, const Run& run) {
  ModelInfo info = begun("scene", scene.name, scene.space.metres_per_unit);
  info.up = scene.space.up;
  SceneInfo parts;
  parts.nodes = scene.nodes.size();
  parts.roots = scene.roots.size();
  parts.depth = depth_of(scene);
  parts.meshes = scene.meshes.size();
  info.mesh.emplace();
  for (const auto& mesh : scene.meshes) {
    parts.each_mesh.push_back(mesh_info(*mesh, run));
    parts.closed_meshes += parts.each_mesh.back().edges.closed() ? 1 : 0;
    add(*info.mesh, parts.each_mesh.back());
  }
  if (info.mesh->polygons.size() == 1 && info.mesh->polygons.contains(3)) info.mesh->polygons.clear();
  describe_parts(scene, parts);
  info.scene = std::move(parts);
  count_instances(scene, info);
  return info;
}

/// What is summed over samples.
struct Samples {
  float lowest = std::numeric_limits<float>::infinity();
  float highest = -std::numeric_limits<float>::infinity();
  double sum = 0;
  std::size_t finite = 0;
};

ModelInfo info_of(const Volume& volume, const Run& run) {
  ModelInfo info = begun("volume", volume.name, volume.metres_per_unit);
  const Samples samples = parallel_reduce(
      volume.samples.size(), kChunk, run, Samples(),
      [&](std::size_t begin, std::size_t end) {
        Samples part;
        for (std::size_t i = begin; i < end; ++i) {
          const float value = volume.samples[i];
          if (!std::isfinite(value)) continue;
          part.lowest = std::min(part.lowest, value);
          part.highest = std::max(part.highest, value);
          part.sum += static_cast<double>(value);
          ++part.finite;
        }
        return part;
      },
      [](const Samples& a, const Samples& b) {
        return Samples{std::min(a.lowest, b.lowest), std::max(a.highest, b.highest), a.sum + b.sum,
                       a.finite + b.finite};
      });
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  const bool any = samples.finite > 0;
  info.volume = VolumeInfo{volume.width,
                           volume.height,
                           volume.depth,
                           volume.spacing,
                           volume.origin,
                           any ? samples.lowest : kNone,
                           any ? samples.highest : kNone,
                           samples.sum / static_cast<double>(samples.finite),
                           volume.samples.size() - samples.finite};
  const glm::vec3 steps(glm::max(glm::ivec3(volume.width, volume.height, volume.depth) - 1, glm::ivec3(0)));
  const glm::vec3 last = volume.origin + steps * volume.spacing;
  info.bounds = {glm::min(volume.origin, last), glm::max(volume.origin, last)};
  return info;
}

/// Levels of groups below the whole.
std::size_t depth_of(const Drawing& drawing) {
  std::size_t deepest = 0;
  std::vector<std::pair<std::uint32_t, std::size_t>> waiting{{0, 1}};
  while (!waiting.empty()) {
    const auto [group, depth] = waiting.back();
    waiting.pop_back();
    deepest = std::max(deepest, depth);
    for (const DrawingItem& item : drawing.groups[group].items) {
      if (item.is_group) waiting.emplace_back(item.index, depth + 1);
    }
  }
  return deepest;
}

ModelInfo info_of(const Drawing& drawing, const Run&) {
  ModelInfo info = begun("drawing", "", drawing.unit == DrawingUnit::Millimetre ? 1e-3F : 0.0F);
  DrawingInfo parts;
  parts.width = drawing.width;
  parts.height = drawing.height;
  parts.unit = drawing.unit;
  parts.paths = drawing.paths.size();
  parts.shown_paths = walk(drawing).size();
  for (const PathCommand command : drawing.commands) {
    parts.segments += command != PathCommand::Move ? 1 : 0;
    parts.curves += points_of(command) > 1 ? 1 : 0;
  }
  parts.points = drawing.points.size();
  parts.not_finite_points = static_cast<std::size_t>(std::ranges::count_if(
      drawing.points, [](const glm::vec2& point) { return !std::isfinite(point.x) || !std::isfinite(point.y); }));
  parts.groups = drawing.groups.size();
  parts.depth = depth_of(drawing);
  parts.styles = drawing.styles.size();
  for (const PaintPattern& pattern : drawing.patterns) {
    ++(std::holds_alternative<Gradient>(pattern) ? parts.gradients : parts.other_patterns);
  }
  std::set<std::uint32_t> clips;
  for (const DrawingGroup& group : drawing.groups) {
    if (group.clip) clips.insert(*group.clip);
  }
  parts.clips = clips.size();
  parts.texts = drawing.texts.size();
  info.drawing = parts;
  const Box2 box = bounds(drawing);
  info.bounds = {glm::vec3(box.lower, 0), glm::vec3(box.upper, 0)};
  if (box.empty()) info.bounds = Box3();
  return info;
}

}  // namespace

ModelInfo model_info(const Model& model, const Run& run) {
  return std::visit([&](const auto& value) { return info_of(value, run); }, model);
}

}  // namespace azulejo
