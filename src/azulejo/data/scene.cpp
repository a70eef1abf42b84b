#include "azulejo/data/scene.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

Error broken(std::string_view what, const std::string& why) {
  return Error(Error::Data, fmt::format("{}: {}", what, why));
}

template <class T, class List>
void check_id(Id<T> id, const List& list, std::string_view what, const std::string& owner, const char* kind) {
  if (id && id.index >= list.size()) {
    throw broken(what, fmt::format("{} names {} {}, of {}", owner, kind, id.index, list.size()));
  }
}

void check_nodes(const Scene& scene, std::string_view what) {
  std::vector<std::uint8_t> has_parent(scene.nodes.size(), 0);
  const auto adopt = [&](NodeId child, const std::string& owner) {
    if (!child || child.index >= scene.nodes.size()) {
      throw broken(what, fmt::format("{} names node {}, of {}", owner, child.index, scene.nodes.size()));
    }
    if (std::exchange(has_parent[child.index], std::uint8_t{1}) != 0) {
      throw broken(what, fmt::format("node {} has two parents or is its own ancestor", child.index));
    }
  };
  for (const NodeId root : scene.roots) adopt(root, "the scene");
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
    const Node& node = scene.nodes[n];
    const std::string owner = fmt::format("node {}", n);
    for (const NodeId child : node.children) adopt(child, owner);
    check_id(node.mesh, scene.meshes, what, owner, "mesh");
    check_id(node.camera, scene.cameras, what, owner, "camera");
    check_id(node.light, scene.lights, what, owner, "light");
    check_id(node.skin, scene.skins, what, owner, "skin");
  }
}

void check_meshes(const Scene& scene, std::string_view what) {
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    if (scene.meshes[m] == nullptr) throw broken(what, fmt::format("mesh {} is missing", m));
    for (const std::uint32_t material : scene.meshes[m]->material) {
      if (material != MaterialId::kNone && material >= scene.materials.size()) {
        throw broken(what, fmt::format("mesh {} names material {}, of {}", m, material, scene.materials.size()));
      }
    }
  }
}

void check_materials(const Scene& scene, std::string_view what) {
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const Material& material = scene.materials[m];
    for (const TextureUse* use :
         {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture,
          &material.occlusion_texture, &material.emissive_texture, &material.specular_texture}) {
      check_id(use->texture, scene.textures, what, fmt::format("material {}", m), "texture");
    }
  }
}

bool finite(const glm::vec3& point) {
  return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

}  // namespace

void Scene::check(std::string_view what) const {
  // A node has one parent at most, and the roots have none: what is reached from the roots has no cycle.
  check_nodes(*this, what);
  check_meshes(*this, what);
  check_materials(*this, what);
  for (const Skin& skin : skins) {
    for (const NodeId joint : skin.joints) {
      if (!joint) throw broken(what, "a skin has a joint without a node");
      check_id(joint, nodes, what, "a skin", "node");
    }
    check_id(skin.skeleton, nodes, what, "a skin", "node");
    if (!skin.inverse_bind_matrices.empty() && skin.inverse_bind_matrices.size() != skin.joints.size()) {
      throw broken(what, fmt::format("a skin has {} joints and {} inverse bind matrices", skin.joints.size(),
                                     skin.inverse_bind_matrices.size()));
    }
  }
  for (const Animation& animation : animations) {
    for (const AnimationChannel& channel : animation.channels) {
      check_id(channel.node, nodes, what, "an animation", "node");
    }
  }
}

glm::mat4 parent_from_node(const Node& node) {
  if (const auto* const matrix = std::get_if<glm::mat4>(&node.placement)) return *matrix;
  const auto& placement = std::get<Placement>(node.placement);
  glm::mat4 result = glm::mat4_cast(placement.rotation);
  for (int axis = 0; axis < 3; ++axis) result[axis] *= placement.scale[axis];
  result[3] = glm::vec4(placement.translation, 1.0F);
  return result;
}

std::vector<PlacedNode> walk(const Scene& scene) {
  std::vector<PlacedNode> placed;
  placed.reserve(scene.nodes.size());
  std::vector<PlacedNode> waiting;
  const auto push = [&](const std::vector<NodeId>& nodes, const PlacedNode& parent) {
    for (std::size_t i = nodes.size(); i-- > 0;) waiting.push_back({nodes[i], parent.world_from_node, parent.visible});
  };
  push(scene.roots, {});
  while (!waiting.empty()) {
    PlacedNode next = waiting.back();
    waiting.pop_back();
    if (placed.size() == scene.nodes.size()) throw Error(Error::Data, "scene: its nodes form a cycle");
    const Node& node = scene.nodes[next.node.index];
    next.world_from_node = next.world_from_node * parent_from_node(node);
    next.visible = next.visible && node.visible;
    placed.push_back(next);
    push(node.children, next);
  }
  return placed;
}

Scene scene_of(Mesh mesh) {
  Scene scene;
  scene.name = mesh.name;
  scene.space = mesh.space;
  mesh.material.clear();
  Node node;
  node.name = mesh.name;
  node.mesh = MeshId(0);
  scene.meshes.push_back(std::make_shared<const Mesh>(std::move(mesh)));
  scene.nodes.push_back(std::move(node));
  scene.roots.emplace_back(0);
  return scene;
}

Box3 bounds(const Scene& scene) {
  Box3 box;
  for (const PlacedNode& placed : walk(scene)) {
    const MeshId mesh = scene.nodes[placed.node.index].mesh;
    if (!placed.visible || !mesh) continue;
    for (const glm::vec3& point : scene.meshes[mesh.index]->positions) {
      const glm::vec3 world(placed.world_from_node * glm::vec4(point, 1.0F));
      if (finite(world)) box = united(box, world);
    }
  }
  return box;
}

}  // namespace azulejo
