#include "azulejo/io/obj_write.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <functional>
#include <numeric>
#include <set>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "azulejo/core/parallel.h"
#include "azulejo/io/mtl_write.h"
#include "azulejo/math/transfer.h"

namespace azulejo {
namespace {

constexpr std::size_t kLinesAtOnce = 8192;
constexpr std::size_t kTextsAtOnce = 64;

void put(std::string& text, float value) {
  char digits[32];
  text.append(digits, std::to_chars(std::begin(digits), std::end(digits), value).ptr);
}

void put(std::string& text, std::size_t value) {
  char digits[24];
  text.append(digits, std::to_chars(std::begin(digits), std::end(digits), value).ptr);
}

/// Writes the lines of `count` elements: made on all threads, written in order.
void write_lines(Output& output, std::size_t count, const Run& run,
                 const std::function<void(std::size_t element, std::string& text)>& add_line) {
  std::vector<std::string> texts(kTextsAtOnce);
  for (std::size_t first = 0; first < count; first += kLinesAtOnce * kTextsAtOnce) {
    const std::size_t tasks = std::min(kTextsAtOnce, (count - first + kLinesAtOnce - 1) / kLinesAtOnce);
    parallel_tasks(tasks, run, [&](std::size_t task, int) {
      texts[task].clear();
      const std::size_t begin = first + task * kLinesAtOnce;
      for (std::size_t i = begin; i < std::min(begin + kLinesAtOnce, count); ++i) add_line(i, texts[task]);
    });
    for (std::size_t task = 0; task < tasks; ++task) output.write(std::as_bytes(std::span(texts[task])));
  }
}

/// Values of an attribute as a list without repetition, and which of them each corner has.
struct Listed {
  std::vector<std::size_t> elements;  ///< of the attribute, whose values the list has
  Array<std::uint32_t> of_corner;     ///< empty: there is no such attribute
};

Listed listed(const Mesh& mesh, const Attribute* attribute, const Run& run) {
  Listed result;
  if (attribute == nullptr) return result;
  const std::size_t count = attribute->size();
  result.elements.resize(count);
  std::iota(result.elements.begin(), result.elements.end(), std::size_t{0});
  if (attribute->domain == Domain::Vertex) {
    result.of_corner.assign(mesh.corners.begin(), mesh.corners.end());
    return result;
  }
  const auto size = static_cast<std::size_t>(attribute->components) * sizeof(float);
  const auto* const values = reinterpret_cast<const std::byte*>(attribute->get<float>()->data());
  const auto compare = [&](std::size_t a, std::size_t b) {
    return std::memcmp(values + a * size, values + b * size, size);
  };
  std::vector<std::size_t> order = result.elements;
  parallel_sort(order.begin(), order.end(), run, [&](std::size_t a, std::size_t b) { return compare(a, b) < 0; });
  // The first of equal ones stands for them; the list keeps the order of the corners.
  std::vector<std::size_t> stands_for(count);
  for (std::size_t i = 0; i < count; ++i) {
    const bool same = i > 0 && compare(order[i - 1], order[i]) == 0;
    stands_for[order[i]] = same ? stands_for[order[i - 1]] : order[i];
  }
  result.elements.clear();
  result.of_corner.resize(count);
  for (std::size_t c = 0; c < count; ++c) {
    if (stands_for[c] == c) {
      result.of_corner[c] = static_cast<std::uint32_t>(result.elements.size());
      result.elements.push_back(c);
    } else {
      result.of_corner[c] = result.of_corner[stands_for[c]];
    }
  }
  return result;
}

/// An attribute that can be written: floats of enough components, on vertices or corners.
const Attribute* float_attribute(const Mesh& mesh, const char* name, int components) {
  const Attribute* const found = mesh.find(name);
  const bool fits = found != nullptr && found->get<float>() != nullptr && found->components >= components &&
                    found->domain != Domain::Face;
  return fits ? found : nullptr;
}

const Attribute* color_attribute(const Mesh& mesh) {
  const Attribute* const found = mesh.find("COLOR_0");
  const bool fits = found != nullptr && found->get<std::uint32_t>() == nullptr && found->components >= 3 &&
                    found->domain == Domain::Vertex;
  return fits ? found : nullptr;
}

/// sRGB, 0–1.
glm::vec3 color_of(const Attribute& attribute, std::size_t vertex) {
  const std::size_t at = vertex * static_cast<std::size_t>(attribute.components);
  glm::vec3 result;
  for (int c = 0; c < 3; ++c) {
    const std::size_t i = at + static_cast<std::size_t>(c);
    const auto* const floats = attribute.get<float>();
    const float value = floats != nullptr ? linear_to_srgb((*floats)[i])
                                          : static_cast<float>((*attribute.get<std::uint8_t>())[i]) / 255.0F;
    result[c] = std::clamp(value, 0.0F, 1.0F);
  }
  return result;
}

class ObjWriter {
 public:
  ObjWriter(Output& output, const Scene& scene, std::vector<std::string> materials, const Run& run)
      : output_(output), scene_(scene), materials_(std::move(materials)), run_(run) {}

