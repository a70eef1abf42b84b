#include "azulejo/modelling/flatten.h"

#include <algorithm>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/modelling/instance.h"
#include "azulejo/modelling/pose.h"
#include "azulejo/modelling/united_attributes.h"

namespace azulejo {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 14;  // elements
constexpr const char* kNode = "NODE";

struct Totals {
  std::size_t vertices = 0;
  std::size_t corners = 0;
  std::size_t faces = 0;
  std::size_t lines = 0;
  bool all_triangles = true;
  bool material = false;

  std::size_t of(Domain domain) const {
    return domain == Domain::Vertex ? vertices : domain == Domain::Corner ? corners : faces;
  }
};

std::vector<Instance> visible_instances(const Scene& scene) {
  std::vector<Instance> instances;
  for (const PlacedNode& placed : walk(scene)) {
    const MeshId mesh = scene.nodes[placed.node.index].mesh;
    if (!placed.visible || !mesh) continue;
    Instance instance;
    instance.mesh = scene.meshes[mesh.index].get();
    instance.node = placed.node.index;
    instance.world_from_mesh = placed.world_from_node;
    instances.push_back(instance);
  }
  return instances;
}

Totals place_one_after_the_other(std::vector<Instance>& instances) {
  Totals totals;
  for (Instance& each : instances) {
    each.first_vertex = totals.vertices;
    each.first_corner = totals.corners;
    each.first_face = totals.faces;
    each.first_line = totals.lines;
    totals.vertices += each.mesh->vertex_count();
    totals.corners += each.mesh->corner_count();
    totals.faces += each.mesh->face_count();
    totals.lines += each.mesh->lines.size();
    totals.all_triangles = totals.all_triangles && each.mesh->all_triangles();
    totals.material = totals.material || !each.mesh->material.empty();
  }
  return totals;
}

void check_size(const Totals& totals, const std::vector<UnitedAttribute>& attributes, const Run& run) {
  constexpr std::size_t kMost = 0xFFFFFFFE;
  if (totals.vertices > kMost || totals.corners > kMost) {
    throw Error(Error::Resource, fmt::format("flatten: {} vertices and {} corners, a mesh holds at most {}",
                                             totals.vertices, totals.corners, kMost));
  }
  std::size_t bytes = 12 * totals.vertices + 4 * (totals.corners + totals.lines) + 12 * totals.faces;
  for (const UnitedAttribute& each : attributes) {
    bytes += totals.of(each.domain) * static_cast<std::size_t>(each.components) * component_bytes(each.values);
  }
  if (bytes > static_cast<std::size_t>(std::max<std::int64_t>(run.limits.memory_bytes, 0))) {
    throw Error(Error::Resource,
                fmt::format("flatten: needs {} bytes, more than the limit of {}", bytes, run.limits.memory_bytes));
  }
}

/// The corners of an instance in the order that the result has them: a mirrored one's faces keep their first corner and
/// turn the rest around.
Array<std::uint32_t> corner_order(const Instance& instance, const Run& run) {
  const Mesh& mesh = *instance.mesh;
  Array<std::uint32_t> order(mesh.corner_count());
  const bool mirrored = instance.mirrored();
  parallel_for(mesh.face_count(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const std::size_t first = mesh.face_begin(f);
      const std::size_t size = mesh.face_end(f) - first;
      for (std::size_t i = 0; i < size; ++i) {
        order[first + i] = static_cast<std::uint32_t>(first + (mirrored && i > 0 ? size - i : i));
      }
    }
  });
  return order;
}

void copy_geometry(const Instance& instance, const Array<std::uint32_t>& order, Mesh& result, const Run& run) {
  const Mesh& mesh = *instance.mesh;
  const auto vertex_offset = static_cast<std::uint32_t>(instance.first_vertex);
  parallel_for(mesh.vertex_count(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      result.positions[instance.first_vertex + v] =
          glm::vec3(instance.world_from_mesh * glm::vec4(mesh.positions[v], 1.0F));
    }
  });
  parallel_for(mesh.corner_count(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      result.corners[instance.first_corner + c] = mesh.corners[order[c]] + vertex_offset;
    }
  });
  for (std::size_t i = 0; i < mesh.lines.size(); ++i) {
    result.lines[instance.first_line + i] = mesh.lines[i] + vertex_offset;
  }
}

void copy_faces(const Instance& instance, Mesh& result, Array<std::uint32_t>& node) {
  const Mesh& mesh = *instance.mesh;
  const std::size_t faces = mesh.face_count();
  const auto at = [&](Array<std::uint32_t>& array) {
    return array.begin() + static_cast<std::ptrdiff_t>(instance.first_face);
  };
  if (!result.face_offsets.empty()) {
    for (std::size_t f = 0; f < faces; ++f) {
      result.face_offsets[instance.first_face + f] =
          static_cast<std::uint32_t>(instance.first_corner + mesh.face_begin(f));
    }
  }
  if (!result.material.empty()) {
    if (mesh.material.empty()) {
      std::fill_n(at(result.material), faces, MaterialId::kNone);
    } else {
      std::copy(mesh.material.begin(), mesh.material.end(), at(result.material));
    }
  }
  std::fill_n(at(node), faces, instance.node);
}

Mesh with_room(const Scene& scene, const Totals& totals) {
  Mesh result;
  result.name = scene.name;
  result.space = scene.space;
  result.positions.resize(totals.vertices);
  result.corners.resize(totals.corners);
  result.lines.resize(totals.lines);
  if (!totals.all_triangles) {
    result.face_offsets.resize(totals.faces + 1);
    result.face_offsets.back() = static_cast<std::uint32_t>(totals.corners);
  }
  if (totals.material) result.material.resize(totals.faces);
  return result;
}

void add_attribute(Mesh& mesh, std::string name, Domain domain, int components, Attribute::Values values) {
  mesh.attributes.push_back({std::move(name), domain, components, std::move(values)});
}

}  // namespace

Mesh flatten(const Scene& scene, const Run& run) {
  if (needs_pose(scene)) {
    warn(run, "skinned or morphed meshes are shown in the pose of the file");
    return flatten(pose(scene, run), run);
  }
  std::vector<Instance> instances = visible_instances(scene);
  const Totals totals = place_one_after_the_other(instances);
  std::vector<const Mesh*> meshes;
  for (const Instance& each : instances) meshes.push_back(each.mesh);
  std::vector<UnitedAttribute> attributes = unite_attributes(meshes, kNode);
  check_size(totals, attributes, run);

  Mesh result = with_room(scene, totals);
  Array<std::uint32_t> node(totals.faces);
  for (UnitedAttribute& each : attributes) {
    const std::size_t values = totals.of(each.domain) * static_cast<std::size_t>(each.components);
    std::visit([&](auto& array) { array.resize(values); }, each.values);
  }
  for (const Instance& each : instances) {
    check_cancelled(run);
    const Array<std::uint32_t> order = corner_order(each, run);
    copy_geometry(each, order, result, run);
    copy_faces(each, result, node);
    for (UnitedAttribute& attribute : attributes) copy_attribute(each, order, attribute, run);
  }
  for (UnitedAttribute& each : attributes) {
    add_attribute(result, std::move(each.name), each.domain, each.components, std::move(each.values));
  }
  if (totals.faces > 0) add_attribute(result, kNode, Domain::Face, 1, std::move(node));
  return result;
}

}  // namespace azulejo
