#include "azulejo/rendering/raster_scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/data/no_material.h"
#include "azulejo/io/weld.h"
#include "azulejo/math/transfer.h"
#include "azulejo/modelling/mesh_edges.h"
#include "azulejo/modelling/normals.h"
#include "azulejo/modelling/triangulate.h"

namespace azulejo {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 16;

/// What stands for a missing material, behind the scene's own.
enum Plain : std::uint32_t { kGray, kColored, kUnlitGray, kUnlitColored };

/// The values of an attribute as T, a vector of floats; what it lacks comes from `missing`.
template <class T>
CornerValues<T> corner_values(const Attribute& attribute, T missing, const Mesh& mesh, const Run& run) {
  CornerValues<T> result;
  result.domain = attribute.domain == Domain::Face ? Domain::Corner : attribute.domain;
  const auto components = static_cast<std::size_t>(attribute.components);
  const std::size_t taken = std::min<std::size_t>(components, static_cast<std::size_t>(T::length()));
  const auto convert = [&](auto* values, auto to_float, Array<T>& to) {
    to.resize(attribute.size());
    parallel_for(to.size(), kChunk, run, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        T value = missing;
        for (std::size_t c = 0; c < taken; ++c) value[static_cast<int>(c)] = to_float(values[i * components + c], c);
        to[i] = value;
      }
    });
  };
  Array<T> values;
  if (const auto* floats = attribute.get<float>()) {
    convert(
        floats->data(), [](float value, std::size_t) { return value; }, values);
  } else if (const auto* bytes = attribute.get<std::uint8_t>()) {
    // Bytes are colours, sRGB.
    convert(
        bytes->data(),
        [](std::uint8_t value, std::size_t c) {
          const float unit = static_cast<float>(value) / 255.0F;
          return c < 3 ? srgb_to_linear(unit) : unit;
        },
        values);
  } else {
    return result;
  }
  if (attribute.domain != Domain::Face) {
    result.values = std::move(values);
    return result;
  }
  result.values.resize(mesh.corner_count());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    std::fill(result.values.begin() + static_cast<std::ptrdiff_t>(mesh.face_begin(f)),
              result.values.begin() + static_cast<std::ptrdiff_t>(mesh.face_end(f)), values[f]);
  }
  return result;
}

/// A corner of a face has no normal of its own. Vertices without faces don't count.
bool lacks_normals(const CornerValues<glm::vec4>& normals, const Mesh& mesh) {
  const auto zero = [&](std::size_t at) {
    const glm::vec4& n = normals.values[at];
    return n.x == 0 && n.y == 0 && n.z == 0;
  };
  for (std::size_t c = 0; c < mesh.corner_count(); ++c) {
    if (zero(normals.domain == Domain::Vertex ? mesh.corners[c] : c)) return true;
  }
  return false;
}

void add_attributes(RasterMesh& raster, const RasterSceneOptions& options, const Run& run) {
  const Mesh& mesh = *raster.mesh;
  if (const Attribute* normals = mesh.find("NORMAL"); normals != nullptr && normals->components == 3) {
    raster.normals = corner_values<glm::vec4>(*normals, glm::vec4(0), mesh, run);
  }
  const bool of_faces = raster.kind == ShapeKind::Triangles || !raster.own_faces.empty();
  if (of_faces && (raster.normals.empty() || lacks_normals(raster.normals, mesh))) {
    const Attribute computed = vertex_normals(mesh, {.crease_angle = options.crease_angle}, run);
    raster.normals = corner_values<glm::vec4>(computed, glm::vec4(0), mesh, run);
  }
  for (int n = 0; n < 2; ++n) {
    const Attribute* const uv = mesh.find(n == 0 ? "TEXCOORD_0" : "TEXCOORD_1");
    if (uv != nullptr && uv->components == 2) raster.texcoords[n] = corner_values<glm::vec2>(*uv, {}, mesh, run);
  }
  if (const Attribute* color = mesh.find("COLOR_0"); color != nullptr && color->components >= 3) {
    raster.colors = corner_values<glm::vec4>(*color, glm::vec4(1), mesh, run);
  }
}

