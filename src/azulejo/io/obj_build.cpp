#include "azulejo/io/obj_build.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/io/obj_objects.h"
#include "azulejo/math/transfer.h"

namespace azulejo {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 15;

using Indices = std::span<const std::uint32_t>;

glm::vec3 unit(const glm::vec3& normal) {
  const float square = normal.x * normal.x + normal.y * normal.y + normal.z * normal.z;
  // What is rounded from a unit vector stays as it is; what has no direction too.
  if (std::abs(square - 1.0F) < 1e-6F || !(square > 1e-30F && square < 1e30F)) return normal;
  const float length = std::sqrt(square);
  return {normal.x / length, normal.y / length, normal.z / length};
}

/// Values as azulejo keeps them: v counts down, normals have unit length, colours are linear.
void convert_values(ObjData& data, const Run& run) {
  parallel_for(data.texcoords.size(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) data.texcoords[i].y = 1.0F - data.texcoords[i].y;
  });
  parallel_for(data.normals.size(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) data.normals[i] = unit(data.normals[i]);
  });
  const auto beyond_one = [&](std::size_t begin, std::size_t end) {
    int beyond = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const glm::vec3& color = data.colors[i];
      if (color.x > 1.0F || color.y > 1.0F || color.z > 1.0F) beyond = 1;
    }
    return beyond;
  };
  const int bytes = parallel_reduce(data.colors.size(), kChunk, run, 0, beyond_one, std::bit_or<>());
  const float range = bytes != 0 ? 255.0F : 1.0F;
  parallel_for(data.colors.size(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (int c = 0; c < 3; ++c) data.colors[i][c] = srgb_to_linear(data.colors[i][c] / range);
    }
  });
}

/// The value that holds for each face, as events set it; empty if none sets another than `at_first`.
template <class Value>
Array<std::uint32_t> for_each_face(const ObjData& data, ObjEvent::Kind kind, std::uint32_t at_first, Value value_of) {
  Array<std::uint32_t> values;
  std::uint32_t value = at_first;
  const auto fill_to = [&](std::size_t face) {
    if (values.empty() && value == at_first) return;
    values.resize(face, value);
  };
  for (std::size_t e = 0; e < data.events.size(); ++e) {
    if (data.events[e].kind != kind) continue;
    const std::uint32_t next = value_of(e);
    if (next == value) continue;
    fill_to(data.events[e].faces);
    if (values.empty()) values.resize(data.events[e].faces, at_first);
    value = next;
  }
  fill_to(data.faces);
  return values;
}

/// The vertices that an object keeps, by their numbers in the file, rising.
class Renumbering {
 public:
  Renumbering(const ObjData& data, const ObjObject& object);
  const Array<std::uint32_t>& kept() const { return kept_; }
  std::uint32_t operator()(std::uint32_t vertex) const {
    if (!dense_.empty()) return dense_[vertex - first_];
    return static_cast<std::uint32_t>(std::lower_bound(kept_.begin(), kept_.end(), vertex) - kept_.begin());
  }

 private:
  void keep(const std::vector<Indices>& lists);

  Array<std::uint32_t> kept_;
  Array<std::uint32_t> dense_;  ///< new number of each from first_ on; empty where the object's vertices lie far apart
  std::uint32_t first_ = 0;
};

Indices corners_of(const ObjData& data, const Array<std::uint32_t>& of_corners, const ObjObject& object) {
  if (of_corners.empty()) return {};
  const auto corner = [&](std::size_t face) { return data.face_offsets.empty() ? face * 3 : data.face_offsets[face]; };
  return Indices(of_corners).subspan(corner(object.faces.begin), corner(object.faces.end) - corner(object.faces.begin));
}

Indices part(const Array<std::uint32_t>& values, const ObjRange& range) {
  return values.empty() ? Indices() : Indices(values).subspan(range.begin, range.size());
}

Renumbering::Renumbering(const ObjData& data, const ObjObject& object) {
  if (object.has_elements()) {
    keep(
        {corners_of(data, data.corners, object), part(data.lines, object.line_ends), part(data.points, object.points)});
    return;
  }
  kept_.resize(object.vertices.size());
  std::iota(kept_.begin(), kept_.end(), static_cast<std::uint32_t>(object.vertices.begin));
}

