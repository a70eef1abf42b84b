#include "azulejo/rendering/vertex_stage.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <type_traits>

#include "azulejo/rendering/program.h"
#include "azulejo/rendering/raster_scene.h"

namespace azulejo {

ScreenTransform screen_transform(const Rect& viewport) {
  const float half_width = 0.5F * static_cast<float>(viewport.width);
  const float half_height = 0.5F * static_cast<float>(viewport.height);
  return {half_width, static_cast<float>(viewport.x) + half_width, -half_height,
          static_cast<float>(viewport.y) + half_height};
}

glm::vec4 to_clip(const glm::mat4& m, const glm::vec3& p) {
  glm::vec4 clip;
  for (int row = 0; row < 4; ++row) clip[row] = ((m[0][row] * p.x + m[1][row] * p.y) + m[2][row] * p.z) + m[3][row];
  return clip;
}

ScreenVertex to_screen(const glm::vec4& clip, const ScreenTransform& transform) {
  const float inverse_w = 1.0F / clip.w;
  ScreenVertex vertex{(clip.x * inverse_w) * transform.scale_x + transform.offset_x,
                      (clip.y * inverse_w) * transform.scale_y + transform.offset_y, clip.z * inverse_w, inverse_w};
  const bool inside = clip.z >= 0 && clip.z <= clip.w && clip.w > 0 && std::fabs(vertex.x) <= kGuardBand &&
                      std::fabs(vertex.y) <= kGuardBand;
  if (!inside) vertex.x = std::numeric_limits<float>::quiet_NaN();
  return vertex;
}

void run_vertex_program(const RasterScene& scene, const RasterInstance& instance, const Program& program,
                        const glm::mat4& clip_from_world, std::size_t from, std::size_t to, ProgramVertices& result) {
  constexpr std::size_t kBatch = 1024;
  const RasterMesh& mesh = scene.meshes[instance.mesh];
  const auto part = [](const auto& values, std::size_t begin, std::size_t count) {
    using T = typename std::decay_t<decltype(values.values)>::value_type;
    const bool known = !values.empty() && values.domain == Domain::Vertex;
    return known ? std::span<const T>(values.values.data() + begin, count) : std::span<const T>();
  };
  const glm::mat4 clip_from_object = clip_from_world * instance.world_from_object;
  const auto columns = static_cast<std::size_t>(program.varyings);
  for (std::size_t begin = from; begin < to; begin += kBatch) {
    const std::size_t count = std::min(kBatch, to - begin);
    VertexBatch batch;
    batch.positions = {mesh.mesh->positions.data() + begin, count};
    batch.normals = part(mesh.normals, begin, count);
    batch.texcoords = part(mesh.texcoords[0], begin, count);
    batch.colors = part(mesh.colors, begin, count);
    batch.first_vertex = begin;
    batch.object = instance.object;
    batch.world_from_object = instance.world_from_object;
    batch.clip_from_world = clip_from_world;
    batch.clip = {result.clip.data() + instance.first_vertex + begin, count};
    batch.varyings = {result.varyings.data() + (instance.first_vertex + begin) * columns, count * columns};
    for (std::size_t i = 0; i < count; ++i) batch.clip[i] = to_clip(clip_from_object, batch.positions[i]);
    std::fill(batch.varyings.begin(), batch.varyings.end(), 0.0F);
    program.vertex(batch);
  }
}

}  // namespace azulejo