/// Centres and normals of the faces, in the mesh's space.
void add_faces(RasterMesh& raster, const Run& run) {
  const Mesh& mesh = *raster.mesh;
  const Array<glm::vec3> normals = face_normals(mesh, run);
  raster.face_centers.resize(mesh.face_count());
  raster.face_normals.resize(mesh.face_count());
  parallel_for(mesh.face_count(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      glm::dvec3 sum(0);
      for (std::size_t c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
        sum += glm::dvec3(mesh.positions[mesh.corners[c]]);
      const double corners = static_cast<double>(std::max<std::size_t>(1, mesh.face_end(f) - mesh.face_begin(f)));
      raster.face_centers[f] = glm::vec4(glm::vec3(sum / corners), 1);
      raster.face_normals[f] = glm::vec4(normals[f], 0);
    }
  });
}

/// The materials of the faces that the triangles are of.
void add_face_materials(RasterMesh& raster, std::uint32_t no_material) {
  const Mesh& mesh = *raster.mesh;
  raster.triangle_material.resize(mesh.material.empty() ? 0 : raster.triangle_count);
  for (std::uint32_t t = 0; t < raster.triangle_material.size(); ++t) {
    const std::uint32_t material = mesh.material[raster.face(t)];
    raster.triangle_material[t] = material == MaterialId::kNone ? no_material : material;
  }
  raster.default_material = no_material;
  // One material for all need not be looked up.
  const Array<std::uint32_t>& each = raster.triangle_material;
  if (!each.empty() && std::all_of(each.begin(), each.end(), [&](std::uint32_t m) { return m == each[0]; })) {
    raster.default_material = each[0];
    raster.triangle_material.clear();
  }
}

void add_triangles(RasterMesh& raster, std::uint32_t no_material, const Run& run) {
  const Mesh& mesh = *raster.mesh;
  if (!mesh.all_triangles()) {
    Triangulation triangulation = triangulate(mesh, run);
    raster.own_corners = std::move(triangulation.corners);
    raster.own_faces = std::move(triangulation.face);
    raster.own_vertices.resize(raster.own_corners.size());
    for (std::size_t i = 0; i < raster.own_corners.size(); ++i)
      raster.own_vertices[i] = mesh.corners[raster.own_corners[i]];
    raster.triangle_count = static_cast<std::uint32_t>(raster.own_faces.size());
  } else {
    raster.triangle_count = static_cast<std::uint32_t>(mesh.face_count());
  }
  add_face_materials(raster, no_material);
}

/// Lines as (a, b, b), points as (a, a, a).
void add_thin(RasterMesh& raster, const Mesh& mesh, std::uint32_t material) {
  raster.default_material = material;
  if (raster.kind == ShapeKind::Lines) {
    for (std::size_t l = 0; l + 1 < mesh.lines.size(); l += 2) {
      raster.own_vertices.insert(raster.own_vertices.end(), {mesh.lines[l], mesh.lines[l + 1], mesh.lines[l + 1]});
    }
  } else {
    raster.own_vertices.resize(mesh.vertex_count() * 3);
    for (std::size_t v = 0; v < raster.own_vertices.size(); ++v)
      raster.own_vertices[v] = static_cast<std::uint32_t>(v / 3);
  }
  raster.triangle_count = static_cast<std::uint32_t>(raster.own_vertices.size() / 3);
}

