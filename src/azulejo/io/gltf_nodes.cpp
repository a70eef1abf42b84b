#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "azulejo/io/gltf_parts.h"

namespace azulejo {
namespace {

/// Of unit length, as glTF wants it; what is so already, to rounding, keeps its bits.
glm::quat unit_rotation(const std::array<float, 4>& xyzw) {
  const glm::quat rotation(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
  const float length = glm::length(rotation);
  if (std::abs(length - 1.0F) < 1e-5F) return rotation;
  return length > 0 && std::isfinite(length) ? rotation / length : glm::quat(1, 0, 0, 0);
}

glm::vec3 to_vec3(const std::array<float, 3>& values) { return {values[0], values[1], values[2]}; }

class NodeReader {
 public:
  NodeReader(GltfFile& file, GltfAccessors& accessors, Scene& scene)
      : file_(file), accessors_(accessors), scene_(scene) {}

  void read();

 private:
  Node read_node(const GltfValue& value);
  void read_references(const GltfValue& value, Node& node);
  void read_weights(const GltfValue& value, std::size_t index, Node& node);
  void find_parents(const GltfValue& list);
  void check_no_cycle() const;
  void read_roots();
  void check_joints();
  void expand_instances(const GltfValue& instancing, std::size_t index);
  Array<float> instance_values(const GltfValue& accessor, int components, std::size_t& count);

  GltfFile& file_;
  GltfAccessors& accessors_;
  Scene& scene_;
  std::vector<bool> has_parent_;
};

void NodeReader::read() {
  const GltfValue list = file_.root()["nodes"];
  file_.claim(list.size(), sizeof(Node));
  scene_.nodes.reserve(list.size());
  for (std::size_t n = 0; n < list.size(); ++n) {
    scene_.nodes.push_back(read_node(list.at(n)));
    read_weights(list.at(n), n, scene_.nodes.back());
  }
  find_parents(list);
  check_no_cycle();
  read_roots();
  check_joints();
  for (std::size_t n = 0; n < list.size(); ++n) {
    if (const GltfValue instancing = list.at(n)["extensions"]["EXT_mesh_gpu_instancing"]) {
      expand_instances(instancing, n);
    }
  }
}

Node NodeReader::read_node(const GltfValue& value) {
  Node node;
  node.name = value["name"].text();
  if (const GltfValue matrix = value["matrix"]) {
    node.placement = glm::make_mat4(matrix.numbers<16>({}).data());
  } else {
    Placement placement;
    placement.translation = to_vec3(value["translation"].numbers<3>({0, 0, 0}));
    placement.rotation = unit_rotation(value["rotation"].numbers<4>({0, 0, 0, 1}));
    placement.scale = to_vec3(value["scale"].numbers<3>({1, 1, 1}));
    node.placement = placement;
  }
  read_references(value, node);
  return node;
}

void NodeReader::read_references(const GltfValue& value, Node& node) {
  if (const GltfValue mesh = value["mesh"]) node.mesh = MeshId(mesh.index(scene_.meshes.size()));
  if (const GltfValue camera = value["camera"]) node.camera = CameraId(camera.index(scene_.cameras.size()));
  if (const GltfValue skin = value["skin"]) node.skin = SkinId(skin.index(scene_.skins.size()));
  const GltfValue extensions = value["extensions"];
  if (!extensions) return;
  if (const GltfValue light = extensions["KHR_lights_punctual"]["light"]) {
    node.light = LightId(light.index(scene_.lights.size()));
  }
  node.visible = extensions["KHR_node_visibility"]["visible"].truth(true);
}

void NodeReader::read_weights(const GltfValue& value, std::size_t index, Node& node) {
  if (!node.mesh) return;
  const std::size_t targets = scene_.meshes[node.mesh.index]->morph_targets.size();
  GltfValue weights = value["weights"];
  if (!weights) weights = file_.root()["meshes"].at(node.mesh.index)["weights"];
  if (!weights) return;
  file_.claim(weights.size(), sizeof(float));
  node.morph_weights = weights.numbers();
  if (node.morph_weights.size() == targets) return;
  file_.warn(fmt::format("node {} has {} morph weights for {} targets", index, node.morph_weights.size(), targets));
  node.morph_weights.resize(targets, 0.0F);
}

void NodeReader::find_parents(const GltfValue& list) {
  has_parent_.resize(scene_.nodes.size());
  for (std::size_t n = 0; n < scene_.nodes.size(); ++n) {
    const GltfValue children = list.at(n)["children"];
    scene_.nodes[n].children.reserve(children.size());
    for (std::size_t c = 0; c < children.size(); ++c) {
      const std::size_t child = children.at(c).index(scene_.nodes.size());
      if (has_parent_[child]) throw children.at(c).error(fmt::format("node {} has two parents", child));
      has_parent_[child] = true;
      scene_.nodes[n].children.emplace_back(child);
    }
  }
}

/// Nodes have one parent at most. So those that can't be reached from a node without parents are in, or below, a cycle.
void NodeReader::check_no_cycle() const {
  std::vector<std::size_t> waiting;
  for (std::size_t n = 0; n < has_parent_.size(); ++n) {
    if (!has_parent_[n]) waiting.push_back(n);
  }
  std::size_t reached = 0;
  while (!waiting.empty()) {
    const Node& node = scene_.nodes[waiting.back()];
    waiting.pop_back();
    ++reached;
    for (const NodeId child : node.children) waiting.push_back(child.index);
  }
  if (reached < scene_.nodes.size()) {
    throw file_.root()["nodes"].error(fmt::format("{} of {} nodes are their own ancestors or below such a node",
                                                  scene_.nodes.size() - reached, scene_.nodes.size()));
  }
}

void NodeReader::read_roots() {
  const GltfValue scenes = file_.root()["scenes"];
  if (scenes.size() == 0) {
    for (std::size_t n = 0; n < has_parent_.size(); ++n) {
      if (!has_parent_[n]) scene_.roots.emplace_back(n);
    }
    return;
  }
  const GltfValue chosen = file_.root()["scene"];
  const GltfValue scene = scenes.at(chosen ? chosen.index(scenes.size()) : 0);
  scene_.name = scene["name"].text();
  const GltfValue roots = scene["nodes"];
  for (std::size_t r = 0; r < roots.size(); ++r) {
    const std::size_t root = roots.at(r).index(scene_.nodes.size());
    if (has_parent_[root]) throw roots.at(r).error(fmt::format("node {} has a parent, or is named twice", root));
    has_parent_[root] = true;
    scene_.roots.emplace_back(root);
  }
}

/// A skinned mesh must not name joints that its skin doesn't have.
void NodeReader::check_joints() {
  constexpr std::uint32_t kUnknown = 0xFFFFFFFF;
  std::vector<std::uint32_t> largest(scene_.meshes.size(), kUnknown);
  for (std::size_t n = 0; n < scene_.nodes.size(); ++n) {
    const Node& node = scene_.nodes[n];
    if (!node.mesh || !node.skin) continue;
    std::uint32_t& most = largest[node.mesh.index];
    if (most == kUnknown) {
      most = 0;
      for (const Attribute& attribute : scene_.meshes[node.mesh.index]->attributes) {
        const auto* const joints = attribute.get<std::uint32_t>();
        if (joints == nullptr || joints->empty() || !attribute.name.starts_with("JOINTS_")) continue;
        most = std::max(most, *std::max_element(joints->begin(), joints->end()));
      }
    }
    const std::size_t joints = scene_.skins[node.skin.index].joints.size();
    if (most >= joints && !scene_.meshes[node.mesh.index]->positions.empty()) {
      throw file_.root()["nodes"].at(n).error(fmt::format("its mesh names joint {}, of {}", most, joints));
    }
  }
}

/// Values of the instances, or none; all must agree on how many there are.
Array<float> NodeReader::instance_values(const GltfValue& value, int components, std::size_t& count) {
  Array<float> values;
  if (!value) return values;
  const GltfAccessor& accessor = accessors_.at(value, components);
  if (count != 0 && accessor.count != count) {
    throw value.error(fmt::format("{} instances, another attribute has {}", accessor.count, count));
  }
  count = accessor.count;
  file_.claim(accessor.values(), sizeof(float));
  values.resize(accessor.values());
  accessors_.read(accessor, value, std::span<float>(values));
  return values;
}

void NodeReader::expand_instances(const GltfValue& instancing, std::size_t index) {
  const GltfValue attributes = instancing.need("attributes");
  std::size_t count = 0;
  const Array<float> translations = instance_values(attributes["TRANSLATION"], 3, count);
  const Array<float> rotations = instance_values(attributes["ROTATION"], 4, count);
  const Array<float> scales = instance_values(attributes["SCALE"], 3, count);
  file_.claim(count, sizeof(Node));
  const MeshId mesh = scene_.nodes[index].mesh;
  const std::vector<float> weights = scene_.nodes[index].morph_weights;
  scene_.nodes[index].mesh = {};
  scene_.nodes[index].morph_weights.clear();
  for (std::size_t i = 0; i < count; ++i) {
    Placement placement;
    if (!translations.empty()) placement.translation = glm::make_vec3(translations.data() + i * 3);
    if (!scales.empty()) placement.scale = glm::make_vec3(scales.data() + i * 3);
    if (!rotations.empty()) {
      const float* const r = rotations.data() + i * 4;
      placement.rotation = unit_rotation({r[0], r[1], r[2], r[3]});
    }
    Node node;
    node.placement = placement;
    node.mesh = mesh;
    node.morph_weights = weights;
    scene_.nodes[index].children.emplace_back(scene_.nodes.size());
    scene_.nodes.push_back(std::move(node));
  }
}

Camera read_camera(const GltfValue& value) {
  Camera camera;
  camera.name = value["name"].text();
  const std::string type = value.need("type").text();
  if (type != "perspective" && type != "orthographic") {
    throw value.error(fmt::format("type {}, expected perspective or orthographic", printable(type)));
  }
  camera.perspective = type == "perspective";
  const GltfValue lens = value.need(type);
  camera.near = lens["znear"].number(0);
  camera.far = lens["zfar"].number(0);
  if (camera.near < 0 || camera.far < 0 || (camera.far > 0 && camera.far <= camera.near)) {
    throw lens.error(fmt::format("znear {}, zfar {}, expected 0 ≤ znear < zfar", camera.near, camera.far));
  }
  if (camera.perspective) {
    camera.fov_y = lens.need("yfov").number(0);
    camera.aspect = lens["aspectRatio"].number(0);
    if (!(camera.fov_y > 0 && camera.fov_y < 3.1415927F) || camera.aspect < 0) {
      throw lens.error(fmt::format("yfov {}, aspectRatio {}, expected 0 < yfov < π", camera.fov_y, camera.aspect));
    }
    return camera;
  }
  const float width = std::abs(lens.need("xmag").number(0));
  const float height = std::abs(lens.need("ymag").number(0));
  if (!(width > 0 && height > 0)) throw lens.error("xmag and ymag, expected not to be 0");
  camera.height = 2 * height;
  camera.aspect = width / height;
  return camera;
}

LightSource read_light(const GltfValue& value) {
  LightSource light;
  light.name = value["name"].text();
  const std::string type = value.need("type").text();
  if (type == "directional") {
    light.kind = LightKind::Directional;
  } else if (type == "point") {
    light.kind = LightKind::Point;
  } else if (type == "spot") {
    light.kind = LightKind::Spot;
  } else {
    throw value.error(fmt::format("type {}, expected directional, point or spot", printable(type)));
  }
  light.color = to_vec3(value["color"].numbers<3>({1, 1, 1}));
  light.intensity = value["intensity"].number(1);
  light.range = std::max(value["range"].number(0), 0.0F);
  constexpr float kRightAngle = 1.5707964F;
  const GltfValue spot = value["spot"];
  light.outer_cone = std::clamp(spot["outerConeAngle"].number(light.outer_cone), 0.0F, kRightAngle);
  light.inner_cone = std::clamp(spot["innerConeAngle"].number(0), 0.0F, light.outer_cone);
  return light;
}

}  // namespace

std::vector<Camera> read_gltf_cameras(GltfFile& file) {
  const GltfValue list = file.root()["cameras"];
  file.claim(list.size(), sizeof(Camera));
  std::vector<Camera> cameras;
  cameras.reserve(list.size());
  for (std::size_t c = 0; c < list.size(); ++c) cameras.push_back(read_camera(list.at(c)));
  return cameras;
}

std::vector<LightSource> read_gltf_lights(GltfFile& file) {
  const GltfValue list = file.root()["extensions"]["KHR_lights_punctual"]["lights"];
  file.claim(list.size(), sizeof(LightSource));
  std::vector<LightSource> lights;
  lights.reserve(list.size());
  for (std::size_t l = 0; l < list.size(); ++l) lights.push_back(read_light(list.at(l)));
  return lights;
}

void read_gltf_nodes(GltfFile& file, GltfAccessors& accessors, Scene& scene) {
  NodeReader(file, accessors, scene).read();
}

}  // namespace azulejo
