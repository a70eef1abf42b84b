#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

#include "azulejo/rendering/raster_scene.h"
#include "azulejo/rendering/screen.h"
#include "azulejo/rendering/shading_light.h"
#include "azulejo/rendering/vertex_stage.h"
#include "azulejo/rendering/view.h"
#include "azulejo/rendering/zbuffer.h"

namespace azulejo {

/// A view as shading needs it: from a pixel and its depth back to the world.
struct ShadingView {
  bool perspective = true;
  glm::vec3 eye{0, 0, 0};
  glm::vec3 forward{0, 0, -1};
  /// position = base + s · (at_zero + x · per_x + y · per_y) + z · per_z, with s the clip w in perspective, else 1.
  glm::vec3 base{0, 0, 0};
  glm::vec3 at_zero{0, 0, 0};
  glm::vec3 per_x{0, 0, 0};
  glm::vec3 per_y{0, 0, 0};
  glm::vec3 per_z{0, 0, 0};
};
ShadingView shading_view(const View& view);

/// A quantity of a batch: one value for all fragments, or one for each.
struct Parameter {
  float uniform = 0;
  const float* varying = nullptr;
};

/// Fragments of one instance and one material that are shaded together. Filled from above to below.
struct FragmentBatch {
  static constexpr std::size_t kMost = 64;
  /// Longer than it need be: columns whose distance is a power of 2 would share the same few lines of the cache.
  template <class T>
  using Column = std::array<T, kMost + 16>;

  // Given: which pixels (their centres) see which triangles.
  const RasterInstance* instance = nullptr;
  const RasterMesh* mesh = nullptr;
  const RasterMaterial* material = nullptr;
  std::size_t count = 0;
  alignas(64) Column<float> x;
  alignas(64) Column<float> y;
  Column<std::uint32_t> triangle;  ///< number in the instance

  // Fetched: the triangles' corners.
  alignas(64) std::array<Column<ScreenVertex>, 3> corners;
  alignas(64) std::array<Column<glm::vec4>, 3> corner_normals;

  // Interpolated. Weights are perspective-correct, not negative, their sum is 1.
  alignas(64) std::array<Column<float>, 3> weights;
  alignas(64) std::array<Column<float>, 2> weights_dx;  ///< of the second and third corner, per pixel to the right
  alignas(64) std::array<Column<float>, 2> weights_dy;
  alignas(64) Column<float> w;                        ///< clip w
  alignas(64) Column<float> z;                        ///< depth buffer value
  alignas(64) Column<float> facing;                   ///< 1 seen from the front, -1 from behind
  alignas(64) std::array<Column<float>, 3> position;  ///< in the world
  alignas(64) std::array<Column<float>, 3> normal;    ///< in the world, unit length, toward the side that is seen
  alignas(64) std::array<Column<float>, 2> uv;

  // The surface. Varying parameters point into `values`.
  std::array<Parameter, 4> base_color;
  Parameter metallic;
  Parameter roughness;
  Parameter occlusion;
  std::array<Parameter, 3> specular;
  std::array<Parameter, 3> emissive;
  alignas(64) std::array<Column<float>, 13> values;

  // Shaded: linear light, straight.
  alignas(64) std::array<Column<float>, 4> color;
};

/// What shading needs beside the fragments.
struct ShadingContext {
  const RasterScene* scene = nullptr;
  std::span<const ScreenVertex> vertices;
  ShadingView view;
  const Lighting* lighting = nullptr;
  Shading shading = Shading::Phong;
  glm::mat4 clip_from_world{1.0F};
  ScreenTransform transform;
  bool needs_uv = false;             ///< FragmentBatch::uv is wanted even where nothing is textured
  const Program* program = nullptr;  ///< null: none
  const ProgramVertices* program_vertices = nullptr;
};

/// Everything of a batch from `corners` down to base colour and opacity.
void interpolate_batch(FragmentBatch& batch, const ShadingContext& context);
/// The colour.
void light_batch(FragmentBatch& batch, const ShadingContext& context);

namespace kernels {

/// weights, w, z, facing, and with `derivatives` weights_dx and weights_dy, from `corners`.
void interpolate_weights(FragmentBatch& batch, bool derivatives);
/// position from x, y, w, z.
void interpolate_positions(FragmentBatch& batch, const ShadingView& view);
/// normal from corner_normals.
void interpolate_normals(FragmentBatch& batch);
/// color from position, normal and the surface.
void light(FragmentBatch& batch, const ShadingView& view, const Lighting& lighting);
/// color as vectors, with 1 in place of opacity if `opaque`; `result` has room for 16 more than `count`.
void interleave_colors(const FragmentBatch& batch, bool opaque, glm::vec4* result);

}  // namespace kernels
}  // namespace azulejo
