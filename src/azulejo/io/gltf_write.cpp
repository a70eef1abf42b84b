#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

#include "azulejo/io/gltf.h"
#include "azulejo/io/gltf_output.h"

namespace azulejo {
namespace {

constexpr float kNear = 0.01F;  ///< of cameras that leave it open, which glTF's can't
constexpr float kDepth = 10000.0F;

GltfObject camera_object(const GltfOutput& output, const Camera& camera) {
  GltfObject lens;
  GltfObject result;
  if (!camera.name.empty()) result["name"] = camera.name;
  if (camera.perspective) {
    lens["yfov"] = output.number(camera.fov_y, "a camera's angle");
    lens["znear"] = output.number(camera.near > 0 ? camera.near : kNear, "a camera's near plane");
    if (camera.far > 0) lens["zfar"] = output.number(camera.far, "a camera's far plane");
    if (camera.aspect > 0) lens["aspectRatio"] = output.number(camera.aspect, "a camera's aspect ratio");
  } else {
    const float height = camera.height / 2;
    lens["xmag"] = output.number(camera.aspect > 0 ? camera.aspect * height : height, "a camera's width");
    lens["ymag"] = output.number(height, "a camera's height");
    lens["znear"] = output.number(camera.near, "a camera's near plane");
    lens["zfar"] = output.number(camera.far > 0 ? camera.far : camera.near + kDepth, "a camera's far plane");
  }
  result["type"] = camera.perspective ? "perspective" : "orthographic";
  result[camera.perspective ? "perspective" : "orthographic"] = std::move(lens);
  return result;
}

GltfObject light_object(const GltfOutput& output, const LightSource& light) {
  GltfObject result;
  if (!light.name.empty()) result["name"] = light.name;
  result["type"] = light.kind == LightKind::Directional ? "directional"
                   : light.kind == LightKind::Point     ? "point"
                                                        : "spot";
  if (light.color != glm::vec3(1)) result["color"] = output.numbers(light.color, "a light's color");
  if (light.intensity != 1) result["intensity"] = output.number(light.intensity, "a light's intensity");
  if (light.range > 0) result["range"] = output.number(light.range, "a light's range");
  if (light.kind == LightKind::Spot) {
    result["spot"] = {{"innerConeAngle", output.number(light.inner_cone, "a light's cone")},
                      {"outerConeAngle", output.number(light.outer_cone, "a light's cone")}};
  }
  return result;
}

void write_placement(const GltfOutput& output, const Node& node, GltfObject& result) {
  if (const auto* const matrix = std::get_if<glm::mat4>(&node.placement)) {
    result["matrix"] = output.numbers({glm::value_ptr(*matrix), 16}, "a node's matrix");
    return;
  }
  const auto& placement = std::get<Placement>(node.placement);
  const glm::quat& r = placement.rotation;
  if (placement.translation != glm::vec3(0)) {
    result["translation"] = output.numbers(placement.translation, "a node's translation");
  }
  if (r != glm::quat(1, 0, 0, 0)) {
    result["rotation"] = output.numbers(glm::vec4(r.x, r.y, r.z, r.w), "a node's rotation");
  }
  if (placement.scale != glm::vec3(1)) result["scale"] = output.numbers(placement.scale, "a node's scale");
}

class SceneWriter {
 public:
  SceneWriter(GltfOutput& output, const Scene& scene) : output_(output), scene_(scene) {}

  void write() {
    write_meshes();
    write_gltf_materials(output_, scene_);
    write_cameras_and_lights();
    write_nodes();
    write_gltf_animations(output_, scene_);
  }

 private:
  void write_meshes();
  void write_cameras_and_lights();
  void write_nodes();
  GltfObject node_object(const Node& node) const;
  GltfObject turned_root(GltfObject roots) const;

