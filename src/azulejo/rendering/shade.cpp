#include "azulejo/rendering/shade.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "azulejo/rendering/raster.h"
#include "azulejo/rendering/surface.h"

namespace azulejo {
namespace {

const std::uint32_t* vertices_of(const FragmentBatch& batch, std::size_t i) {
  return batch.mesh->vertices() + std::size_t{3} * batch.triangle[i];
}

/// The corners' places in the picture, and their normals. True if one of them was clipped.
bool fetch_corners(FragmentBatch& batch, const ShadingContext& context) {
  const ScreenVertex* const vertices = context.vertices.data() + batch.instance->first_vertex;
  const RasterMesh& mesh = *batch.mesh;
  const bool by_vertex = mesh.normals.domain == Domain::Vertex;
  const bool have_normals = !mesh.normals.empty();
  const glm::vec4* const values = mesh.normals.values.data();
  // The normals of what is seen lie all over memory: they are asked for some fragments ahead.
  constexpr std::size_t kAhead = 12;
  bool clipped = false;
  for (std::size_t i = 0; i < batch.count;) {
    // Neighbours mostly see the same triangle.
    const std::uint32_t triangle = batch.triangle[i];
    const std::uint32_t* const v = vertices_of(batch, i);
    const ScreenVertex corners[3] = {vertices[v[0]], vertices[v[1]], vertices[v[2]]};
    glm::vec4 normals[3] = {};
    for (std::size_t k = 0; k < 3; ++k) {
      clipped = clipped || corners[k].x != corners[k].x;
      if (have_normals) normals[k] = values[by_vertex ? v[k] : mesh.corner(std::size_t{3} * triangle + k)];
    }
    for (; i < batch.count && batch.triangle[i] == triangle; ++i) {
      for (std::size_t k = 0; k < 3; ++k) batch.corners[k][i] = corners[k];
      for (std::size_t k = 0; k < 3; ++k) batch.corner_normals[k][i] = normals[k];
    }
    if (i + kAhead < batch.count && have_normals) {
      const std::uint32_t* const ahead = vertices_of(batch, i + kAhead);
      const std::size_t first = std::size_t{3} * batch.triangle[i + kAhead];
      for (std::size_t k = 0; k < 3; ++k) __builtin_prefetch(values + (by_vertex ? ahead[k] : mesh.corner(first + k)));
    }
  }
  return clipped;
}

/// Weights of a triangle with a corner that isn't in the picture (behind the camera): in homogeneous coordinates.
/// Source: Olano and Greer, Triangle scan conversion using 2D homogeneous coordinates, 1997
void weights_of_clipped(FragmentBatch& batch, std::size_t i, const ShadingContext& context,
                        const glm::mat4& clip_from_object) {
  const std::uint32_t* const v = vertices_of(batch, i);
  glm::dvec3 corner[3];
  double z[3];
  for (int k = 0; k < 3; ++k) {
    const bool made = context.program_vertices != nullptr && !context.program_vertices->clip.empty();
    const glm::vec4 clip = made ? context.program_vertices->clip[batch.instance->first_vertex + v[k]]
                                : to_clip(clip_from_object, batch.mesh->mesh->positions[v[k]]);
    corner[k] = glm::dvec3(clip.x, clip.y, clip.w);
    z[k] = clip.z;
  }
  const glm::dvec3 pixel((batch.x[i] - context.transform.offset_x) / context.transform.scale_x,
                         (batch.y[i] - context.transform.offset_y) / context.transform.scale_y, 1.0);
  const glm::dvec3 sides[3] = {glm::cross(corner[1], corner[2]), glm::cross(corner[2], corner[0]),
                               glm::cross(corner[0], corner[1])};
  const double whole = glm::dot(corner[0], sides[0]);
  const double sign = whole < 0 ? -1 : 1;
  double weight[3];
  double sum = 0;
  for (int k = 0; k < 3; ++k) sum += weight[k] = std::max(0.0, sign * glm::dot(sides[k], pixel));
  if (!(sum > 0)) {
    weight[0] = sum = 1;
    weight[1] = weight[2] = 0;
  }
  double w = 0;
  double depth = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    batch.weights[k][i] = static_cast<float>(weight[k] / sum);
    w += weight[k] / sum * corner[k].z;
    depth += weight[k] / sum * z[k];
  }
  const double dx = sign / context.transform.scale_x;
  const double dy = sign / context.transform.scale_y;
  const double sum_x = (sides[0].x + sides[1].x + sides[2].x) * dx;
  const double sum_y = (sides[0].y + sides[1].y + sides[2].y) * dy;
  for (std::size_t k = 1; k < 3; ++k) {
    batch.weights_dx[k - 1][i] = static_cast<float>((sides[k].x * dx - weight[k] / sum * sum_x) / sum);
    batch.weights_dy[k - 1][i] = static_cast<float>((sides[k].y * dy - weight[k] / sum * sum_y) / sum);
  }
  batch.w[i] = static_cast<float>(w);
  batch.z[i] = static_cast<float>(depth / w);
  // Homogeneous coordinates have y up, pixels down: the sense of the corners is the other one.
  batch.facing[i] = static_cast<float>(sign);
}

void repair_clipped(FragmentBatch& batch, const ShadingContext& context) {
  const glm::mat4 clip_from_object = context.clip_from_world * batch.instance->world_from_object;
  for (std::size_t i = 0; i < batch.count; ++i) {
    const bool clipped =
        std::isnan(batch.corners[0][i].x) || std::isnan(batch.corners[1][i].x) || std::isnan(batch.corners[2][i].x);
    if (clipped) weights_of_clipped(batch, i, context, clip_from_object);
  }
}

/// With flat shading the light falls on a face's centre: all its fragments are one colour.
void use_faces(FragmentBatch& batch) {
  const RasterInstance& instance = *batch.instance;
  for (std::size_t i = 0; i < batch.count; ++i) {
    const std::uint32_t face = batch.mesh->face(batch.triangle[i]);
    const glm::vec3 center(instance.world_from_object * batch.mesh->face_centers[face]);
    glm::vec3 normal = instance.world_from_normal * glm::vec3(batch.mesh->face_normals[face]);
    const float length = glm::length(normal);
    if (length > 0) normal *= batch.facing[i] / length;
    for (std::size_t c = 0; c < 3; ++c) {
      batch.position[c][i] = center[static_cast<int>(c)];
      batch.normal[c][i] = normal[static_cast<int>(c)];
    }
  }
}

/// Lines and points without normals face the camera.
void face_camera(FragmentBatch& batch, const ShadingContext& context) {
  const glm::vec3 toward = -context.view.forward;
  for (std::size_t c = 0; c < 3; ++c) {
    std::fill_n(batch.normal[c].begin(), batch.count, toward[static_cast<int>(c)]);
  }
}

/// Gouraud: the light of the three corners, blended.
void light_corners(FragmentBatch& batch, const ShadingContext& context) {
  std::array<FragmentBatch::Column<float>, 3> sum{};
  const RasterInstance& instance = *batch.instance;
  const Array<glm::vec3>& positions = batch.mesh->mesh->positions;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < batch.count; ++i) {
      const glm::vec3 place(instance.world_from_object * glm::vec4(positions[vertices_of(batch, i)[k]], 1.0F));
      glm::vec3 normal = instance.world_from_normal * glm::vec3(batch.corner_normals[k][i]);
      const float length = glm::length(normal);
      if (length > 0) normal *= batch.facing[i] / length;
      for (std::size_t c = 0; c < 3; ++c) {
        batch.position[c][i] = place[static_cast<int>(c)];
        batch.normal[c][i] = normal[static_cast<int>(c)];
      }
    }
    kernels::light(batch, context.view, *context.lighting);
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t i = 0; i < batch.count; ++i) sum[c][i] += batch.weights[k][i] * batch.color[c][i];
    }
  }
  for (std::size_t c = 0; c < 3; ++c) std::copy_n(sum[c].begin(), batch.count, batch.color[c].begin());
}