void Renumbering::keep(const std::vector<Indices>& lists) {
  std::uint32_t last = 0;
  std::size_t count = 0;
  first_ = 0xFFFFFFFF;
  for (const Indices& list : lists) {
    count += list.size();
    for (const std::uint32_t vertex : list) {
      first_ = std::min(first_, vertex);
      last = std::max(last, vertex);
    }
  }
  const std::size_t range = std::size_t{last} - first_ + 1;
  if (range > 4 * count + 1024) {
    for (const Indices& list : lists) kept_.insert(kept_.end(), list.begin(), list.end());
    std::sort(kept_.begin(), kept_.end());
    kept_.erase(std::unique(kept_.begin(), kept_.end()), kept_.end());
    return;
  }
  dense_.resize(range, 0U);
  for (const Indices& list : lists) {
    for (const std::uint32_t vertex : list) dense_[vertex - first_] = 1;
  }
  for (std::size_t v = 0; v < range; ++v) {
    if (std::exchange(dense_[v], static_cast<std::uint32_t>(kept_.size())) != 0) {
      kept_.push_back(first_ + static_cast<std::uint32_t>(v));
    }
  }
}

/// Builds the mesh of one object.
class MeshBuilder {
 public:
  MeshBuilder(const ObjObject& object, const Run& run) : object_(object), run_(run) {
    mesh_.name = std::string(object.name);
  }

  /// Takes all of `data`; the object is its only one.
  Mesh whole(ObjData& data, Array<std::uint32_t> material, Array<std::uint32_t> smoothing);
  /// Takes what belongs to the object.
  Mesh piece(const ObjData& data, const Array<std::uint32_t>& material, const Array<std::uint32_t>& smoothing);

 private:
  template <class Vector>
  void add_of_corners(const char* name, Indices indices, const Array<Vector>& values);
  std::optional<Array<std::uint32_t>> one_for_each_vertex(Indices indices) const;
  template <class Vector>
  void add(const char* name, Domain domain, Indices indices, const Array<Vector>& values);
  void add_of_vertices(const char* name, const Array<glm::vec3>& values);
  void add_smoothing(Indices smoothing);
  void set_material(Indices material);

  const ObjObject& object_;
  const Run& run_;
  Mesh mesh_;
};

/// values[indices[i]] for each element of a domain; zeros where there is none.
template <class Vector>
void MeshBuilder::add(const char* name, Domain domain, Indices indices, const Array<Vector>& values) {
  constexpr int kComponents = Vector::length();
  Array<float> floats(indices.size() * kComponents);
  parallel_for(indices.size(), kChunk, run_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vector value = indices[i] == kObjAbsent ? Vector(0.0F) : values[indices[i]];
      for (int c = 0; c < kComponents; ++c) floats[i * kComponents + static_cast<std::size_t>(c)] = value[c];
    }
  });
  mesh_.attributes.push_back({name, domain, kComponents, std::move(floats)});
}

/// The index that each vertex has in all its corners; none if corners of a vertex differ.
std::optional<Array<std::uint32_t>> MeshBuilder::one_for_each_vertex(Indices indices) const {
  Array<std::uint32_t> of_vertex(mesh_.positions.size(), kObjAbsent);
  // Whichever corner comes last: if they differ, one of them will be found to differ from it.
  parallel_for(indices.size(), kChunk, run_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      std::atomic_ref(of_vertex[mesh_.corners[c]]).store(indices[c], std::memory_order_relaxed);
    }
  });
  const auto agree = [&](std::size_t begin, std::size_t end) {
    std::size_t c = begin;
    while (c < end && of_vertex[mesh_.corners[c]] == indices[c]) ++c;
    return c == end ? 1 : 0;
  };
  if (parallel_reduce(indices.size(), kChunk, run_, 1, agree, std::bit_and<>()) == 0) return std::nullopt;
  return of_vertex;
}

template <class Vector>
void MeshBuilder::add_of_corners(const char* name, Indices indices, const Array<Vector>& values) {
  if (std::all_of(indices.begin(), indices.end(), [](std::uint32_t index) { return index == kObjAbsent; })) return;
  if (const auto of_vertex = one_for_each_vertex(indices)) return add(name, Domain::Vertex, *of_vertex, values);
  add(name, Domain::Corner, indices, values);
}

void MeshBuilder::add_of_vertices(const char* name, const Array<glm::vec3>& values) {
  if (values.empty()) return;
  const auto* const floats = &values.data()->x;
  mesh_.attributes.push_back({name, Domain::Vertex, 3, Array<float>(floats, floats + values.size() * 3)});
}

void MeshBuilder::add_smoothing(Indices smoothing) {
  if (std::adjacent_find(smoothing.begin(), smoothing.end(), std::not_equal_to<>()) == smoothing.end()) return;
  mesh_.attributes.push_back(
      {"SMOOTHING_GROUP", Domain::Face, 1, Array<std::uint32_t>(smoothing.begin(), smoothing.end())});
}

void MeshBuilder::set_material(Indices material) {
  const auto none = [](std::uint32_t each) { return each == MaterialId::kNone; };
  if (!std::all_of(material.begin(), material.end(), none)) mesh_.material.assign(material.begin(), material.end());
}

