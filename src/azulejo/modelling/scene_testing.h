#pragma once

// Small scenes for tests.

#include <memory>
#include <string>
#include <utility>

#include "azulejo/data/scene.h"

namespace azulejo::testing {

/// The triangle (0, 0, 0), (1, 0, 0), (0, 1, 0), with its normals.
inline Mesh triangle() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.corners = {0, 1, 2};
  mesh.attributes.push_back({"NORMAL", Domain::Vertex, 3, Array<float>{0, 0, 1, 0, 0, 1, 0, 0, 1}});
  return mesh;
}

inline MeshId add_mesh(Scene& scene, Mesh mesh) {
  scene.meshes.push_back(std::make_shared<const Mesh>(std::move(mesh)));
  return MeshId(scene.meshes.size() - 1);
}

/// A node below `parent`, or a root.
inline NodeId add_node(Scene& scene, MeshId mesh, Placement placement = {}, NodeId parent = {}) {
  const NodeId id(scene.nodes.size());
  Node node;
  node.name = "node " + std::to_string(id.index);
  node.mesh = mesh;
  node.placement = placement;
  scene.nodes.push_back(std::move(node));
  (parent ? scene.nodes[parent.index].children : scene.roots).push_back(id);
  return id;
}

inline glm::vec3 vector_at(const Attribute& attribute, std::size_t element) {
  const Array<float>& values = *attribute.get<float>();
  const std::size_t first = element * static_cast<std::size_t>(attribute.components);
  return {values[first], values[first + 1], values[first + 2]};
}

}  // namespace azulejo::testing
