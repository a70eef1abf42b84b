#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>
#include <unordered_map>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/io/gltf_output.h"
#include "azulejo/math/transfer.h"

namespace azulejo {
namespace {

bool is_color(const Attribute& attribute) {
  return attribute.name.starts_with("COLOR_") && attribute.components >= 3 && attribute.get<std::uint32_t>() == nullptr;
}

/// Whether glTF's name is kept: it is only for values of the kind that glTF has under it.
bool is_standard(const Attribute& attribute) {
  const std::string_view name = attribute.name;
  const bool floats = attribute.get<float>() != nullptr;
  if (name == "NORMAL") return floats && attribute.components == 3;
  if (name == "TANGENT" || name.starts_with("WEIGHTS_")) return floats && attribute.components == 4;
  if (name.starts_with("TEXCOORD_")) return floats && attribute.components == 2;
  if (name.starts_with("JOINTS_")) return attribute.get<std::uint32_t>() != nullptr && attribute.components == 4;
  return is_color(attribute);
}

/// Which source each written vertex has: its vertex, and, where corners have values of their own, its corner.
struct Vertices {
  static constexpr std::uint32_t kNoCorner = 0xFFFFFFFF;
  std::vector<std::uint32_t> vertex;     ///< empty: each its own
  std::vector<std::uint32_t> corner;     ///< or kNoCorner
  std::vector<std::uint32_t> at_corner;  ///< the written vertex of each corner; empty: that of `corners`
};

std::span<const std::byte> bytes_of(const Attribute& attribute) {
  return std::visit([](const auto& values) { return std::as_bytes(std::span(values)); }, attribute.values);
}

std::size_t element_size(const Attribute& attribute) {
  return static_cast<std::size_t>(attribute.components) * (attribute.get<std::uint8_t>() != nullptr ? 1 : 4);
}

class MeshWriter {
 public:
  MeshWriter(GltfOutput& output, const Mesh& mesh) : output_(output), mesh_(mesh) {}

  GltfObject write();

 private:
  void split_vertices();
  std::uint32_t vertex_at(std::size_t corner) const {
    return vertices_.at_corner.empty() ? mesh_.corners[corner] : vertices_.at_corner[corner];
  }
  std::size_t vertex_count() const { return vertices_.vertex.empty() ? mesh_.vertex_count() : vertices_.vertex.size(); }
  std::size_t write_points(const Array<glm::vec3>& points);
  void write_attributes();
  template <class T>
  Array<T> gathered(const Attribute& attribute, const Array<T>& values) const;
  std::size_t write_attribute(const Attribute& attribute);
  std::size_t write_integers(const Attribute& attribute, const Array<std::uint32_t>& values);
  template <class T>
  std::size_t write_small(const Array<std::uint32_t>& values, std::size_t components);
  void write_targets(GltfObject& result);
  std::size_t write_indices(const Array<std::uint32_t>& indices);
  GltfObject primitive() const;
  void write_faces(GltfObject& primitives);