/// The edges of faces as lines, each once, or their corners as points, each vertex once.
void add_outlines(RasterMesh& raster, std::uint32_t no_material, const Run& run) {
  const Mesh& mesh = *raster.mesh;
  const auto add = [&](std::uint32_t begin, std::uint32_t end, std::uint32_t face) {
    raster.own_corners.insert(raster.own_corners.end(), {begin, end, end});
    raster.own_faces.push_back(face);
  };
  if (raster.kind == ShapeKind::Lines) {
    const Welded welded = weld_exactly(mesh.positions, run);
    for (const MeshEdge& edge : mesh_edges(mesh, welded.corners, run)) add(edge.begin, edge.end, edge.face);
  } else {
    std::vector<bool> drawn(mesh.vertex_count(), false);
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
      for (auto c = static_cast<std::uint32_t>(mesh.face_begin(face)); c < mesh.face_end(face); ++c) {
        if (!drawn[mesh.corners[c]]) add(c, c, face);
        drawn[mesh.corners[c]] = true;
      }
    }
  }
  raster.own_vertices.resize(raster.own_corners.size());
  std::ranges::transform(raster.own_corners, raster.own_vertices.begin(),
                         [&](std::uint32_t corner) { return mesh.corners[corner]; });
  raster.triangle_count = static_cast<std::uint32_t>(raster.own_faces.size());
  add_face_materials(raster, no_material);
}

/// Textures by (texture, whether its colours are sRGB): each is made ready once.
class Maps {
 public:
  Maps(const Scene& scene, RasterScene& result, const Run& run) : scene_(scene), result_(result), run_(run) {}

  const TextureMap* operator()(const TextureUse& use, bool srgb) {
    if (!use.texture) return nullptr;
    const Texture& texture = scene_.textures[use.texture.index];
    if (texture.image == nullptr || texture.image->empty()) return nullptr;
    const auto [known, added] = made_.try_emplace({use.texture.index, srgb}, nullptr);
    if (added) {
      result_.maps.push_back(std::make_unique<TextureMap>(texture, srgb, run_));
      known->second = result_.maps.back().get();
    }
    return known->second;
  }

 private:
  const Scene& scene_;
  RasterScene& result_;
  const Run& run_;
  std::map<std::pair<std::uint32_t, bool>, const TextureMap*> made_;
};

void add_materials(const Scene& scene, RasterScene& result, const Run& run) {
  Maps maps(scene, result, run);
  for (const Material& material : scene.materials) {
    result.materials.push_back({material, maps(material.base_color_texture, true),
                                maps(material.metallic_roughness_texture, false), maps(material.normal_texture, false),
                                maps(material.occlusion_texture, false), maps(material.emissive_texture, true),
                                maps(material.specular_texture, true)});
  }
  result.own_materials = static_cast<std::uint32_t>(scene.materials.size());
  // What has no material is light gray, or just as its vertices are coloured, and that from both sides. What is unlit
  // is a gray in the middle: it must be seen before white and before black.
  constexpr glm::vec4 kMiddle{0.18F, 0.18F, 0.18F, 1};
  for (const Plain each : {kGray, kColored, kUnlitGray, kUnlitColored}) {
    Material plain;
    plain.double_sided = true;
    if (each == kGray) plain.base_color = kNoMaterialColor;
    if (each == kUnlitGray) plain.base_color = kMiddle;
    if (each >= kUnlitGray) plain.model = MaterialModel::Unlit;
    result.materials.push_back({plain});
  }
}

/// The material of what has none.
std::uint32_t plain_material(const RasterScene& scene, const Mesh& mesh, bool of_faces) {
  const Attribute* const color = mesh.find("COLOR_0");
  const bool colored = color != nullptr && color->components >= 3;
  const bool lit = of_faces || mesh.find("NORMAL") != nullptr;
  return scene.own_materials + (lit ? (colored ? kColored : kGray) : (colored ? kUnlitColored : kUnlitGray));
}

glm::mat3 normal_matrix(const glm::mat4& world_from_object) {
  const glm::mat3 linear(world_from_object);
  // The cofactors: the inverse transpose without its division, which may not exist; the sign is the mirror's.
  const glm::mat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                            glm::cross(linear[0], linear[1]));
  return glm::determinant(linear) < 0 ? -1.0F * cofactors : cofactors;
}

