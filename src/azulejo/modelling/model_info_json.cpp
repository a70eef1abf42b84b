#include <cmath>

#include "azulejo/modelling/model_info.h"

namespace azulejo {
namespace {

Json number(std::size_t value) { return static_cast<std::uint64_t>(value); }
Json name_of(const std::string& name) { return name.empty() ? Json() : Json(name); }
Json known(float value) { return value > 0 ? Json(value) : Json(); }

Json vector(const glm::vec3& value) { return Json::array().push(value.x).push(value.y).push(value.z); }

Json box(const Box3& bounds) {
  if (bounds.empty()) return {};
  return Json::object()
      .set("lower", vector(bounds.lower))
      .set("upper", vector(bounds.upper))
      .set("size", vector(bounds.size()));
}

Json attributes(const std::vector<AttributeInfo>& list, bool several) {
  Json array = Json::array();
  for (const AttributeInfo& each : list) {
    Json json = Json::object();
    json.set("name", each.name)
        .set("domain", to_string(each.domain))
        .set("components", each.components)
        .set("type", each.type);
    if (several) json.set("meshes", number(each.meshes));
    array.push(json);
  }
  return array;
}

/// Sets what is known of a mesh, or of several together.
void set_mesh(Json& json, const MeshInfo& mesh, bool several) {
  json.set("vertices", number(mesh.vertices))
      .set("faces", number(mesh.faces))
      .set("triangles", number(mesh.triangles))
      .set("corners", number(mesh.corners))
      .set("lines", number(mesh.lines));
  Json polygons = Json::object();
  for (const auto& [size, count] : mesh.polygons) polygons.set(std::to_string(size), number(count));
  json.set("polygons", mesh.polygons.empty() ? Json() : polygons);
  json.set("attributes", attributes(mesh.attributes, several)).set("morph_targets", number(mesh.morph_targets));
  if (!several) json.set("closed", mesh.edges.closed());
  json.set("edges", number(mesh.edges.edges))
      .set("border_edges", number(mesh.edges.border))
      .set("turned_edges", number(mesh.edges.turned))
      .set("crowded_edges", number(mesh.edges.crowded))
      .set("flat_faces", number(mesh.flat_faces))
      .set("not_finite_vertices", number(mesh.not_finite_vertices));
}

const char* model_name(MaterialModel model) {
  switch (model) {
    case MaterialModel::Phong: return "phong";
    case MaterialModel::Unlit: return "unlit";
    case MaterialModel::MetalRough: break;
  }
  return "metal_rough";
}

const char* kind_name(LightKind kind) {
  return kind == LightKind::Point ? "point" : kind == LightKind::Spot ? "spot" : "directional";
}

template <class List, class F>
Json array_of(const List& list, F element) {
  Json array = Json::array();
  for (const auto& each : list) array.push(element(each));
  return array;
}

Json material(const Material& material) {
  Json extensions = Json::array();
  for (const std::string& name : material.extensions.keys()) extensions.push(name);
  return Json::object()
      .set("name", name_of(material.name))
      .set("model", model_name(material.model))
      .set("extensions", extensions);
}

Json texture(const TextureInfo& texture) {
  const bool missing = texture.width == 0;
  return Json::object()
      .set("name", name_of(texture.name))
      .set("source", name_of(texture.source))
      .set("missing", missing)
      .set("width", missing ? Json() : Json(texture.width))
      .set("height", missing ? Json() : Json(texture.height))
      .set("channels", missing ? Json() : Json(texture.channels));
}

Json camera(const Camera& camera) {
  constexpr float kDegrees = 57.2957795F;
  Json json = Json::object();
  json.set("name", name_of(camera.name)).set("projection", camera.perspective ? "perspective" : "orthographic");
  if (camera.perspective) return json.set("fov_y_deg", camera.fov_y * kDegrees);
  return json.set("height", camera.height);
}

Json mesh(const MeshInfo& mesh) {
  Json json = Json::object();
  json.set("name", name_of(mesh.name)).set("uses", number(mesh.uses));
  set_mesh(json, mesh, false);
  return json.set("bounds", box(mesh.bounds));
}

void set_scene(Json& json, const SceneInfo& scene) {
  json.set("closed", scene.meshes > 0 && scene.closed_meshes == scene.meshes)
      .set("nodes", number(scene.nodes))
      .set("shown_nodes", number(scene.shown_nodes))
      .set("roots", number(scene.roots))
      .set("depth", number(scene.depth))
      .set("instances", number(scene.instances))
      .set("shown_triangles", number(scene.shown_triangles))
      .set("closed_meshes", number(scene.closed_meshes))
      .set("meshes", array_of(scene.each_mesh, mesh))
      .set("materials", array_of(scene.materials, material))
      .set("textures", array_of(scene.textures, texture))
      .set("cameras", array_of(scene.cameras, camera))
      .set("lights", array_of(scene.lights,
                              [](const LightSource& light) {
                                return Json::object()
                                    .set("name", name_of(light.name))
                                    .set("kind", kind_name(light.kind))
                                    .set("intensity", light.intensity);
                              }))
      .set("animations", array_of(scene.animations,
                                  [](const AnimationInfo& animation) {
                                    return Json::object()
                                        .set("name", name_of(animation.name))
                                        .set("seconds", animation.seconds)
                                        .set("channels", number(animation.channels));
                                  }))
      .set("skins", array_of(scene.skins, [](const auto& skin) {
             return Json::object().set("name", name_of(skin.first)).set("joints", number(skin.second));
           }));
}

void set_volume(Json& json, const VolumeInfo& volume) {
  json.set("width", volume.width).set("height", volume.height).set("depth", volume.depth);
  json.set("spacing", vector(volume.spacing)).set("origin", vector(volume.origin));
  json.set("lowest", volume.lowest)
      .set("highest", volume.highest)
      .set("mean", volume.mean)
      .set("not_finite", number(volume.not_finite));
}

void set_drawing(Json& json, const DrawingInfo& drawing) {
  json.set("width", drawing.width).set("height", drawing.height).set("unit", to_string(drawing.unit));
  json.set("paths", number(drawing.paths))
      .set("shown_paths", number(drawing.shown_paths))
      .set("segments", number(drawing.segments))
      .set("curves", number(drawing.curves))
      .set("points", number(drawing.points))
      .set("not_finite_points", number(drawing.not_finite_points))
      .set("groups", number(drawing.groups))
      .set("depth", number(drawing.depth))
      .set("styles", number(drawing.styles))
      .set("gradients", number(drawing.gradients))
      .set("other_patterns", number(drawing.other_patterns))
      .set("clips", number(drawing.clips))
      .set("texts", number(drawing.texts));
}

}  // namespace

Json to_json(const ModelInfo& info) {
  Json json = Json::object();
  json.set("kind", info.kind).set("name", name_of(info.name));
  json.set("up", info.up ? Json(to_string(*info.up)) : Json()).set("metres_per_unit", known(info.metres_per_unit));
  json.set("bounds", box(info.bounds)).set("bounds_exact", info.bounds_exact);
  if (info.mesh) set_mesh(json, *info.mesh, info.scene.has_value());
  if (info.scene) set_scene(json, *info.scene);
  if (info.volume) set_volume(json, *info.volume);
  if (info.drawing) set_drawing(json, *info.drawing);
  return json;
}

}  // namespace azulejo
