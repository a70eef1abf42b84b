#include "azulejo/modelling/skin.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

constexpr int kJoints = 4;  // of a vertex, in one attribute

Error broken(const Mesh& mesh, const std::string& why) {
  return Error(Error::Data, fmt::format("pose: mesh {}: {}", mesh.name, why));
}

bool fits(const Attribute& attribute) { return attribute.domain == Domain::Vertex && attribute.components == kJoints; }

/// Node indices are few, and files store them as bytes: both widths are taken.
Array<std::uint32_t> joint_indices(const Mesh& mesh, const Attribute& attribute, std::size_t joints) {
  Array<std::uint32_t> result;
  if (const auto* const wide = attribute.get<std::uint32_t>()) {
    result = *wide;
  } else if (const auto* const narrow = attribute.get<std::uint8_t>()) {
    result.assign(narrow->begin(), narrow->end());
  } else {
    throw broken(mesh, attribute.name + " is of type f32, expected u32");
  }
  const auto largest = std::max_element(result.begin(), result.end());
  if (largest != result.end() && *largest >= joints) {
    throw broken(mesh, fmt::format("{} names joint {}, of {}", attribute.name, *largest, joints));
  }
  return result;
}

}  // namespace

std::vector<glm::mat4> world_of_all_nodes(const Scene& scene) {
  Scene all;
  all.nodes = scene.nodes;
  std::vector<std::uint8_t> has_parent(scene.nodes.size(), 0);
  for (const Node& node : scene.nodes) {
    for (const NodeId child : node.children) has_parent[child.index] = 1;
  }
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
    if (has_parent[n] == 0) all.roots.emplace_back(n);
  }
  std::vector<glm::mat4> result(scene.nodes.size(), glm::mat4(1.0F));
  for (const PlacedNode& placed : walk(all)) result[placed.node.index] = placed.world_from_node;
  return result;
}

std::vector<glm::mat4> joint_matrices(const Skin& skin, const std::vector<glm::mat4>& world_from_node) {
  std::vector<glm::mat4> result;
  for (std::size_t j = 0; j < skin.joints.size(); ++j) {
    const glm::mat4& world = world_from_node[skin.joints[j].index];
    result.push_back(skin.inverse_bind_matrices.empty() ? world : world * skin.inverse_bind_matrices[j]);
  }
  return result;
}

SkinWeights::SkinWeights(const Mesh& mesh, std::size_t joints) {
  for (int n = 0;; ++n) {
    const Attribute* const names = mesh.find(fmt::format("JOINTS_{}", n));
    const Attribute* const weights = mesh.find(fmt::format("WEIGHTS_{}", n));
    if (names == nullptr || weights == nullptr) return;
    if (!fits(*names) || !fits(*weights) || weights->get<float>() == nullptr) {
      throw broken(mesh, fmt::format("JOINTS_{0} and WEIGHTS_{0} don't have four values a vertex, u32 and f32", n));
    }
    sets_.push_back({joint_indices(mesh, *names, joints), *weights->get<float>()});
  }
}

glm::mat4 SkinWeights::blend(std::size_t vertex, const std::vector<glm::mat4>& joints) const {
  glm::mat4 sum(0.0F);
  float total = 0;
  for (const Set& set : sets_) {
    for (std::size_t i = kJoints * vertex; i < kJoints * (vertex + 1); ++i) {
      if (set.weights[i] == 0) continue;
      sum += set.weights[i] * joints[set.joints[i]];
      total += set.weights[i];
    }
  }
  return total > 0 ? sum / total : glm::mat4(1.0F);
}

void remove_skin_weights(Mesh& mesh) {
  std::erase_if(mesh.attributes, [](const Attribute& each) {
    return each.name.rfind("JOINTS_", 0) == 0 || each.name.rfind("WEIGHTS_", 0) == 0;
  });
}

}  // namespace azulejo
