#include "azulejo/modelling/scene_tree.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include <fmt/format.h>

namespace azulejo {
namespace {

constexpr std::size_t kDrawnIn = 32;  ///< levels

/// A node that waits for its line.
struct Pending {
  NodeId node;
  std::size_t depth = 0;
  bool last = true;              ///< of its siblings
  std::uint32_t open_above = 0;  ///< a bit for each level above that has siblings to come
};

std::string printable(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return c < ' ' || c == 0x7F; }, '?');
  return name;
}

std::string named(const char* kind, std::size_t index, const std::string& name) {
  return name.empty() ? fmt::format("{} {}", kind, index) : fmt::format("{} \"{}\"", kind, printable(name));
}

/// What a placement does, in short; "" if it does nothing.
std::string placement_text(const Node& node) {
  if (const auto* const matrix = std::get_if<glm::mat4>(&node.placement)) {
    return *matrix == glm::mat4(1.0F) ? "" : "matrix";
  }
  constexpr float kDegrees = 57.2957795F;
  const auto& placement = std::get<Placement>(node.placement);
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  const glm::vec3& t = placement.translation;
  if (t != glm::vec3(0)) add(fmt::format("moved {:.4g} {:.4g} {:.4g}", t.x, t.y, t.z));
  const float turned = 2 * std::acos(std::min(std::abs(placement.rotation.w), 1.0F)) * kDegrees;
  if (turned > 1e-3F) add(fmt::format("turned {:.4g}°", turned));
  const glm::vec3& s = placement.scale;
  // Exporters leave the rounding of matrices in scales that were 1.
  const auto near = [](float a, float b) { return std::abs(a - b) <= 1e-4F * std::abs(b); };
  if (!near(s.x, 1) || !near(s.y, 1) || !near(s.z, 1)) {
    add(near(s.x, s.y) && near(s.y, s.z) ? fmt::format("scaled {:.4g}", s.x)
                                         : fmt::format("scaled {:.4g} {:.4g} {:.4g}", s.x, s.y, s.z));
  }
  return text;
}

std::string line_of(const Scene& scene, NodeId id) {
  const Node& node = scene.nodes[id.index];
  std::string text = node.name.empty() ? fmt::format("node {}", id.index) : printable(node.name);
  const auto add = [&](const std::string& part) {
    if (!part.empty()) text += "  [" + part + "]";
  };
  if (node.mesh) {
    const Mesh& mesh = *scene.meshes[node.mesh.index];
    add(fmt::format("{}, {} faces", named("mesh", node.mesh.index, mesh.name), mesh.face_count()));
  }
  if (node.camera) add(named("camera", node.camera.index, scene.cameras[node.camera.index].name));
  if (node.light) add(named("light", node.light.index, scene.lights[node.light.index].name));
  if (node.skin) add(named("skin", node.skin.index, scene.skins[node.skin.index].name));
  if (!node.visible) add("hidden");
  const std::string placement = placement_text(node);
  return placement.empty() ? text : text + "  " + placement;
}

/// The strokes in front of a line.
std::string indent(const Pending& pending) {
  std::string text;
  const std::size_t drawn = std::min(pending.depth, kDrawnIn);
  for (std::size_t level = 1; level < drawn; ++level) text += (pending.open_above >> level & 1) != 0 ? "│  " : "   ";
  if (pending.depth > 0) text += pending.last ? "└─ " : "├─ ";
  return pending.depth > kDrawnIn ? text + fmt::format("({} deep) ", pending.depth) : text;
}

void push(std::vector<Pending>& waiting, const std::vector<NodeId>& nodes, std::size_t depth, std::uint32_t open) {
  for (auto node = nodes.rbegin(); node != nodes.rend(); ++node)
    waiting.push_back({*node, depth, node == nodes.rbegin(), open});
}

/// Sets the member if there is something to say.
template <class T>
void set_id(Json& json, const char* key, Id<T> id) {
  if (id) json.set(key, std::uint64_t{id.index});
}

Json numbers(const float* values, std::size_t count) {
  Json array = Json::array();
  for (std::size_t i = 0; i < count; ++i) array.push(values[i]);
  return array;
}

void set_placement(Json& json, const Node& node) {
  if (const auto* const matrix = std::get_if<glm::mat4>(&node.placement)) {
    json.set("matrix", numbers(&(*matrix)[0][0], 16));
    return;
  }
  const auto& placement = std::get<Placement>(node.placement);
  const glm::quat& turn = placement.rotation;
  const float xyzw[] = {turn.x, turn.y, turn.z, turn.w};
  if (placement.translation != glm::vec3(0)) json.set("translation", numbers(&placement.translation.x, 3));
  if (turn != glm::quat(1, 0, 0, 0)) json.set("rotation", numbers(xyzw, 4));
  if (placement.scale != glm::vec3(1)) json.set("scale", numbers(&placement.scale.x, 3));
}

}  // namespace

std::string scene_tree(const Scene& scene) {
  std::string text;
  std::vector<Pending> waiting;
  push(waiting, scene.roots, 0, 0);
  while (!waiting.empty()) {
    const Pending next = waiting.back();
    waiting.pop_back();
    fmt::format_to(std::back_inserter(text), "{}{}\n", indent(next), line_of(scene, next.node));
    std::uint32_t open = next.open_above;
    if (next.depth > 0 && next.depth < kDrawnIn && !next.last) open |= 1U << next.depth;
    push(waiting, scene.nodes[next.node.index].children, next.depth + 1, open);
  }
  return text;
}

Json nodes_json(const Scene& scene) {
  Json array = Json::array();
  for (const Node& node : scene.nodes) {
    Json children = Json::array();
    for (const NodeId child : node.children) children.push(std::uint64_t{child.index});
    Json json = Json::object();
    json.set("name", node.name.empty() ? Json() : Json(node.name)).set("children", children);
    set_id(json, "mesh", node.mesh);
    set_id(json, "camera", node.camera);
    set_id(json, "light", node.light);
    set_id(json, "skin", node.skin);
    if (!node.visible) json.set("visible", false);
    set_placement(json, node);
    array.push(json);
  }
  return array;
}

Json roots_json(const Scene& scene) {
  Json array = Json::array();
  for (const NodeId root : scene.roots) array.push(std::uint64_t{root.index});
  return array;
}

}  // namespace azulejo