void classify(const RasterScene& scene, RasterInstance& instance) {
  const RasterMesh& mesh = scene.meshes[instance.mesh];
  std::vector<bool> seen(scene.materials.size(), false);
  if (mesh.triangle_material.empty()) {
    seen[mesh.material(0)] = true;
  } else {
    for (const std::uint32_t material : mesh.triangle_material) seen[material] = true;
  }
  instance.all_double_sided = true;
  for (std::size_t m = 0; m < seen.size(); ++m) {
    if (!seen[m]) continue;
    const Material& material = scene.materials[m].material;
    if (material.alpha_mode != AlphaMode::Opaque) instance.opaque = false;
    (material.double_sided ? instance.all_single_sided : instance.all_double_sided) = false;
  }
}

void add_instance(RasterScene& result, const PlacedNode& placed, std::uint32_t mesh, const RasterInstance& flags) {
  const RasterMesh& shape = result.meshes[mesh];
  if (shape.triangle_count == 0) return;
  constexpr std::uint64_t kMost = std::uint64_t{1} << 31;
  if (std::uint64_t{result.triangle_count} + shape.triangle_count >= kMost) {
    throw Error(Error::Resource, "render: more than 2^31 triangles over all instances");
  }
  RasterInstance instance = flags;
  instance.mesh = mesh;
  instance.object = placed.node.index;
  instance.world_from_object = placed.world_from_node;
  instance.world_from_normal = normal_matrix(placed.world_from_node);
  instance.mirrored = glm::determinant(glm::mat3(placed.world_from_node)) < 0;
  instance.first_triangle = result.triangle_count;
  instance.first_vertex = result.vertex_count;
  result.instances.push_back(instance);
  result.triangle_count += shape.triangle_count;
  result.vertex_count += shape.mesh->vertex_count();
}

}  // namespace

std::uint32_t RasterScene::instance_of(std::uint32_t triangle) const {
  const auto after = std::upper_bound(
      instances.begin(), instances.end(), triangle,
      [](std::uint32_t wanted, const RasterInstance& instance) { return wanted < instance.first_triangle; });
  return static_cast<std::uint32_t>(after - instances.begin()) - 1;
}

RasterScene prepare_raster_scene(const Scene& scene, const RasterSceneOptions& options, const Run& run) {
  RasterScene result;
  add_materials(scene, result, run);
  // The shapes of each mesh: its faces and its lines, or else its points.
  std::vector<std::vector<std::uint32_t>> shapes(scene.meshes.size());
  std::vector<RasterInstance> flags;
  const ShapeKind faces_as = options.polygon_mode == PolygonMode::Edges      ? ShapeKind::Lines
                             : options.polygon_mode == PolygonMode::Vertices ? ShapeKind::Points
                                                                             : ShapeKind::Triangles;
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    const std::shared_ptr<const Mesh>& mesh = scene.meshes[m];
    const auto add = [&](ShapeKind kind, bool of_faces) {
      check_cancelled(run);
      RasterMesh raster;
      raster.mesh = mesh;
      raster.kind = kind;
      const std::uint32_t no_material = plain_material(result, *mesh, of_faces);
      if (kind == ShapeKind::Triangles) {
        add_triangles(raster, no_material, run);
        if (options.flat) add_faces(raster, run);
      } else if (of_faces) {
        add_outlines(raster, no_material, run);
      } else {
        add_thin(raster, *mesh, no_material);
      }
      add_attributes(raster, options, run);
      shapes[m].push_back(static_cast<std::uint32_t>(result.meshes.size()));
      result.meshes.push_back(std::move(raster));
      RasterInstance flag;
      flag.mesh = shapes[m].back();
      classify(result, flag);
      flags.push_back(flag);
    };
    if (mesh->face_count() > 0) add(faces_as, true);
    if (!mesh->lines.empty()) add(ShapeKind::Lines, false);
    if (mesh->face_count() == 0 && mesh->lines.empty() && mesh->vertex_count() > 0) add(ShapeKind::Points, false);
  }
  for (const PlacedNode& placed : walk(scene)) {
    const MeshId mesh = scene.nodes[placed.node.index].mesh;
    if (!placed.visible || !mesh) continue;
    for (const std::uint32_t shape : shapes[mesh.index]) add_instance(result, placed, shape, flags[shape]);
  }
  return result;
}

}  // namespace azulejo
