#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/core/json.h"
#include "azulejo/core/run.h"
#include "azulejo/data/mesh.h"
#include "azulejo/data/scene.h"
#include "azulejo/data/volume.h"
#include "azulejo/io/model_io.h"
#include "azulejo/modelling/closed.h"

namespace azulejo {

struct AttributeInfo {
  std::string name;
  Domain domain = Domain::Vertex;
  int components = 1;
  std::string type;        ///< "f32", "u8", "u32"
  std::size_t meshes = 1;  ///< that have it
};

/// One mesh, or the sums over several.
struct MeshInfo {
  std::string name;
  std::size_t vertices = 0;
  std::size_t faces = 0;
  std::size_t triangles = 0;  ///< that the faces fall into
  std::size_t corners = 0;
  std::size_t lines = 0;
  std::map<std::size_t, std::size_t> polygons;  ///< faces by their number of corners; empty: all are triangles
  std::vector<AttributeInfo> attributes;
  std::size_t morph_targets = 0;
  std::size_t flat_faces = 0;           ///< without area
  std::size_t not_finite_vertices = 0;  ///< with a NaN or an infinity
  EdgeCounts edges;
  Box3 bounds;
  std::size_t uses = 1;  ///< nodes that show it
};

struct TextureInfo {
  std::string name;
  std::string source;  ///< empty: embedded
  int width = 0;       ///< 0: the image is missing
  int height = 0;
  int channels = 0;
};

struct AnimationInfo {
  std::string name;
  double seconds = 0;
  std::size_t channels = 0;
};

/// What a scene has beside its meshes.
struct SceneInfo {
  std::size_t nodes = 0;
  std::size_t shown_nodes = 0;  ///< below the roots and visible
  std::size_t roots = 0;
  std::size_t depth = 0;  ///< of the hierarchy; roots alone: 1
  std::size_t meshes = 0;
  std::size_t closed_meshes = 0;
  std::size_t instances = 0;        ///< nodes shown that have a mesh
  std::size_t shown_triangles = 0;  ///< each instance counted
  std::vector<Material> materials;
  std::vector<TextureInfo> textures;
  std::vector<Camera> cameras;
  std::vector<LightSource> lights;
  std::vector<AnimationInfo> animations;
  std::vector<std::pair<std::string, std::size_t>> skins;  ///< name, joints
  std::vector<MeshInfo> each_mesh;
};

struct VolumeInfo {
  int width = 0;
  int height = 0;
  int depth = 0;
  glm::vec3 spacing{1, 1, 1};
  glm::vec3 origin{0, 0, 0};
  float lowest = 0;  ///< of the finite samples
  float highest = 0;
  double mean = 0;
  std::size_t not_finite = 0;
};

struct DrawingInfo {
  float width = 0;  ///< of the page
  float height = 0;
  DrawingUnit unit = DrawingUnit::Pixel;
  std::size_t paths = 0;
  std::size_t shown_paths = 0;
  std::size_t segments = 0;  ///< lines, curves and closing lines
  std::size_t curves = 0;
  std::size_t points = 0;
  std::size_t not_finite_points = 0;
  std::size_t groups = 0;
  std::size_t depth = 0;  ///< of the groups shown; the whole alone: 1
  std::size_t styles = 0;
  std::size_t gradients = 0;
  std::size_t other_patterns = 0;  ///< hatches and stipples
  std::size_t clips = 0;
  std::size_t texts = 0;
};

/// What a model holds.
struct ModelInfo {
  std::string kind;  ///< "mesh", "scene", "volume", "drawing"
  std::string name;
  std::optional<UpAxis> up;   ///< none of a volume or drawing
  float metres_per_unit = 0;  ///< 0: unknown
  Box3 bounds;                ///< of what is shown, z 0 in a drawing; of a volume from its first to its last sample
  bool bounds_exact = true;   ///< false: of boxes around turned instances, where there are too many vertices
  std::optional<MeshInfo> mesh;
  std::optional<SceneInfo> scene;
  std::optional<VolumeInfo> volume;
  std::optional<DrawingInfo> drawing;
};

/// Cost  O(vertices + corners + samples + nodes), on all threads where it counts
AZULEJO_EXPORT ModelInfo model_info(const Model& model, const Run& run = {});

/// Members in snake_case; numbers that aren't known are null.
AZULEJO_EXPORT Json to_json(const ModelInfo& info);
/// Lines of a name and a value, indented by two; ends with a line's end.
AZULEJO_EXPORT std::string to_text(const ModelInfo& info);

}  // namespace azulejo
