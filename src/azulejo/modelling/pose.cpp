#include "azulejo/modelling/pose.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/modelling/skin.h"

namespace azulejo {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 13;  // elements

bool morphed(const Scene& scene, const Node& node) {
  return node.mesh && !scene.meshes[node.mesh.index]->morph_targets.empty() &&
         std::any_of(node.morph_weights.begin(), node.morph_weights.end(), [](float weight) { return weight != 0; });
}

bool posed(const Scene& scene, const Node& node) { return node.mesh && (node.skin || morphed(scene, node)); }

void check_size(const Scene& scene, const Run& run) {
  std::size_t bytes = 0;
  for (const Node& node : scene.nodes) {
    if (!posed(scene, node)) continue;
    const Mesh& mesh = *scene.meshes[node.mesh.index];
    bytes += 12 * mesh.vertex_count() + 8 * mesh.corner_count();
    for (const Attribute& each : mesh.attributes) bytes += 4 * each.size() * static_cast<std::size_t>(each.components);
  }
  if (bytes > static_cast<std::size_t>(std::max<std::int64_t>(run.limits.memory_bytes, 0))) {
    throw Error(Error::Resource,
                fmt::format("pose: needs {} bytes, more than the limit of {}", bytes, run.limits.memory_bytes));
  }
}

Array<float>* vectors(Mesh& mesh, std::string_view name, Domain& domain, int& components) {
  for (Attribute& each : mesh.attributes) {
    if (each.name != name || each.components < 3 || each.domain == Domain::Face) continue;
    domain = each.domain;
    components = each.components;
    return std::get_if<Array<float>>(&each.values);
  }
  return nullptr;
}

/// Changes the three first components of an attribute: change(vertex, vector), made unit length again.
template <class Change>
void change_directions(Mesh& mesh, std::string_view name, const Run& run, const Change& change) {
  Domain domain = Domain::Vertex;
  int components = 3;
  Array<float>* const values = vectors(mesh, name, domain, components);
  if (values == nullptr) return;
  const auto stride = static_cast<std::size_t>(components);
  parallel_for(values->size() / stride, kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      float* const v = values->data() + e * stride;
      const std::size_t vertex = domain == Domain::Corner ? mesh.corners[e] : e;
      const glm::vec3 changed = change(vertex, glm::vec3(v[0], v[1], v[2]));
      const float length = glm::length(changed);
      for (int k = 0; k < 3; ++k) v[k] = length > 0 ? changed[k] / length : 0;
    }
  });
}

void morph(Mesh& mesh, const std::vector<float>& weights, const Run& run) {
  const std::size_t count = std::min(weights.size(), mesh.morph_targets.size());
  for (std::size_t t = 0; t < count; ++t) {
    const MorphTarget& target = mesh.morph_targets[t];
    if (weights[t] == 0) continue;
    for (std::size_t v = 0; v < target.positions.size(); ++v) mesh.positions[v] += weights[t] * target.positions[v];
  }
  change_directions(mesh, "NORMAL", run, [&](std::size_t vertex, glm::vec3 normal) {
    for (std::size_t t = 0; t < count; ++t) {
      const Array<glm::vec3>& normals = mesh.morph_targets[t].normals;
      if (!normals.empty()) normal += weights[t] * normals[vertex];
    }
    return normal;
  });
}

/// Cofactors: the inverse transpose but for a factor, with the sign of a mirror taken out.
glm::mat3 normal_matrix(const glm::mat4& matrix) {
  const glm::mat3 m(matrix);
  const glm::mat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  return glm::dot(m[0], cofactors[0]) < 0 ? -cofactors : cofactors;
}

void bend(Mesh& mesh, const SkinWeights& weights, const std::vector<glm::mat4>& joints, const Run& run) {
  change_directions(mesh, "NORMAL", run, [&](std::size_t vertex, const glm::vec3& normal) {
    return normal_matrix(weights.blend(vertex, joints)) * normal;
  });
  change_directions(mesh, "TANGENT", run, [&](std::size_t vertex, const glm::vec3& tangent) {
    return glm::mat3(weights.blend(vertex, joints)) * tangent;
  });
  parallel_for(mesh.vertex_count(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      mesh.positions[v] = glm::vec3(weights.blend(v, joints) * glm::vec4(mesh.positions[v], 1.0F));
    }
  });
}

/// A node at the root in place of one whose mesh is in world coordinates now.
void move_to_root(Scene& scene, std::size_t index, bool visible) {
  Node moved;
  moved.name = scene.nodes[index].name;
  moved.mesh = scene.nodes[index].mesh;
  moved.visible = visible;
  scene.nodes[index].mesh = {};
  scene.nodes[index].skin = {};
  scene.roots.emplace_back(scene.nodes.size());
  scene.nodes.push_back(std::move(moved));
}

}  // namespace

bool needs_pose(const Scene& scene) {
  if (std::none_of(scene.nodes.begin(), scene.nodes.end(), [&](const Node& node) { return posed(scene, node); })) {
    return false;
  }
  const std::vector<PlacedNode> shown = walk(scene);
  return std::any_of(shown.begin(), shown.end(),
                     [&](const PlacedNode& placed) { return posed(scene, scene.nodes[placed.node.index]); });
}

Scene pose(const Scene& scene, const Run& run) {
  check_size(scene, run);
  Scene result = scene.clone();
  const std::vector<glm::mat4> world_from_node = world_of_all_nodes(scene);
  for (const PlacedNode& placed : walk(scene)) {
    const std::size_t index = placed.node.index;
    const Node& node = scene.nodes[index];
    if (!posed(scene, node)) continue;
    check_cancelled(run);
    Mesh mesh = scene.meshes[node.mesh.index]->clone();
    morph(mesh, node.morph_weights, run);
    mesh.morph_targets.clear();
    if (node.skin) {
      const Skin& skin = scene.skins[node.skin.index];
      bend(mesh, SkinWeights(mesh, skin.joints.size()), joint_matrices(skin, world_from_node), run);
      remove_skin_weights(mesh);
    }
    result.nodes[index].mesh = MeshId(result.meshes.size());
    result.nodes[index].morph_weights.clear();
    result.meshes.push_back(std::make_shared<const Mesh>(std::move(mesh)));
    if (node.skin) move_to_root(result, index, placed.visible);
  }
  return result;
}

}  // namespace azulejo