  void line(std::string text) {
    text += '\n';
    output_.write(std::as_bytes(std::span(text)));
  }
  void object(const Mesh& mesh, const glm::mat4& world, bool among_others);
  void warn_of_what_is_left_out() const;

 private:
  void vertices(const Mesh& mesh, const glm::mat4& world);
  void texcoords(const Attribute& attribute, const std::vector<std::size_t>& elements);
  void normals(const Attribute& attribute, const std::vector<std::size_t>& elements, const glm::mat4& world);
  void faces(const Mesh& mesh, const Listed& texcoords, const Listed& normals, bool reversed);
  void states(const Mesh& mesh, const Array<std::uint32_t>* smoothing, std::size_t face, std::string& text) const;
  void note(const Mesh& mesh);

  Output& output_;
  const Scene& scene_;
  std::vector<std::string> materials_;
  const Run& run_;
  std::size_t vertices_ = 0;  ///< written so far
  std::size_t texcoords_ = 0;
  std::size_t normals_ = 0;
  bool had_material_ = false;
  bool had_smoothing_ = false;
  std::set<std::string> left_out_;
};

void ObjWriter::vertices(const Mesh& mesh, const glm::mat4& world) {
  const bool moved = world != glm::mat4(1.0F);
  const Attribute* const colors = color_attribute(mesh);
  write_lines(output_, mesh.vertex_count(), run_, [&](std::size_t v, std::string& text) {
    const glm::vec3 at = moved ? glm::vec3(world * glm::vec4(mesh.positions[v], 1.0F)) : mesh.positions[v];
    text += 'v';
    for (int c = 0; c < 3; ++c) put(text += ' ', at[c]);
    if (colors != nullptr) {
      const glm::vec3 color = color_of(*colors, v);
      for (int c = 0; c < 3; ++c) put(text += ' ', color[c]);
    }
    text += '\n';
  });
}

void ObjWriter::texcoords(const Attribute& attribute, const std::vector<std::size_t>& elements) {
  const auto& values = *attribute.get<float>();
  write_lines(output_, elements.size(), run_, [&](std::size_t i, std::string& text) {
    const std::size_t at = elements[i] * static_cast<std::size_t>(attribute.components);
    put(text += "vt ", values[at]);
    put(text += ' ', 1.0F - values[at + 1]);
    text += '\n';
  });
}

void ObjWriter::normals(const Attribute& attribute, const std::vector<std::size_t>& elements, const glm::mat4& world) {
  const auto& values = *attribute.get<float>();
  const bool moved = world != glm::mat4(1.0F);
  // Cofactors turn normals even where the matrix has no inverse.
  const glm::mat3 linear(world);
  const glm::mat3 turned(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                         glm::cross(linear[0], linear[1]));
  const float side = glm::determinant(linear) < 0 ? -1.0F : 1.0F;
  write_lines(output_, elements.size(), run_, [&](std::size_t i, std::string& text) {
    const std::size_t at = elements[i] * static_cast<std::size_t>(attribute.components);
    glm::vec3 normal(values[at], values[at + 1], values[at + 2]);
    if (moved) {
      normal = side * (turned * normal);
      const float length = glm::length(normal);
      if (length > 0) normal /= length;
    }
    text += "vn";
    for (int c = 0; c < 3; ++c) put(text += ' ', normal[c]);
    text += '\n';
  });
}

/// Lines that stand before a face that differs from the one before it.
void ObjWriter::states(const Mesh& mesh, const Array<std::uint32_t>* smoothing, std::size_t face,
                       std::string& text) const {
  if (!mesh.material.empty() || had_material_) {
    const auto of = [&](std::size_t f) { return mesh.material.empty() ? MaterialId::kNone : mesh.material[f]; };
    if (face == 0 || of(face) != of(face - 1)) {
      text += "usemtl";
      if (of(face) != MaterialId::kNone) text += " " + materials_[of(face)];
      text += '\n';
    }
  }
  if (smoothing != nullptr || had_smoothing_) {
    const auto of = [&](std::size_t f) { return smoothing == nullptr ? 0U : (*smoothing)[f]; };
    if (face == 0 || of(face) != of(face - 1)) {
      put(text += "s ", std::size_t{of(face)});
      text += '\n';
    }
  }
}

void ObjWriter::faces(const Mesh& mesh, const Listed& texcoords, const Listed& normals, bool reversed) {
  const Attribute* const groups = mesh.find("SMOOTHING_GROUP");
  const auto* const smoothing =
      groups != nullptr && groups->domain == Domain::Face ? groups->get<std::uint32_t>() : nullptr;
  const auto put_corner = [&](std::size_t corner, std::string& text) {
    put(text += ' ', vertices_ + mesh.corners[corner] + 1);
    if (!texcoords.of_corner.empty()) put(text += '/', texcoords_ + texcoords.of_corner[corner] + 1);
    if (normals.of_corner.empty()) return;
    put(text += texcoords.of_corner.empty() ? "//" : "/", normals_ + normals.of_corner[corner] + 1);
  };
  write_lines(output_, mesh.face_count(), run_, [&](std::size_t face, std::string& text) {
    states(mesh, smoothing, face, text);
    text += 'f';
    const std::size_t begin = mesh.face_begin(face);
    const std::size_t size = mesh.face_end(face) - begin;
    for (std::size_t i = 0; i < size; ++i) put_corner(begin + (reversed ? size - 1 - i : i), text);
    text += '\n';
  });
  had_material_ = had_material_ || !mesh.material.empty();
  had_smoothing_ = had_smoothing_ || smoothing != nullptr;
}

/// What of a mesh isn't written.
void ObjWriter::note(const Mesh& mesh) {
  for (const Attribute& each : mesh.attributes) {
    const bool written = &each == float_attribute(mesh, "TEXCOORD_0", 2) ||
                         &each == float_attribute(mesh, "NORMAL", 3) || each.name == "SMOOTHING_GROUP" ||
                         (&each == color_attribute(mesh) && each.components == 3);
    if (!written) left_out_.insert(each.name);
  }
  if (!mesh.morph_targets.empty()) left_out_.insert("morph targets");
}

void ObjWriter::object(const Mesh& mesh, const glm::mat4& world, bool among_others) {
  note(mesh);
  const bool reversed = glm::determinant(glm::mat3(world)) < 0;
  vertices(mesh, world);
  const Attribute* const uv = float_attribute(mesh, "TEXCOORD_0", 2);
  const Attribute* const normal = float_attribute(mesh, "NORMAL", 3);
  const Listed uv_list = listed(mesh, uv, run_);
  const Listed normal_list = listed(mesh, normal, run_);
  if (uv != nullptr) texcoords(*uv, uv_list.elements);
  if (normal != nullptr) normals(*normal, normal_list.elements, world);
  faces(mesh, uv_list, normal_list, reversed);
  write_lines(output_, mesh.lines.size() / 2, run_, [&](std::size_t i, std::string& text) {
    put(text += "l ", vertices_ + mesh.lines[2 * i] + 1);
    put(text += ' ', vertices_ + mesh.lines[2 * i + 1] + 1);
    text += '\n';
  });
  if (among_others && mesh.corners.empty() && mesh.lines.empty()) {
    // Else it would have nothing that is its own.
    write_lines(output_, mesh.vertex_count(), run_, [&](std::size_t v, std::string& text) {
      put(text += "p ", vertices_ + v + 1);
      text += '\n';
    });
  }
  vertices_ += mesh.vertex_count();
  texcoords_ += uv_list.elements.size();
  normals_ += normal_list.elements.size();
}

void ObjWriter::warn_of_what_is_left_out() const {
  std::set<std::string> names = left_out_;
  if (!scene_.lights.empty()) names.insert("lights");
  if (!scene_.cameras.empty()) names.insert("cameras");
  if (!scene_.animations.empty()) names.insert("animations");
  if (!scene_.skins.empty()) names.insert("skins");
  if (!names.empty()) warn(run_, fmt::format("{}: OBJ has no place for {}", output_.name(), fmt::join(names, ", ")));
}

}  // namespace

void write_obj(Output& output, const Scene& scene, const std::string& folder, const std::string& stem,
               const ModelWriteOptions&, const Run& run) {
  std::vector<std::pair<const Node*, glm::mat4>> shown;
  for (const PlacedNode& placed : walk(scene)) {
    const Node& node = scene.nodes[placed.node.index];
    if (placed.visible && node.mesh) shown.emplace_back(&node, placed.world_from_node);
  }
  std::vector<std::string> materials = mtl_names(scene);
  std::string library;
  if (!materials.empty() && !folder.empty()) library = write_mtl(scene, materials, {folder, stem}, run);
  if (!materials.empty() && folder.empty()) {
    warn(run, fmt::format("{}: materials and textures are left out: there is no folder for them", output.name()));
  }
  ObjWriter writer(output, scene, std::move(materials), run);
  if (!library.empty()) writer.line("mtllib " + library);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const Mesh& mesh = *scene.meshes[shown[i].first->mesh.index];
    const std::string& name = shown[i].first->name.empty() ? mesh.name : shown[i].first->name;
    if (shown.size() > 1 || !name.empty()) writer.line("o " + plain_name(name, fmt::format("mesh{}", i)));
    writer.object(mesh, shown[i].second, shown.size() > 1);
  }
  writer.warn_of_what_is_left_out();
}

}  // namespace azulejo