  GltfOutput& output_;
  const Mesh& mesh_;
  Vertices vertices_;
  GltfObject attributes_;
  GltfObject targets_ = GltfObject::array();
};

GltfObject MeshWriter::write() {
  GltfObject result;
  if (!mesh_.name.empty()) result["name"] = mesh_.name;
  split_vertices();
  attributes_["POSITION"] = write_points(mesh_.positions);
  write_attributes();
  write_targets(result);
  GltfObject primitives = GltfObject::array();
  write_faces(primitives);
  if (!mesh_.lines.empty()) {
    GltfObject lines = primitive();
    lines["mode"] = 1;
    lines["indices"] = write_indices(mesh_.lines);
    primitives.push_back(std::move(lines));
  }
  if (primitives.empty()) {
    GltfObject points = primitive();
    points["mode"] = 0;
    primitives.push_back(std::move(points));
  }
  result["primitives"] = std::move(primitives);
  return result;
}

/// Gives corners of one vertex that differ in a value of their own a vertex each. The first such keeps the vertex's
/// number, so lines stay right; the others come behind all vertices.
void MeshWriter::split_vertices() {
  std::vector<const Attribute*> differing;
  std::size_t size = sizeof(std::uint32_t);
  for (const Attribute& attribute : mesh_.attributes) {
    if (attribute.domain != Domain::Corner) continue;
    differing.push_back(&attribute);
    size += element_size(attribute);
  }
  if (differing.empty()) return;
  const std::size_t corners = mesh_.corner_count();
  std::vector<std::byte> keys(corners * size);
  for (std::size_t c = 0; c < corners; ++c) {
    std::byte* place = keys.data() + c * size;
    std::memcpy(place, &mesh_.corners[c], sizeof(std::uint32_t));
    place += sizeof(std::uint32_t);
    for (const Attribute* attribute : differing) {
      const std::size_t each = element_size(*attribute);
      std::memcpy(place, bytes_of(*attribute).data() + c * each, each);
      place += each;
    }
  }
  vertices_.vertex.resize(mesh_.vertex_count());
  for (std::size_t v = 0; v < vertices_.vertex.size(); ++v) vertices_.vertex[v] = static_cast<std::uint32_t>(v);
  vertices_.corner.assign(mesh_.vertex_count(), Vertices::kNoCorner);
  vertices_.at_corner.resize(corners);
  std::unordered_map<std::string_view, std::uint32_t> known;
  known.reserve(mesh_.vertex_count());
  for (std::size_t c = 0; c < corners; ++c) {
    const std::string_view key(reinterpret_cast<const char*>(keys.data()) + c * size, size);
    const std::uint32_t vertex = mesh_.corners[c];
    const bool first = vertices_.corner[vertex] == Vertices::kNoCorner;
    const std::uint32_t next = first ? vertex : static_cast<std::uint32_t>(vertices_.vertex.size());
    const auto [found, is_new] = known.try_emplace(key, next);
    vertices_.at_corner[c] = found->second;
    if (!is_new) continue;
    if (first) {
      vertices_.corner[vertex] = static_cast<std::uint32_t>(c);
    } else {
      vertices_.vertex.push_back(vertex);
      vertices_.corner.push_back(static_cast<std::uint32_t>(c));
    }
  }
}

std::size_t MeshWriter::write_points(const Array<glm::vec3>& points) {
  Array<glm::vec3> moved;
  if (!vertices_.vertex.empty()) {
    moved.resize(vertex_count());
    for (std::size_t v = 0; v < moved.size(); ++v) moved[v] = points[vertices_.vertex[v]];
  }
  const Array<glm::vec3>& all = vertices_.vertex.empty() ? points : moved;
  return output_.add_floats({reinterpret_cast<const float*>(all.data()), all.size() * 3}, 3, true,
                            GltfOutput::kVertices);
}

/// The values of each written vertex; 0 where a vertex has no corner that could have one.
template <class T>
Array<T> MeshWriter::gathered(const Attribute& attribute, const Array<T>& values) const {
  const auto components = static_cast<std::size_t>(attribute.components);
  Array<T> result(vertex_count() * components);
  for (std::size_t v = 0; v < vertex_count(); ++v) {
    std::size_t source = v;
    if (!vertices_.vertex.empty()) {
      source = attribute.domain == Domain::Corner ? vertices_.corner[v] : vertices_.vertex[v];
    }
    for (std::size_t c = 0; c < components; ++c) {
      result[v * components + c] = source == Vertices::kNoCorner ? T{0} : values[source * components + c];
    }
  }
  return result;
}

void MeshWriter::write_attributes() {
  for (const Attribute& attribute : mesh_.attributes) {
    if (attribute.domain == Domain::Face) {
      output_.warn(fmt::format("{} of faces is left out: glTF has values of vertices only", attribute.name));
      continue;
    }
    std::string name = attribute.name;
    if (!is_standard(attribute) && !name.starts_with('_')) name = fmt::format("_{}", name);
    if (attributes_.contains(name)) {
      output_.warn(fmt::format("a second {} is left out", name));
      continue;
    }
    attributes_[name] = write_attribute(attribute);
  }
}

std::size_t MeshWriter::write_attribute(const Attribute& attribute) {
  const auto components = static_cast<std::size_t>(attribute.components);
  if (const auto* const integers = attribute.get<std::uint32_t>()) {
    return write_integers(attribute, gathered(attribute, *integers));
  }
  if (const auto* const floats = attribute.get<float>()) {
    return output_.add_floats(gathered(attribute, *floats), components, false, GltfOutput::kVertices);
  }
  const Array<std::uint8_t> bytes = gathered(attribute, *attribute.get<std::uint8_t>());
  if (!is_color(attribute)) {
    return write_small<std::uint8_t>(Array<std::uint32_t>(bytes.begin(), bytes.end()), components);
  }
  Array<float> linear(bytes.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const bool alpha = i % components == 3;
    linear[i] = alpha ? static_cast<float>(bytes[i]) / 255.0F : srgb_to_linear(static_cast<float>(bytes[i]) / 255.0F);
  }
  return output_.add_floats(linear, components, false, GltfOutput::kVertices);
}

/// Vertices can't have integers of 32 bits in glTF: those above 16 are written as floats.
std::size_t MeshWriter::write_integers(const Attribute& attribute, const Array<std::uint32_t>& values) {
  const auto components = static_cast<std::size_t>(attribute.components);
  const auto largest = std::max_element(values.begin(), values.end());
  const std::uint32_t most = largest == values.end() ? 0 : *largest;
  const bool joints = is_standard(attribute);
  if (joints && most <= 0xFF) return write_small<std::uint8_t>(values, components);
  if (most <= 0xFFFF) return write_small<std::uint16_t>(values, components);
  if (joints) throw output_.error(Error::Data, fmt::format("joint {}, glTF counts them in 16 bits", most));
  if (most > (1U << 24)) {
    output_.warn(
        fmt::format("{} has integers up to {}, written as floats that can't hold them all", attribute.name, most));
  }
  Array<float> floats(values.size());
  std::transform(values.begin(), values.end(), floats.begin(),
                 [](std::uint32_t each) { return static_cast<float>(each); });
  return output_.add_floats(floats, components, false, GltfOutput::kVertices);
}

/// Elements begin at multiples of 4 bytes.
template <class T>
std::size_t MeshWriter::write_small(const Array<std::uint32_t>& values, std::size_t components) {
  static constexpr std::array<const char*, 5> kTypes = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
  const std::size_t count = values.size() / components;
  const std::size_t stride = (components * sizeof(T) + 3) / 4 * 4;
  std::vector<std::byte> bytes(count * stride);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const T value = static_cast<T>(values[i]);
    std::memcpy(bytes.data() + i / components * stride + i % components * sizeof(T), &value, sizeof(T));
  }
  return output_.add_accessor(bytes, sizeof(T) == 1 ? 5121 : 5123, kTypes[components], count, GltfOutput::kVertices,
                              stride);
}

void MeshWriter::write_targets(GltfObject& result) {
  GltfObject names = GltfObject::array();
  bool named = false;
  for (const MorphTarget& target : mesh_.morph_targets) {
    GltfObject each;
    if (!target.normals.empty()) each["NORMAL"] = write_points(target.normals);
    if (!target.positions.empty()) each["POSITION"] = write_points(target.positions);
    // A target must have something.
    if (each.empty()) each["POSITION"] = write_points(Array<glm::vec3>(mesh_.vertex_count(), glm::vec3(0.0F)));
    targets_.push_back(std::move(each));
    names.push_back(target.name);
    named = named || !target.name.empty();
  }
  if (named) result["extras"] = {{"targetNames", std::move(names)}};
}

std::size_t MeshWriter::write_indices(const Array<std::uint32_t>& indices) {
  // The largest number of a type is no index in glTF.
  if (vertex_count() > 0xFFFF) {
    return output_.add_accessor(std::as_bytes(std::span(indices)), 5125, "SCALAR", indices.size(),
                                GltfOutput::kIndices);
  }
  Array<std::uint16_t> small(indices.size());
  std::transform(indices.begin(), indices.end(), small.begin(),
                 [](std::uint32_t each) { return static_cast<std::uint16_t>(each); });
  return output_.add_accessor(std::as_bytes(std::span(small)), 5123, "SCALAR", small.size(), GltfOutput::kIndices);
}

GltfObject MeshWriter::primitive() const {
  GltfObject result = {{"attributes", attributes_}};
  if (!targets_.empty()) result["targets"] = targets_;
  return result;
}

/// One primitive a material, in the order in which materials first appear; faces keep their order within.
void MeshWriter::write_faces(GltfObject& primitives) {
  std::vector<std::uint32_t> materials;
  std::unordered_map<std::uint32_t, std::size_t> slots;
  std::vector<Array<std::uint32_t>> indices;
  std::size_t slot = 0;
  for (std::size_t face = 0; face < mesh_.face_count(); ++face) {
    const std::uint32_t material = mesh_.material.empty() ? MaterialId::kNone : mesh_.material[face];
    if (materials.empty() || materials[slot] != material) {
      slot = slots.try_emplace(material, materials.size()).first->second;
      if (slot == materials.size()) {
        materials.push_back(material);
        indices.emplace_back();
      }
    }
    const std::size_t begin = mesh_.face_begin(face);
    for (std::size_t corner = begin + 2; corner < mesh_.face_end(face); ++corner) {
      for (const std::size_t each : {begin, corner - 1, corner}) indices[slot].push_back(vertex_at(each));
    }
  }
  for (std::size_t m = 0; m < materials.size(); ++m) {
    if (indices[m].empty()) continue;
    GltfObject faces = primitive();
    faces["indices"] = write_indices(indices[m]);
    if (materials[m] != MaterialId::kNone) faces["material"] = materials[m];
    primitives.push_back(std::move(faces));
  }
}

}  // namespace

GltfObject write_gltf_mesh(GltfOutput& output, const Mesh& mesh) { return MeshWriter(output, mesh).write(); }

}  // namespace azulejo