  GltfOutput& output_;
  const Scene& scene_;
  std::vector<std::uint32_t> mesh_at_;  ///< the written mesh of each mesh
};

/// A mesh without vertices can't be in a glTF file; its nodes stay.
void SceneWriter::write_meshes() {
  GltfObject meshes = GltfObject::array();
  for (const auto& mesh : scene_.meshes) {
    check_cancelled(output_.run());
    if (mesh->positions.empty()) {
      output_.warn(fmt::format("mesh {} is empty and is left out", mesh_at_.size()));
      mesh_at_.push_back(MeshId::kNone);
      continue;
    }
    mesh_at_.push_back(static_cast<std::uint32_t>(meshes.size()));
    meshes.push_back(write_gltf_mesh(output_, *mesh));
  }
  output_.set("meshes", std::move(meshes));
}

void SceneWriter::write_cameras_and_lights() {
  GltfObject cameras = GltfObject::array();
  for (const Camera& camera : scene_.cameras) cameras.push_back(camera_object(output_, camera));
  output_.set("cameras", std::move(cameras));
  if (scene_.lights.empty()) return;
  GltfObject lights = GltfObject::array();
  for (const LightSource& light : scene_.lights) lights.push_back(light_object(output_, light));
  output_.use_extension("KHR_lights_punctual");
  output_.set("extensions", {{"KHR_lights_punctual", {{"lights", std::move(lights)}}}});
}

GltfObject SceneWriter::node_object(const Node& node) const {
  GltfObject result = GltfObject::object();
  if (!node.name.empty()) result["name"] = node.name;
  write_placement(output_, node, result);
  if (!node.children.empty()) {
    GltfObject children = GltfObject::array();
    for (const NodeId child : node.children) children.push_back(child.index);
    result["children"] = std::move(children);
  }
  const std::uint32_t mesh = node.mesh ? mesh_at_[node.mesh.index] : MeshId::kNone;
  if (mesh != MeshId::kNone) {
    result["mesh"] = mesh;
    if (node.skin) result["skin"] = node.skin.index;
    if (!node.morph_weights.empty()) {
      result["weights"] = output_.numbers(node.morph_weights, "a morph weight");
    }
  }
  if (node.camera) result["camera"] = node.camera.index;
  if (node.light) result["extensions"]["KHR_lights_punctual"]["light"] = node.light.index;
  if (!node.visible) result["extensions"]["KHR_node_visibility"]["visible"] = false;
  return result;
}

/// A root above all that turns the scene's coordinates into glTF's: y up, metres.
GltfObject SceneWriter::turned_root(GltfObject roots) const {
  Node node;
  Placement placement;
  if (scene_.space.up == UpAxis::Z) placement.rotation = {0.70710678F, -0.70710678F, 0, 0};
  if (scene_.space.metres_per_unit > 0) placement.scale = glm::vec3(scene_.space.metres_per_unit);
  node.placement = placement;
  GltfObject result = node_object(node);
  result["children"] = std::move(roots);
  return result;
}

void SceneWriter::write_nodes() {
  GltfObject nodes = GltfObject::array();
  for (const Node& node : scene_.nodes) {
    if (!node.visible) output_.use_extension("KHR_node_visibility");
    nodes.push_back(node_object(node));
  }
  GltfObject roots = GltfObject::array();
  for (const NodeId root : scene_.roots) roots.push_back(root.index);
  const Space& space = scene_.space;
  const bool turned = space.up == UpAxis::Z || (space.metres_per_unit > 0 && space.metres_per_unit != 1);
  if (turned && !roots.empty()) {
    nodes.push_back(turned_root(std::exchange(roots, GltfObject::array())));
    roots.push_back(nodes.size() - 1);
  }
  GltfObject scene = GltfObject::object();
  if (!scene_.name.empty()) scene["name"] = scene_.name;
  if (!roots.empty()) scene["nodes"] = std::move(roots);
  output_.set("nodes", std::move(nodes));
  GltfObject scenes = GltfObject::array();
  scenes.push_back(std::move(scene));
  output_.set("scenes", std::move(scenes));
  output_.set("scene", 0);
}

}  // namespace

void write_gltf_scene(Output& output, const Scene& scene, const std::string& /*folder*/, const std::string& /*stem*/,
                      const ModelWriteOptions& /*options*/, const Run& run) {
  scene.check(output.name());
  GltfOutput glb(output.name(), run);
  SceneWriter(glb, scene).write();
  glb.write(output);
}

}  // namespace azulejo
