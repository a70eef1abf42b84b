#include <algorithm>
#include <array>
#include <string_view>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "azulejo/io/gltf_parts.h"

namespace azulejo {
namespace {

using Component = GltfAccessor::Component;

enum class ValueType { F32, U32, U8 };

/// What an attribute is kept as.
struct Kind {
  ValueType type = ValueType::F32;
  int components = 1;
};

/// Primitives that name the very same accessors have their vertices once.
struct VertexSet {
  GltfValue attributes;
  GltfValue targets;
  std::size_t first = 0;
  std::size_t count = 0;
};

struct Primitive {
  GltfValue value;
  std::size_t vertices = 0;  ///< a VertexSet
};

bool one_of(int components, std::initializer_list<int> wanted) {
  return std::find(wanted.begin(), wanted.end(), components) != wanted.end();
}

/// Throws where the specification has no such accessor for an attribute of this name; integers are let through where
/// KHR_mesh_quantization lets them.
Kind kind_of(std::string_view name, const GltfAccessor& accessor, const GltfValue& place) {
  const auto expect = [&](std::initializer_list<int> components, bool integers) {
    if (!one_of(accessor.components, components) || accessor.matrix) {
      throw place.error(fmt::format("{} components, expected {}", accessor.components, *components.begin()));
    }
    const bool unsigned_integers = accessor.component == Component::U8 || accessor.component == Component::U16 ||
                                   accessor.component == Component::U32;
    if (integers ? !unsigned_integers || accessor.normalized : accessor.component == Component::U32) {
      throw place.error(fmt::format("componentType {} for {}", accessor.component, printable(name)));
    }
  };
  if (name == "NORMAL") {
    expect({3}, false);
  } else if (name == "TANGENT" || name.starts_with("WEIGHTS_")) {
    expect({4}, false);
  } else if (name.starts_with("TEXCOORD_")) {
    expect({2}, false);
  } else if (name.starts_with("COLOR_")) {
    expect({4, 3}, false);
  } else if (name.starts_with("JOINTS_")) {
    expect({4}, true);
    return {ValueType::U32, 4};
  } else if (!accessor.normalized && accessor.component == Component::U8) {
    return {ValueType::U8, accessor.components};
  } else if (!accessor.normalized && (accessor.component == Component::U16 || accessor.component == Component::U32)) {
    return {ValueType::U32, accessor.components};
  }
  return {ValueType::F32, accessor.components};
}

/// What a vertex has of an attribute that its primitive doesn't: white, a direction of length 0, nothing. So is the
/// fourth component where others have three.
float missing_value(std::string_view name, int component) {
  if (name.starts_with("COLOR_")) return 1.0F;
  return name == "TANGENT" && component == 3 ? 1.0F : 0.0F;
}

std::span<float> floats_of(Array<glm::vec3>& points, std::size_t first, std::size_t count) {
  static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
  return {reinterpret_cast<float*>(points.data() + first), count};
}

class MeshReader {
 public:
  MeshReader(GltfFile& file, GltfAccessors& accessors, std::size_t materials)
      : file_(file), accessors_(accessors), materials_(materials) {}

  Mesh read(const GltfValue& value, std::size_t index);

 private:
  void collect(const GltfValue& primitives);
  void check_packed(const GltfValue& primitive) const;
  void read_positions();
  void list_attributes();
  void read_attribute(Attribute& attribute);
  template <class T>
  void read_values(const Attribute& attribute, Array<T>& values);
  void read_elements(const Primitive& primitive);
  Array<std::uint32_t> vertices_of(const Primitive& primitive);
  void read_targets(const GltfValue& value);
  void read_target(MorphTarget& target, std::size_t index);
  void read_deltas(const GltfValue& accessor_index, const VertexSet& set, Array<glm::vec3>& deltas);

