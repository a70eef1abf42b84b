#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "azulejo/modelling/model_info.h"

namespace azulejo {
namespace {

constexpr std::size_t kListed = 8;  ///< of the parts of a scene; the others are counted

/// 1234567 as "1,234,567".
std::string grouped(std::size_t value) {
  const std::string digits = std::to_string(value);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
    text += digits[i];
  }
  return text;
}

/// "1 face", "2 faces", "2 meshes".
std::string counted(std::size_t count, std::string_view one, std::string_view several = {}) {
  return fmt::format("{} {}", grouped(count),
                     count == 1        ? std::string(one)
                     : several.empty() ? fmt::format("{}s", one)
                                       : std::string(several));
}

/// A name as a file gives it, with nothing in it that could move a terminal's cursor.
std::string quoted(const std::string& name) {
  std::string result = name.substr(0, 80);
  std::replace_if(
      result.begin(), result.end(), [](unsigned char c) { return c < ' ' || c == 0x7F; }, '?');
  return fmt::format("\"{}{}\"", result, name.size() > 80 ? "…" : "");
}

std::string titled(const std::string& name, const std::string& what) {
  return name.empty() ? what : fmt::format("{} {}", quoted(name), what);
}

std::string vector(const glm::vec3& value) { return fmt::format("{:.6g}, {:.6g}, {:.6g}", value.x, value.y, value.z); }

/// Lines of a label and a value.
class Table {
 public:
  void row(std::string_view label, const std::string& value) { text_ += fmt::format("  {:<12}{}\n", label, value); }
  /// A count, and a line for each of the first of a list.
  template <class List, class F>
  void list(std::string_view label, const List& items, F describe) {
    if (items.empty()) return;
    if (items.size() == 1) return row(label, describe(items.front()));
    row(label, grouped(items.size()));
    for (std::size_t i = 0; i < std::min(items.size(), kListed); ++i) row("", describe(items[i]));
    if (items.size() > kListed) row("", fmt::format("… and {} more", grouped(items.size() - kListed)));
  }
  std::string text() && { return std::move(text_); }