/// The fragment function in place of light.
void run_fragment_program(FragmentBatch& batch, const ShadingContext& context) {
  const Program& program = *context.program;
  constexpr std::size_t kMostVaryings = 16;
  std::array<FragmentBatch::Column<float>, kMostVaryings> columns;
  const float* pointers[kMostVaryings];
  const auto varyings = static_cast<std::size_t>(program.varyings);
  const Array<float>& values = context.program_vertices->varyings;
  for (std::size_t i = 0; i < batch.count && !values.empty(); ++i) {
    const std::uint32_t* const v = vertices_of(batch, i);
    const float* corner[3];
    for (int k = 0; k < 3; ++k) corner[k] = values.data() + (batch.instance->first_vertex + v[k]) * varyings;
    for (std::size_t c = 0; c < varyings; ++c) {
      columns[c][i] =
          batch.weights[0][i] * corner[0][c] + batch.weights[1][i] * corner[1][c] + batch.weights[2][i] * corner[2][c];
    }
  }
  FragmentBatch::Column<std::uint32_t> faces;
  for (std::size_t i = 0; i < batch.count; ++i) faces[i] = batch.mesh->face(batch.triangle[i]);
  FragmentView view;
  view.count = batch.count;
  view.x = batch.x.data();
  view.y = batch.y.data();
  for (std::size_t c = 0; c < 3; ++c) {
    view.position[c] = batch.position[c].data();
    view.normal[c] = batch.normal[c].data();
  }
  for (std::size_t c = 0; c < 2; ++c) view.texcoord[c] = batch.uv[c].data();
  for (std::size_t c = 0; c < varyings; ++c) {
    if (values.empty()) columns[c].fill(0);
    pointers[c] = columns[c].data();
  }
  view.varyings = pointers;
  view.face = faces.data();
  view.object = batch.instance->object;
  view.material = static_cast<std::uint32_t>(batch.material - context.scene->materials.data());
  for (std::size_t c = 0; c < 4; ++c) {
    const Parameter& base = batch.base_color[c];
    for (std::size_t i = 0; i < batch.count; ++i)
      batch.color[c][i] = base.varying != nullptr ? base.varying[i] : base.uniform;
    view.color[c] = batch.color[c].data();
  }
  program.fragment(view);
}

}  // namespace