  GltfFile& file_;
  GltfAccessors& accessors_;
  std::size_t materials_;
  Mesh mesh_;
  std::size_t index_ = 0;
  std::vector<Primitive> primitives_;
  std::vector<VertexSet> sets_;
};

Mesh MeshReader::read(const GltfValue& value, std::size_t index) {
  index_ = index;
  mesh_.name = value["name"].text();
  mesh_.space = {UpAxis::Y, 1.0F};
  collect(value.need("primitives"));
  read_positions();
  list_attributes();
  for (Attribute& attribute : mesh_.attributes) read_attribute(attribute);
  for (const Primitive& primitive : primitives_) read_elements(primitive);
  const auto& material = mesh_.material;
  if (std::all_of(material.begin(), material.end(), [](std::uint32_t each) { return each == MaterialId::kNone; })) {
    mesh_.material.clear();
  }
  read_targets(value);
  return std::move(mesh_);
}

void MeshReader::check_packed(const GltfValue& primitive) const {
  if (!primitive["extensions"]["KHR_draco_mesh_compression"]) return;
  const auto expect_plain = [&](const GltfValue& accessor) {
    if (accessor && accessors_.at(accessor).view == GltfAccessor::kNoView) {
      throw primitive.error(Error::Unsupported, "KHR_draco_mesh_compression isn't read");
    }
  };
  for (const auto& [name, accessor] : primitive["attributes"].members()) expect_plain(accessor);
  expect_plain(primitive["indices"]);
}

void MeshReader::collect(const GltfValue& primitives) {
  std::unordered_map<std::string, std::size_t> known;
  std::size_t vertices = 0;
  for (std::size_t p = 0; p < primitives.size(); ++p) {
    const GltfValue value = primitives.at(p);
    check_packed(value);
    const GltfValue attributes = value.need("attributes");
    const GltfValue position = attributes["POSITION"];
    if (value["material"]) value["material"].index(materials_);
    if (value["indices"]) accessors_.at(value["indices"], 1);
    if (!position) {
      file_.warn(fmt::format("mesh {}: primitive {} has no positions and is left out", index_, p));
      continue;
    }
    const GltfValue targets = value["targets"];
    const auto [found, is_new] =
        known.try_emplace(attributes.dump() + (targets ? targets.dump() : std::string()), sets_.size());
    if (is_new) {
      const std::size_t count = accessors_.at(position, 3).count;
      sets_.push_back({attributes, targets, vertices, count});
      vertices += count;
    }
    primitives_.push_back({value, found->second});
  }
  if (vertices > 0xFFFFFFFE) throw primitives.error(fmt::format("{} vertices, expected fewer than 2^32 - 1", vertices));
  file_.claim(vertices, sizeof(glm::vec3));
  mesh_.positions.resize(vertices);
}

void MeshReader::read_positions() {
  for (const VertexSet& set : sets_) {
    const GltfValue place = set.attributes["POSITION"];
    const GltfAccessor& accessor = accessors_.at(place, 3);
    if (accessor.component == Component::U32) throw place.error("componentType 5125 for POSITION");
    accessors_.read(accessor, place, floats_of(mesh_.positions, set.first, accessor.values()));
  }
}

/// Finds the attributes of all primitives, each in a form that bears all of them.
void MeshReader::list_attributes() {
  std::unordered_map<std::string_view, std::size_t> known;
  std::vector<Kind> kinds;
  for (const VertexSet& set : sets_) {
    for (const auto& [name, index] : set.attributes.members()) {
      if (name == "POSITION") continue;
      const GltfAccessor& accessor = accessors_.at(index);
      if (accessor.count != set.count) {
        throw index.error(fmt::format("{} elements, POSITION has {}", accessor.count, set.count));
      }
      if (accessor.matrix) {
        file_.warn(fmt::format("mesh {}: attribute {} has matrices and is left out", index_, printable(name)));
        continue;
      }
      const Kind kind = kind_of(name, accessor, index);
      const auto [found, is_new] = known.try_emplace(name, kinds.size());
      if (is_new) {
        kinds.push_back(kind);
        mesh_.attributes.push_back({std::string(name), Domain::Vertex, 1, Array<float>()});
        continue;
      }
      Kind& all = kinds[found->second];
      all.components = std::max(all.components, kind.components);
      if (all.type != kind.type) {
        const bool integers = all.type != ValueType::F32 && kind.type != ValueType::F32;
        all.type = integers ? ValueType::U32 : ValueType::F32;
      }
    }
  }
  for (std::size_t a = 0; a < kinds.size(); ++a) {
    mesh_.attributes[a].components = kinds[a].components;
    if (kinds[a].type == ValueType::U32) mesh_.attributes[a].values = Array<std::uint32_t>();
    if (kinds[a].type == ValueType::U8) mesh_.attributes[a].values = Array<std::uint8_t>();
  }
}

void MeshReader::read_attribute(Attribute& attribute) {
  file_.claim(mesh_.positions.size() * static_cast<std::size_t>(attribute.components), 4);
  std::visit([&](auto& values) { read_values(attribute, values); }, attribute.values);
}

template <class T>
void MeshReader::read_values(const Attribute& attribute, Array<T>& values) {
  const auto components = static_cast<std::size_t>(attribute.components);
  values.resize(mesh_.positions.size() * components);
  for (const VertexSet& set : sets_) {
    const std::span<T> target(values.data() + set.first * components, set.count * components);
    const GltfValue place = set.attributes[attribute.name];
    const GltfAccessor* const accessor = place ? &accessors_.at(place) : nullptr;
    if (accessor != nullptr && accessor->components == attribute.components) {
      accessors_.read(*accessor, place, target);
      continue;
    }
    for (std::size_t i = 0; i < target.size(); ++i) {
      target[i] = static_cast<T>(missing_value(attribute.name, static_cast<int>(i % components)));
    }
    if (accessor == nullptr) continue;
    const auto narrow = static_cast<std::size_t>(accessor->components);
    Array<T> part(accessor->values());
    accessors_.read(*accessor, place, std::span<T>(part));
    for (std::size_t i = 0; i < part.size(); ++i) target[i / narrow * components + i % narrow] = part[i];
  }
}

Array<std::uint32_t> MeshReader::vertices_of(const Primitive& primitive) {
  const VertexSet& set = sets_[primitive.vertices];
  Array<std::uint32_t> vertices;
  const GltfValue place = primitive.value["indices"];
  if (!place) {
    vertices.resize(set.count);
    for (std::size_t i = 0; i < set.count; ++i) vertices[i] = static_cast<std::uint32_t>(i);
    return vertices;
  }
  const GltfAccessor& accessor = accessors_.at(place, 1);
  file_.claim(accessor.count, sizeof(std::uint32_t));
  vertices.resize(accessor.count);
  accessors_.read(accessor, place, std::span<std::uint32_t>(vertices));
  const auto largest = std::max_element(vertices.begin(), vertices.end());
  if (largest != vertices.end() && *largest >= set.count) {
    throw place.error(fmt::format("index {} is {}, of {} vertices", largest - vertices.begin(), *largest, set.count));
  }
  return vertices;
}

void MeshReader::read_elements(const Primitive& primitive) {
  const std::uint64_t mode = primitive.value["mode"].count(4);
  if (mode > 6) throw primitive.value["mode"].error(fmt::format("{}, expected 0 to 6", mode));
  if (mode == 0 && !primitive.value["indices"]) return;
  const Array<std::uint32_t> vertices = vertices_of(primitive);
  const auto first = static_cast<std::uint32_t>(sets_[primitive.vertices].first);
  const std::size_t wanted = mode == 1 ? 2 : mode == 4 ? 3 : 1;
  if (vertices.size() % wanted != 0) {
    file_.warn(fmt::format("mesh {}: {} vertices, expected a multiple of {}: the last are left out", index_,
                           vertices.size(), wanted));
  }
  if (mode == 0) return;
  const bool faces = mode >= 4;
  Array<std::uint32_t>& result = faces ? mesh_.corners : mesh_.lines;
  file_.claim(vertices.size(), 4 * sizeof(std::uint32_t));
  append_gltf_elements(mode, vertices, first, result);
  if (result.size() > 0xFFFFFFFE) {
    throw primitive.value.error(fmt::format("{} corners, expected fewer than 2^32 - 1", result.size()));
  }
  if (!faces) return;
  const GltfValue material = primitive.value["material"];
  mesh_.material.resize(mesh_.corners.size() / 3,
                        material ? static_cast<std::uint32_t>(material.index(materials_)) : MaterialId::kNone);
}

void MeshReader::read_targets(const GltfValue& value) {
  std::size_t count = 0;
  for (const VertexSet& set : sets_) count = std::max(count, set.targets.size());
  file_.claim(count, sizeof(MorphTarget));
  mesh_.morph_targets.resize(count);
  const GltfValue extras = value["extras"];
  // Extras may be anything; an array under this name is what all writers agree on.
  const GltfValue names = extras.is_object() ? extras["targetNames"] : GltfValue();
  for (std::size_t t = 0; t < count; ++t) {
    if (names.is_array() && t < names.size() && names.at(t).is_text()) mesh_.morph_targets[t].name = names.at(t).text();
    read_target(mesh_.morph_targets[t], t);
  }
}

void MeshReader::read_target(MorphTarget& target, std::size_t index) {
  for (const VertexSet& set : sets_) {
    if (index >= set.targets.size()) continue;
    const GltfValue value = set.targets.at(index);
    if (value["POSITION"]) read_deltas(value["POSITION"], set, target.positions);
    if (value["NORMAL"]) read_deltas(value["NORMAL"], set, target.normals);
  }
}

void MeshReader::read_deltas(const GltfValue& accessor_index, const VertexSet& set, Array<glm::vec3>& deltas) {
  const GltfAccessor& accessor = accessors_.at(accessor_index, 3);
  if (accessor.count != set.count) {
    throw accessor_index.error(fmt::format("{} elements, POSITION has {}", accessor.count, set.count));
  }
  if (deltas.empty()) {
    file_.claim(mesh_.positions.size(), sizeof(glm::vec3));
    deltas.resize(mesh_.positions.size(), glm::vec3(0.0F));
  }
  accessors_.read(accessor, accessor_index, floats_of(deltas, set.first, accessor.values()));
}

}  // namespace

void append_gltf_elements(std::uint64_t mode, const Array<std::uint32_t>& vertices, std::uint32_t first,
                          Array<std::uint32_t>& result) {
  const std::size_t count = vertices.size();
  const auto line = [&](std::size_t a, std::size_t b) {
    result.push_back(first + vertices[a]);
    result.push_back(first + vertices[b]);
  };
  const auto triangle = [&](std::size_t a, std::size_t b, std::size_t c) {
    if (vertices[a] == vertices[b] || vertices[b] == vertices[c] || vertices[c] == vertices[a]) return;
    line(a, b);
    result.push_back(first + vertices[c]);
  };
  switch (mode) {
    case 1:
      for (std::size_t i = 0; i + 1 < count; i += 2) line(i, i + 1);
      break;
    case 2:
    case 3:
      for (std::size_t i = 0; i + 1 < count; ++i) line(i, i + 1);
      if (mode == 2 && count > 2) line(count - 1, 0);
      break;
    case 4:
      result.resize(result.size() + count / 3 * 3);
      std::transform(vertices.begin(), vertices.begin() + static_cast<std::ptrdiff_t>(count / 3 * 3),
                     result.end() - static_cast<std::ptrdiff_t>(count / 3 * 3),
                     [&](std::uint32_t vertex) { return first + vertex; });
      break;
    case 5:
      for (std::size_t i = 0; i + 2 < count; ++i) triangle(i, i + 1 + i % 2, i + 2 - i % 2);
      break;
    case 6:
      for (std::size_t i = 1; i + 1 < count; ++i) triangle(i, i + 1, 0);
      break;
    default: break;
  }
}

std::vector<std::shared_ptr<const Mesh>> read_gltf_meshes(GltfFile& file, GltfAccessors& accessors,
                                                          std::size_t materials) {
  const GltfValue list = file.root()["meshes"];
  file.claim(list.size(), sizeof(Mesh) + sizeof(std::shared_ptr<Mesh>));
  std::vector<std::shared_ptr<const Mesh>> meshes;
  meshes.reserve(list.size());
  for (std::size_t m = 0; m < list.size(); ++m) {
    check_cancelled(file.run());
    meshes.push_back(std::make_shared<const Mesh>(MeshReader(file, accessors, materials).read(list.at(m), m)));
  }
  return meshes;
}

}  // namespace azulejo