 private:
  std::string text_;
};

/// "5 triangles, 3 quads, 1 7-gon".
std::string polygon_list(const MeshInfo& mesh) {
  std::string text;
  std::size_t listed = 0;
  for (const auto& [size, count] : mesh.polygons) {
    if (!text.empty()) text += ", ";
    if (listed++ == kListed) return text + "…";
    text += size == 3   ? counted(count, "triangle")
            : size == 4 ? counted(count, "quad")
                        : fmt::format("{} {}-gon{}", grouped(count), size, count == 1 ? "" : "s");
  }
  return text;
}

std::string faces(const MeshInfo& mesh) {
  if (mesh.faces == 0) return mesh.lines > 0 || mesh.vertices == 0 ? "none" : "none: a cloud of points";
  if (mesh.polygons.empty()) return counted(mesh.faces, "triangle");
  return fmt::format("{}: {}", grouped(mesh.faces), polygon_list(mesh));
}

/// What keeps a surface from being closed.
std::string edge_faults(const EdgeCounts& edges) {
  std::string text;
  const auto add = [&](std::size_t count, const char* kind) {
    if (count == 0) return;
    text += (text.empty() ? "" : ", ") + counted(count, "edge") + kind;
  };
  add(edges.border, " with one face");
  add(edges.crowded, " with more than two");
  add(edges.turned, " between faces turned against each other");
  return text;
}

std::string closed(const ModelInfo& info) {
  const EdgeCounts& edges = info.mesh->edges;
  if (edges.edges == 0) return "no: no faces";
  const std::string faults = edge_faults(edges);
  if (!info.scene || info.scene->meshes == 1) return faults.empty() ? "yes" : "no: " + faults;
  if (faults.empty() && info.scene->closed_meshes == info.scene->meshes) return "yes, every mesh";
  return fmt::format("{} of {}{}{}", grouped(info.scene->closed_meshes), counted(info.scene->meshes, "mesh", "meshes"),
                     faults.empty() ? "" : ": ", faults);
}

std::string attribute(const AttributeInfo& each, std::size_t meshes) {
  std::string text =
      fmt::format("{:<12} {} × {}, of each {}", each.name, each.components, each.type, to_string(each.domain));
  if (each.meshes < meshes) text += fmt::format(", in {} of {} meshes", grouped(each.meshes), grouped(meshes));
  return text;
}

void mesh_rows(Table& table, const ModelInfo& info) {
  const MeshInfo& mesh = *info.mesh;
  table.row("vertices", grouped(mesh.vertices));
  table.row("faces", faces(mesh));
  if (mesh.lines > 0) table.row("lines", grouped(mesh.lines));
  const std::size_t meshes = info.scene ? info.scene->meshes : 1;
  for (std::size_t i = 0; i < mesh.attributes.size(); ++i) {
    table.row(i == 0 ? "attributes" : "", attribute(mesh.attributes[i], meshes));
  }
  if (mesh.morph_targets > 0) table.row("morphs", counted(mesh.morph_targets, "target"));
  if (mesh.faces > 0) table.row("closed", closed(info));
  if (mesh.flat_faces > 0) table.row("flat", counted(mesh.flat_faces, "face") + " without area");
  if (mesh.not_finite_vertices > 0) {
    table.row("not finite", counted(mesh.not_finite_vertices, "vertex", "vertices") + " with NaN or infinity");
  }
}

std::string material(const Material& material) {
  std::string text = titled(material.name, material.model == MaterialModel::Phong   ? "Phong"
                                           : material.model == MaterialModel::Unlit ? "unlit"
                                                                                    : "metal-rough");
  if (material.alpha_mode == AlphaMode::Blend) text += ", blended";
  if (material.alpha_mode == AlphaMode::Mask) text += ", masked";
  if (material.double_sided) text += ", double-sided";
  const std::vector<std::string> extensions = material.extensions.keys();
  return extensions.empty() ? text : text + ", " + fmt::format("{}", fmt::join(extensions, ", "));
}

std::string texture(const TextureInfo& texture) {
  const std::string size = texture.width == 0
                               ? "missing"
                               : fmt::format("{} × {}, {}", texture.width, texture.height,
                                             counted(static_cast<std::size_t>(texture.channels), "channel"));
  return titled(texture.source.empty() ? texture.name : texture.source, size);
}

std::string camera(const Camera& camera) {
  constexpr float kDegrees = 57.2957795F;
  return titled(camera.name, camera.perspective ? fmt::format("perspective, {:.4g}°", camera.fov_y * kDegrees)
                                                : fmt::format("orthographic, height {:.6g}", camera.height));
}

std::string light(const LightSource& light) {
  const char* const kind = light.kind == LightKind::Directional ? "directional"
                           : light.kind == LightKind::Point     ? "point"
                                                                : "spot";
  const char* const unit = light.kind == LightKind::Directional ? "lx" : "cd";
  return titled(light.name, fmt::format("{}, {:.6g} {}", kind, light.intensity, unit));
}

void scene_rows(Table& table, const SceneInfo& scene) {
  std::string nodes = grouped(scene.nodes);
  if (scene.shown_nodes < scene.nodes) nodes += fmt::format(", {} shown", grouped(scene.shown_nodes));
  table.row("nodes", nodes + fmt::format(", {}, {} deep", counted(scene.roots, "root"), grouped(scene.depth)));
  std::string meshes = grouped(scene.meshes);
  if (scene.instances != scene.meshes) {
    meshes += fmt::format(", shown {}: {}", scene.instances == 1 ? "once" : grouped(scene.instances) + " times",
                          counted(scene.shown_triangles, "triangle"));
  }
  table.row("meshes", meshes);
}

void part_rows(Table& table, const SceneInfo& scene) {
  table.list("materials", scene.materials, material);
  table.list("textures", scene.textures, texture);
  table.list("cameras", scene.cameras, camera);
  table.list("lights", scene.lights, light);
  table.list("animations", scene.animations, [](const AnimationInfo& each) {
    return titled(each.name, fmt::format("{:.4g} s, {}", each.seconds, counted(each.channels, "channel")));
  });
  table.list("skins", scene.skins, [](const auto& each) { return titled(each.first, counted(each.second, "joint")); });
}

void volume_rows(Table& table, const VolumeInfo& volume) {
  const auto count = static_cast<std::size_t>(volume.width) * static_cast<std::size_t>(volume.height) *
                     static_cast<std::size_t>(volume.depth);
  table.row("samples", fmt::format("{} × {} × {} = {}", volume.width, volume.height, volume.depth, grouped(count)));
  table.row("values", volume.not_finite == count
                          ? "none is finite"
                          : fmt::format("{:.6g} to {:.6g}, mean {:.6g}", volume.lowest, volume.highest, volume.mean));
  if (volume.not_finite > 0) table.row("not finite", counted(volume.not_finite, "sample") + " with NaN or infinity");
  table.row("spacing", vector(volume.spacing));
  table.row("origin", vector(volume.origin));
}

void drawing_rows(Table& table, const DrawingInfo& drawing) {
  table.row("page", fmt::format("{:.6g} × {:.6g} {}", drawing.width, drawing.height, to_string(drawing.unit)));
  std::string paths = grouped(drawing.paths);
  if (drawing.shown_paths < drawing.paths) paths += fmt::format(", {} shown", grouped(drawing.shown_paths));
  table.row("paths",
            paths + fmt::format(", {}, {}", counted(drawing.segments, "segment"), counted(drawing.curves, "curve")));
  if (drawing.not_finite_points > 0)
    table.row("not finite", counted(drawing.not_finite_points, "point") + " with NaN or infinity");
  table.row("groups", grouped(drawing.groups) + fmt::format(", {} deep", grouped(drawing.depth)));
  table.row("styles", grouped(drawing.styles));
  if (drawing.gradients > 0) table.row("gradients", grouped(drawing.gradients));
  if (drawing.other_patterns > 0) table.row("patterns", grouped(drawing.other_patterns));
  if (drawing.clips > 0) table.row("clips", grouped(drawing.clips));
  if (drawing.texts > 0) table.row("texts", grouped(drawing.texts));
}

std::string unit(float metres) {
  static constexpr std::pair<float, const char*> kUnits[] = {{1.0F, "metre"},       {1e-2F, "centimetre"},
                                                             {1e-3F, "millimetre"}, {1e-6F, "micrometre"},
                                                             {0.0254F, "inch"},     {0.3048F, "foot"}};
  for (const auto& [value, name] : kUnits) {
    if (metres == value) return name;
  }
  return metres > 0 ? fmt::format("{:.6g} m", metres) : "unknown";
}

}  // namespace

std::string to_text(const ModelInfo& info) {
  Table table;
  if (!info.name.empty()) table.row("name", quoted(info.name));
  if (info.scene) scene_rows(table, *info.scene);
  if (info.mesh) mesh_rows(table, info);
  if (info.volume) volume_rows(table, *info.volume);
  if (info.drawing) drawing_rows(table, *info.drawing);
  if (info.bounds.empty()) {
    table.row("bounds", "none: nothing is shown");
  } else {
    table.row("bounds", fmt::format("({}) to ({}){}", vector(info.bounds.lower), vector(info.bounds.upper),
                                    info.bounds_exact ? "" : ", at most"));
    const glm::vec3 size = info.bounds.size();
    table.row("size", fmt::format("{:.6g} × {:.6g} × {:.6g}", size.x, size.y, size.z));
  }
  if (!info.drawing) table.row("unit", unit(info.metres_per_unit));
  if (info.up) table.row("up", to_string(*info.up));
  if (info.scene) part_rows(table, *info.scene);
  return std::move(table).text();
}

}  // namespace azulejo