Mesh MeshBuilder::whole(ObjData& data, Array<std::uint32_t> material, Array<std::uint32_t> smoothing) {
  mesh_.positions = std::move(data.positions);
  mesh_.corners = std::move(data.corners);
  mesh_.face_offsets = std::move(data.face_offsets);
  mesh_.lines = std::move(data.lines);
  add_of_corners("NORMAL", data.corner_normals, data.normals);
  add_of_corners("TEXCOORD_0", data.corner_texcoords, data.texcoords);
  // Points with normals: one follows the other, nothing joins them.
  if (data.faces == 0 && data.normals.size() == mesh_.positions.size()) add_of_vertices("NORMAL", data.normals);
  add_of_vertices("COLOR_0", data.colors);
  add_smoothing(smoothing);
  set_material(material);
  return std::move(mesh_);
}

Mesh MeshBuilder::piece(const ObjData& data, const Array<std::uint32_t>& material,
                        const Array<std::uint32_t>& smoothing) {
  const Renumbering renumbered(data, object_);
  mesh_.positions.reserve(renumbered.kept().size());
  for (const std::uint32_t vertex : renumbered.kept()) mesh_.positions.push_back(data.positions[vertex]);
  const auto renumber = [&](Indices vertices, Array<std::uint32_t>& result) {
    result.reserve(vertices.size());
    for (const std::uint32_t vertex : vertices) result.push_back(renumbered(vertex));
  };
  renumber(corners_of(data, data.corners, object_), mesh_.corners);
  renumber(part(data.lines, object_.line_ends), mesh_.lines);
  if (!data.face_offsets.empty() && mesh_.corners.size() != object_.faces.size() * 3) {
    const std::uint32_t first = data.face_offsets[object_.faces.begin];
    for (std::size_t f = object_.faces.begin; f <= object_.faces.end; ++f) {
      mesh_.face_offsets.push_back(data.face_offsets[f] - first);
    }
  }
  add_of_corners("NORMAL", corners_of(data, data.corner_normals, object_), data.normals);
  add_of_corners("TEXCOORD_0", corners_of(data, data.corner_texcoords, object_), data.texcoords);
  if (!data.colors.empty()) add("COLOR_0", Domain::Vertex, renumbered.kept(), data.colors);
  add_smoothing(part(smoothing, object_.faces));
  set_material(part(material, object_.faces));
  return std::move(mesh_);
}

/// Points have no place beside faces and lines in a mesh.
void warn_of_points(const std::vector<ObjObject>& objects, const std::string& name, const Run& run) {
  std::size_t count = 0;
  for (const ObjObject& each : objects) {
    if (each.faces.size() + each.line_ends.size() > 0) count += each.points.size();
  }
  if (count > 0) warn(run, fmt::format("{}: {} points beside faces or lines are left out", name, count));
}

void check_memory(std::size_t objects, const std::string& name, const Run& run) {
  // Of each: mesh, node, their names, and what the allocator adds to arrays of few elements.
  constexpr std::size_t kEach = sizeof(Mesh) + sizeof(Node) + 512;
  const auto limit = static_cast<std::size_t>(run.limits.memory_bytes);
  if (objects > limit / kEach) {
    throw Error(Error::Resource,
                fmt::format("{}: {} objects take more than {} bytes, the limit of memory", name, objects, limit));
  }
}

}  // namespace

void build_obj(ObjData data, const std::vector<std::uint32_t>& materials, const std::string& name, const Run& run,
               Scene& scene) {
  convert_values(data, run);
  Array<std::uint32_t> material = for_each_face(data, ObjEvent::Kind::Material, MaterialId::kNone,
                                                [&](std::size_t event) { return materials[event]; });
  Array<std::uint32_t> smoothing = for_each_face(data, ObjEvent::Kind::Smoothing, 0,
                                                 [&](std::size_t event) { return data.events[event].smoothing; });
  const std::vector<ObjObject> objects = obj_objects(data);
  check_memory(objects.size(), name, run);
  warn_of_points(objects, name, run);
  scene.meshes.resize(objects.size());
  if (objects.size() == 1) {
    Mesh mesh = MeshBuilder(objects[0], run).whole(data, std::move(material), std::move(smoothing));
    scene.meshes[0] = std::make_shared<const Mesh>(std::move(mesh));
  } else {
    Run within = run;
    within.threads = 1;
    parallel_tasks(objects.size(), run, [&](std::size_t at, int) {
      Mesh mesh = MeshBuilder(objects[at], within).piece(data, material, smoothing);
      scene.meshes[at] = std::make_shared<const Mesh>(std::move(mesh));
    });
  }
  for (std::size_t at = 0; at < objects.size(); ++at) {
    Node node;
    node.name = scene.meshes[at]->name;
    node.mesh = MeshId(at);
    scene.roots.emplace_back(scene.nodes.size());
    scene.nodes.push_back(std::move(node));
  }
}

}  // namespace azulejo
