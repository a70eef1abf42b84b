#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/data/scene.h"
#include "azulejo/rendering/polygon_mode.h"
#include "azulejo/rendering/texture_map.h"

namespace azulejo {

/// Values for the corners of triangles, found by the vertex or by the corner of the mesh.
template <class T>
struct CornerValues {
  Array<T> values;  ///< empty: none
  Domain domain = Domain::Vertex;
  bool empty() const { return values.empty(); }
};

enum class ShapeKind : std::uint8_t { Triangles, Lines, Points };

/// A mesh as the rasterizer wants it: triangles only, attributes in vectors of four. Lines and points are triples with
/// equal vertices, (a, b, b) and (a, a, a), widened in the picture.
struct RasterMesh {
  std::shared_ptr<const Mesh> mesh;
  ShapeKind kind = ShapeKind::Triangles;
  std::uint32_t triangle_count = 0;
  Array<std::uint32_t> own_vertices;  ///< three a triangle; empty: mesh->corners
  Array<std::uint32_t> own_corners;   ///< three corner numbers a triangle; empty: 0, 1, 2, …
  Array<std::uint32_t> own_faces;     ///< the face of each triangle; empty: its number
  CornerValues<glm::vec4> normals;    ///< xyz
  CornerValues<glm::vec2> texcoords[2];
  CornerValues<glm::vec4> colors;  ///< linear
  Array<glm::vec4> face_centers;   ///< with flat shading: of each face, in the mesh's space
  Array<glm::vec4> face_normals;
  Array<std::uint32_t> triangle_material;  ///< of each triangle; empty: the default everywhere
  std::uint32_t default_material = 0;

  const std::uint32_t* vertices() const { return own_vertices.empty() ? mesh->corners.data() : own_vertices.data(); }
  std::uint32_t corner(std::size_t at) const {
    return own_corners.empty() ? static_cast<std::uint32_t>(at) : own_corners[at];
  }
  std::uint32_t face(std::uint32_t triangle) const { return own_faces.empty() ? triangle : own_faces[triangle]; }
  std::uint32_t material(std::uint32_t triangle) const {
    return triangle_material.empty() ? default_material : triangle_material[triangle];
  }
};

/// A material with its textures made ready.
struct RasterMaterial {
  Material material;
  const TextureMap* base_color = nullptr;
  const TextureMap* metallic_roughness = nullptr;
  const TextureMap* normal = nullptr;
  const TextureMap* occlusion = nullptr;
  const TextureMap* emissive = nullptr;
  const TextureMap* specular = nullptr;
  bool textured() const {
    return base_color != nullptr || metallic_roughness != nullptr || normal != nullptr || occlusion != nullptr ||
           emissive != nullptr || specular != nullptr;
  }
};

/// A mesh at a place.
struct RasterInstance {
  std::uint32_t mesh = 0;    ///< into RasterScene::meshes
  std::uint32_t object = 0;  ///< the node's number
  glm::mat4 world_from_object{1.0F};
  glm::mat3 world_from_normal{1.0F};  ///< inverse transpose, unscaled
  bool mirrored = false;
  std::uint32_t first_triangle = 0;  ///< of all instances' triangles
  std::size_t first_vertex = 0;      ///< of all instances' vertices
  bool opaque = true;                ///< no material with an alpha mode
  bool all_double_sided = false;
  bool all_single_sided = true;
};

struct RasterSceneOptions {
  float crease_angle = 0.6981317F;  ///< radians: 40°
  bool flat = false;                ///< face centres and normals are wanted
  PolygonMode polygon_mode = PolygonMode::Filled;
};

/// A scene taken apart once, to be drawn from any side.
struct RasterScene {
  std::vector<RasterMesh> meshes;
  std::vector<RasterMaterial> materials;  ///< the scene's, then those for what has none
  std::uint32_t own_materials = 0;        ///< how many of them are the scene's
  std::vector<std::unique_ptr<TextureMap>> maps;
  std::vector<RasterInstance> instances;
  std::uint32_t triangle_count = 0;  ///< over all instances
  std::size_t vertex_count = 0;

  /// The instance that a triangle belongs to. Cost O(log instances).
  std::uint32_t instance_of(std::uint32_t triangle) const;
};

/// Triangulates, makes normals where there are none, and mipmaps. Nodes that are not visible are left out.
/// Throws Error(Resource) for more than 2³¹ triangles over all instances.
RasterScene prepare_raster_scene(const Scene& scene, const RasterSceneOptions& options, const Run& run);

}  // namespace azulejo