ShadingView shading_view(const View& view) {
  ShadingView result;
  result.perspective = view.perspective;
  const glm::dmat4 world_from_view = glm::inverse(glm::dmat4(view.view_from_world));
  result.eye = glm::vec3(world_from_view[3]);
  result.forward = glm::normalize(-glm::vec3(world_from_view[2]));
  // Rows of the projection that give x, y and w (perspective) or z: solved for the position.
  const glm::dmat4 p(view.clip_from_view);
  const int third = view.perspective ? 3 : 2;
  glm::dmat3 solve;
  glm::dvec3 constant;
  const int rows[3] = {0, 1, third};
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) solve[c][r] = p[c][rows[r]];
    constant[r] = p[3][rows[r]];
  }
  const glm::dmat3 inverse = glm::dmat3(world_from_view) * glm::inverse(solve);
  result.base = glm::vec3(glm::dvec3(world_from_view[3]) - inverse * constant);
  const ScreenTransform t = screen_transform(view.viewport);
  const glm::dvec3 per_x = inverse[0] / static_cast<double>(t.scale_x);
  const glm::dvec3 per_y = inverse[1] / static_cast<double>(t.scale_y);
  glm::dvec3 at_zero = -per_x * static_cast<double>(t.offset_x) - per_y * static_cast<double>(t.offset_y);
  if (view.perspective) {
    at_zero += inverse[2];
  } else {
    result.per_z = glm::vec3(inverse[2]);
  }
  result.per_x = glm::vec3(per_x);
  result.per_y = glm::vec3(per_y);
  result.at_zero = glm::vec3(at_zero);
  return result;
}

void interpolate_batch(FragmentBatch& batch, const ShadingContext& context) {
  const bool clipped = fetch_corners(batch, context);
  const RasterMaterial& material = *batch.material;
  kernels::interpolate_weights(batch, material.textured() || context.needs_uv);
  if (clipped && batch.mesh->kind == ShapeKind::Triangles) repair_clipped(batch, context);
  if (batch.mesh->kind != ShapeKind::Triangles) {
    std::fill_n(batch.facing.begin(), batch.count, 1.0F);  // of lines rounding would decide
  } else if (batch.instance->mirrored) {
    for (std::size_t i = 0; i < batch.count; ++i) batch.facing[i] = -batch.facing[i];
  }
  kernels::interpolate_positions(batch, context.view);
  if (!batch.mesh->normals.empty()) {
    kernels::interpolate_normals(batch);
  } else {
    face_camera(batch, context);
  }
  make_surface(batch, context.needs_uv);
}

void light_batch(FragmentBatch& batch, const ShadingContext& context) {
  if (context.program != nullptr && context.program->fragment != nullptr) return run_fragment_program(batch, context);
  const bool surfaces = batch.mesh->kind == ShapeKind::Triangles;
  if (surfaces && context.shading == Shading::Flat) {
    use_faces(batch);
  } else if (surfaces && context.shading == Shading::Gouraud) {
    return light_corners(batch, context);
  }
  kernels::light(batch, context.view, *context.lighting);
}

}  // namespace azulejo
