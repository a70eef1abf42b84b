#include "azulejo/io/ply_mesh.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"

namespace azulejo {
namespace {

using Names = std::vector<std::string_view>;

/// The places of properties of these names; nothing unless all are there, are scalars and have no sink yet.
std::optional<std::vector<std::size_t>> find_all(const PlyElement& element, const PlyRows& rows, const Names& names) {
  std::vector<std::size_t> places;
  for (const std::string_view name : names) {
    const std::size_t place = element.find(name);
    if (place == element.properties.size() || element.properties[place].is_list) return std::nullopt;
    if (rows.sinks[place].kind != PlySink::Skip) return std::nullopt;
    places.push_back(place);
  }
  return places;
}

/// The same for the first of several groups of names.
std::optional<std::vector<std::size_t>> find_any(const PlyElement& element, const PlyRows& rows,
                                                 const std::vector<Names>& groups) {
  for (const Names& names : groups) {
    if (auto places = find_all(element, rows, names)) return places;
  }
  return std::nullopt;
}

std::size_t find_list(const PlyElement& element, const Names& names) {
  for (const std::string_view name : names) {
    const std::size_t place = element.find(name);
    if (place < element.properties.size() && element.properties[place].is_list) return place;
  }
  return element.properties.size();
}

/// Adds an attribute of undefined values and tells the sinks of its components where to put them.
template <class T>
void add_attribute(Mesh& mesh, const std::string& name, Domain domain, std::size_t count, PlyRows& rows,
                   const std::vector<std::size_t>& places, PlySink::Kind kind) {
  const std::size_t components = places.size();
  Attribute attribute = {name, domain, static_cast<int>(components), Array<T>(count * components)};
  T* const values = std::get<Array<T>>(attribute.values).data();  // stays where it is when the attribute moves
  for (std::size_t i = 0; i < components; ++i) rows.sinks[places[i]] = {kind, values + i, components, false};
  mesh.attributes.push_back(std::move(attribute));
}

/// Whether a name means something of its own to who reads a mesh.
bool is_reserved(std::string_view name) {
  if (name == "NORMAL" || name == "TANGENT") return true;
  const std::size_t number = name.find_last_not_of("0123456789") + 1;
  const std::string_view stem = name.substr(0, number);
  return number < name.size() && (stem == "TEXCOORD_" || stem == "COLOR_" || stem == "JOINTS_" || stem == "WEIGHTS_");
}

/// Lists of all pieces, one behind the other.
template <class T>
Array<T> joined(const std::vector<PlyPiece>& pieces, Array<T> PlyPiece::*part, const Run& run) {
  std::vector<std::size_t> places;
  std::size_t size = 0;
  for (const PlyPiece& piece : pieces) {
    places.push_back(size);
    size += (piece.*part).size();
  }
  Array<T> result(size);
  parallel_tasks(pieces.size(), run, [&](std::size_t i, int) {
    const Array<T>& source = pieces[i].*part;
    std::copy(source.begin(), source.end(), result.data() + places[i]);
  });
  return result;
}

bool all_equal(const Array<std::uint32_t>& values, std::uint32_t wanted) {
  return std::all_of(values.begin(), values.end(), [&](std::uint32_t value) { return value == wanted; });
}

}  // namespace

PlyMesh::PlyMesh(const PlyHeader& header, const std::string& name) : name_(name), rows_(header.elements.size()) {
  bool has_vertices = false;
  bool has_faces = false;
  bool has_edges = false;
  for (std::size_t i = 0; i < header.elements.size(); ++i) {
    const PlyElement& element = header.elements[i];
    rows_[i].element = &element;
    rows_[i].sinks.resize(element.properties.size());
    if (element.name == "vertex" && !std::exchange(has_vertices, true)) {
      plan_vertices(element, rows_[i]);
    } else if (element.name == "face" && !std::exchange(has_faces, true)) {
      plan_faces(element, rows_[i]);
    } else if (element.name == "tristrips" && strips_ == nullptr) {
      const std::size_t indices = find_list(element, {"vertex_indices", "vertex_index"});
      if (indices == element.properties.size()) continue;
      rows_[i].sinks[indices].kind = PlySink::Indices;
      strips_ = &rows_[i];
    } else if (element.name == "edge" && !std::exchange(has_edges, true)) {
      plan_edges(element, rows_[i]);
    }
  }
}

void PlyMesh::plan_vertices(const PlyElement& element, PlyRows& rows) {
  if (element.count == 0) return;
  const auto position = find_all(element, rows, {"x", "y", "z"});
  if (!position) throw Error(Error::Data, fmt::format("{}: element vertex has no properties x, y and z", name_));
  mesh_.positions.resize(static_cast<std::size_t>(element.count));
  for (int axis = 0; axis < 3; ++axis) {
    float* const first = &mesh_.positions[0][axis];
    rows.sinks[(*position)[static_cast<std::size_t>(axis)]] = {PlySink::Float, first, 3, false};
  }
  const std::size_t count = mesh_.positions.size();
  if (const auto normal = find_all(element, rows, {"nx", "ny", "nz"})) {
    add_attribute<float>(mesh_, "NORMAL", Domain::Vertex, count, rows, *normal, PlySink::Float);
  }
  plan_colors(element, Domain::Vertex, rows);
  const std::vector<Names> kTexcoords = {
      {"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}};
  if (const auto texcoord = find_any(element, rows, kTexcoords)) {
    add_attribute<float>(mesh_, "TEXCOORD_0", Domain::Vertex, count, rows, *texcoord, PlySink::Float);
    rows.sinks[(*texcoord)[1]].kind = PlySink::Flipped;
  }
  plan_others(element, Domain::Vertex, rows);
}

void PlyMesh::plan_faces(const PlyElement& element, PlyRows& rows) {
  const std::size_t indices = find_list(element, {"vertex_indices", "vertex_index"});
  if (element.count == 0 || indices == element.properties.size()) return;
  rows.sinks[indices].kind = PlySink::Indices;
  const std::size_t texcoords = find_list(element, {"texcoord"});
  if (texcoords < element.properties.size()) rows.sinks[texcoords].kind = PlySink::Texcoords;
  faces_ = &rows;
  const std::size_t before = mesh_.attributes.size();
  plan_colors(element, Domain::Face, rows);
  plan_others(element, Domain::Face, rows);
  faces_have_attributes_ = mesh_.attributes.size() > before;
}

void PlyMesh::plan_colors(const PlyElement& element, Domain domain, PlyRows& rows) {
  const std::vector<Names> kColors = {{"red", "green", "blue", "alpha"},
                                      {"red", "green", "blue"},
                                      {"diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha"},
                                      {"diffuse_red", "diffuse_green", "diffuse_blue"},
                                      {"r", "g", "b", "a"},
                                      {"r", "g", "b"}};
  const auto color = find_any(element, rows, kColors);
  if (!color) return;
  const PlyType type = element.properties[color->front()].type;
  for (const std::size_t each : *color) {
    if (element.properties[each].type != type) return;  // each under its own name then
  }
  const auto count = static_cast<std::size_t>(element.count);
  if (type == PlyType::F32 || type == PlyType::F64) {
    add_attribute<float>(mesh_, "COLOR_0", domain, count, rows, *color, PlySink::Float);
  } else {
    const PlySink::Kind kind = type == PlyType::U16 ? PlySink::Shade : PlySink::Byte;
    add_attribute<std::uint8_t>(mesh_, "COLOR_0", domain, count, rows, *color, kind);
  }
}

void PlyMesh::plan_edges(const PlyElement& element, PlyRows& rows) {
  const auto ends = find_all(element, rows, {"vertex1", "vertex2"});
  if (!ends) return;
  mesh_.lines.resize(static_cast<std::size_t>(element.count) * 2);
  for (std::size_t i = 0; i < 2; ++i) rows.sinks[(*ends)[i]] = {PlySink::Index, mesh_.lines.data() + i, 2, false};
}

void PlyMesh::plan_others(const PlyElement& element, Domain domain, PlyRows& rows) {
  const auto count = static_cast<std::size_t>(element.count);
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    if (property.is_list || rows.sinks[i].kind != PlySink::Skip || element.find(property.name) != i) continue;
    const std::string name = (is_reserved(property.name) ? "ply_" : "") + property.name;
    if (property.type == PlyType::U8) {
      add_attribute<std::uint8_t>(mesh_, name, domain, count, rows, {i}, PlySink::Byte);
    } else if (property.type == PlyType::U16 || property.type == PlyType::U32) {
      add_attribute<std::uint32_t>(mesh_, name, domain, count, rows, {i}, PlySink::Index);
    } else {
      add_attribute<float>(mesh_, name, domain, count, rows, {i}, PlySink::Float);
      rows.sinks[i].says_loss = true;
    }
  }
}

Mesh PlyMesh::finish(const Run& run) {
  warn_of_losses(run);
  if (faces_ != nullptr) add_faces(run);
  if (strips_ != nullptr) add_strips(run);
  return std::move(mesh_);
}

void PlyMesh::warn_of_losses(const Run& run) const {
  for (const PlyRows& rows : rows_) {
    for (std::size_t i = 0; i < rows.sinks.size(); ++i) {
      const bool lost = std::any_of(rows.pieces.begin(), rows.pieces.end(),
                                    [&](const PlyPiece& piece) { return i < piece.lost.size() && piece.lost[i]; });
      if (!lost) continue;
      const PlyProperty& property = rows.element->properties[i];
      warn(run,
           fmt::format("{}: property {} of element {}: not all values of type {} are kept exactly in 32-bit floats",
                       name_, property.name, rows.element->name, ply_type_name(property.type)));
    }
  }
}

void PlyMesh::add_faces(const Run& run) {
  mesh_.corners = joined(faces_->pieces, &PlyPiece::indices, run);
  const Array<std::uint32_t> counts = joined(faces_->pieces, &PlyPiece::index_counts, run);
  if (mesh_.corners.size() >= kNoPlyIndex) {
    throw Error(Error::Unsupported, fmt::format("{}: {} corners of faces, at most {} are read", name_,
                                                mesh_.corners.size(), kNoPlyIndex - 1));
  }
  if (!all_equal(counts, 3)) {
    mesh_.face_offsets.resize(counts.size() + 1);
    std::uint32_t place = 0;
    for (std::size_t face = 0; face < counts.size(); ++face) {
      mesh_.face_offsets[face] = place;
      place += counts[face];
    }
    mesh_.face_offsets.back() = place;
  }
  add_corner_texcoords(run);
}

/// Each face has a list of u, v for its corners. Where lengths don't fit, those of all faces are dropped: they are read
/// in a row.
void PlyMesh::add_corner_texcoords(const Run& run) {
  const Array<std::uint32_t> counts = joined(faces_->pieces, &PlyPiece::texcoord_counts, run);
  Array<float> values = joined(faces_->pieces, &PlyPiece::texcoords, run);
  if (values.empty()) return;
  for (std::size_t face = 0; face < counts.size(); ++face) {
    const std::size_t corners = mesh_.face_end(face) - mesh_.face_begin(face);
    if (counts[face] == corners * 2) continue;
    warn(run, fmt::format("{}: face {} has {} texture coordinates for {} corners: those of all faces are left out",
                          name_, face, counts[face], corners));
    return;
  }
  for (std::size_t i = 1; i < values.size(); i += 2) values[i] = 1 - values[i];
  std::erase_if(mesh_.attributes, [](const Attribute& each) { return each.name == "TEXCOORD_0"; });
  mesh_.attributes.push_back({"TEXCOORD_0", Domain::Corner, 2, std::move(values)});
}

void PlyMesh::add_strips(const Run& run) {
  Array<std::uint32_t> triangles;
  for (const PlyPiece& piece : strips_->pieces) {
    std::size_t begin = 0;
    for (const std::uint32_t count : piece.index_counts) {
      const std::uint32_t* const strip = piece.indices.data() + begin;
      begin += count;
      std::size_t length = 0;  // of the strip so far
      for (std::size_t i = 0; i < count; ++i) {
        if (strip[i] > 0x7FFFFFFF) {  // -1
          length = 0;
          continue;
        }
        if (++length < 3) continue;
        const bool turned = length % 2 == 0;
        const std::array<std::uint32_t, 3> corners = {strip[i - (turned ? 1 : 2)], strip[i - (turned ? 2 : 1)],
                                                      strip[i]};
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
        triangles.insert(triangles.end(), corners.begin(), corners.end());
      }
    }
  }
  if (mesh_.corners.size() + triangles.size() >= kNoPlyIndex) {
    throw Error(Error::Unsupported, fmt::format("{}: {} corners of triangle strips, at most {} are read", name_,
                                                triangles.size(), kNoPlyIndex - 1));
  }
  if (mesh_.corners.empty() && mesh_.face_offsets.empty()) {
    mesh_.corners = std::move(triangles);
    return;
  }
  // Strips have no attributes of faces and corners, so these can't be kept for all.
  const std::size_t removed =
      std::erase_if(mesh_.attributes, [](const Attribute& each) { return each.domain != Domain::Vertex; });
  if (removed > 0) {
    warn(run,
         fmt::format("{}: attributes of faces are left out: there are triangle strips, too, which have none", name_));
  }
  if (!mesh_.face_offsets.empty()) {
    for (std::size_t end = 3; end <= triangles.size(); end += 3) {
      mesh_.face_offsets.push_back(static_cast<std::uint32_t>(mesh_.corners.size() + end));
    }
  }
  mesh_.corners.insert(mesh_.corners.end(), triangles.begin(), triangles.end());
}

}  // namespace azulejo
