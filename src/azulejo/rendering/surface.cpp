#include "azulejo/rendering/surface.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace azulejo {
namespace {

/// Where varying parameters are kept in FragmentBatch::values.
enum Slot : std::size_t {
  kBaseColor = 0,
  kMetallic = 4,
  kRoughness = 5,
  kOcclusion = 6,
  kSpecular = 7,
  kEmissive = 10
};

/// A coordinate of a texture, and how it changes from pixel to pixel.
struct TexturePoint {
  glm::vec2 uv{0, 0};
  glm::vec2 dx{0, 0};
  glm::vec2 dy{0, 0};
};

TexturePoint texture_point(const FragmentBatch& batch, std::size_t i, int set) {
  const CornerValues<glm::vec2>& values = batch.mesh->texcoords[set];
  if (values.empty()) return {};
  const std::size_t first = std::size_t{3} * batch.triangle[i];
  glm::vec2 corner[3];
  for (std::size_t k = 0; k < 3; ++k) {
    corner[k] = values.values[values.domain == Domain::Vertex ? batch.mesh->vertices()[first + k]
                                                              : batch.mesh->corner(first + k)];
  }
  const glm::vec2 a = corner[1] - corner[0];
  const glm::vec2 b = corner[2] - corner[0];
  return {corner[0] + batch.weights[1][i] * a + batch.weights[2][i] * b,
          batch.weights_dx[0][i] * a + batch.weights_dx[1][i] * b,
          batch.weights_dy[0][i] * a + batch.weights_dy[1][i] * b};
}

/// KHR_texture_transform: offset + R(rotation) · scale · uv.
struct TextureTransform {
  glm::vec2 column_u{1, 0};
  glm::vec2 column_v{0, 1};
  glm::vec2 offset{0, 0};

  explicit TextureTransform(const TextureUse& use) : offset(use.offset) {
    const float sine = std::sin(use.rotation);
    const float cosine = std::cos(use.rotation);
    column_u = {cosine * use.scale.x, -sine * use.scale.x};
    column_v = {sine * use.scale.y, cosine * use.scale.y};
  }
  glm::vec2 linear(glm::vec2 v) const { return column_u * v.x + column_v * v.y; }
};

/// log2 of the texels that a pixel covers along its longer side.
float level_of_detail(const TextureMap& map, glm::vec2 dx, glm::vec2 dy) {
  const glm::vec2 size(static_cast<float>(map.width()), static_cast<float>(map.height()));
  const glm::vec2 x = dx * size;
  const glm::vec2 y = dy * size;
  const float square = std::max(glm::dot(x, x), glm::dot(y, y));
  return 0.5F * std::log2(std::max(square, 1e-20F));
}

/// Calls f(i, value) with what the texture holds at each fragment.
template <class F>
void for_samples(const FragmentBatch& batch, const TextureMap* map, const TextureUse& use, F f) {
  if (map == nullptr) return;
  const int set = use.texcoord == 1 ? 1 : 0;
  const TextureTransform transform(use);
  for (std::size_t i = 0; i < batch.count; ++i) {
    const TexturePoint point = texture_point(batch, i, set);
    const float lod = level_of_detail(*map, transform.linear(point.dx), transform.linear(point.dy));
    f(i, map->sample(transform.linear(point.uv) + transform.offset, lod));
  }
}

/// Makes a parameter varying: every fragment begins with its uniform value.
float* vary(FragmentBatch& batch, Parameter& parameter, std::size_t slot) {
  float* const values = batch.values[slot].data();
  if (parameter.varying == nullptr) {
    std::fill_n(values, batch.count, parameter.uniform);
    parameter.varying = values;
  }
  return values;
}

void apply_colors(FragmentBatch& batch) {
  const CornerValues<glm::vec4>& colors = batch.mesh->colors;
  if (colors.empty()) return;
  float* base[4];
  for (std::size_t c = 0; c < 4; ++c) base[c] = vary(batch, batch.base_color[c], kBaseColor + c);
  for (std::size_t i = 0; i < batch.count; ++i) {
    const std::size_t first = std::size_t{3} * batch.triangle[i];
    glm::vec4 sum(0);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t at =
          colors.domain == Domain::Vertex ? batch.mesh->vertices()[first + k] : batch.mesh->corner(first + k);
      sum += batch.weights[k][i] * colors.values[at];
    }
    for (int c = 0; c < 4; ++c) base[c][i] *= sum[c];
  }
}

/// Turns the normal by a tangent-space normal map, with the tangents along which the texture's coordinates grow.
void apply_normal_map(FragmentBatch& batch) {
  const TextureUse& use = batch.material->material.normal_texture;
  const CornerValues<glm::vec2>& values = batch.mesh->texcoords[use.texcoord == 1 ? 1 : 0];
  if (batch.material->normal == nullptr || values.empty() || batch.mesh->kind != ShapeKind::Triangles) return;
  const TextureTransform transform(use);
  const glm::mat3 world_from_object(batch.instance->world_from_object);
  for_samples(batch, batch.material->normal, use, [&](std::size_t i, const glm::vec4& texel) {
    const std::uint32_t* const v = batch.mesh->vertices() + std::size_t{3} * batch.triangle[i];
    const std::size_t first = std::size_t{3} * batch.triangle[i];
    glm::vec3 place[3];
    glm::vec2 uv[3];
    for (std::size_t k = 0; k < 3; ++k) {
      place[k] = world_from_object * batch.mesh->mesh->positions[v[k]];
      uv[k] = transform.linear(values.values[values.domain == Domain::Vertex ? v[k] : batch.mesh->corner(first + k)]);
    }
    const glm::vec3 e1 = place[1] - place[0];
    const glm::vec3 e2 = place[2] - place[0];
    const glm::vec2 d1 = uv[1] - uv[0];
    const glm::vec2 d2 = uv[2] - uv[0];
    const float turn = d1.x * d2.y - d2.x * d1.y;
    const glm::vec3 normal(batch.normal[0][i], batch.normal[1][i], batch.normal[2][i]);
    if (turn == 0) return;
    const float sign = turn < 0 ? -1.0F : 1.0F;
    glm::vec3 tangent = sign * (e1 * d2.y - e2 * d1.y);
    tangent -= normal * glm::dot(normal, tangent);
    const float length = glm::length(tangent);
    if (!(length > 0)) return;
    tangent /= length;
    // The map's green points up its image, along which v falls.
    glm::vec3 up = glm::cross(normal, tangent);
    if (glm::dot(up, sign * (e2 * d1.x - e1 * d2.x)) > 0) up = -up;
    const glm::vec3 local = glm::vec3(texel) * 2.0F - 1.0F;
    const glm::vec3 turned = tangent * (local.x * use.strength) + up * (local.y * use.strength) + normal * local.z;
    const float size = glm::length(turned);
    if (!(size > 0)) return;
    for (std::size_t c = 0; c < 3; ++c) batch.normal[c][i] = turned[static_cast<int>(c)] / size;
  });
}

void set_uniform(FragmentBatch& batch) {
  const Material& m = batch.material->material;
  for (int c = 0; c < 4; ++c) batch.base_color[static_cast<std::size_t>(c)] = {m.base_color[c], nullptr};
  batch.metallic = {m.metallic, nullptr};
  batch.roughness = {m.roughness, nullptr};
  batch.occlusion = {1, nullptr};
  for (int c = 0; c < 3; ++c) {
    batch.specular[static_cast<std::size_t>(c)] = {m.specular[c], nullptr};
    batch.emissive[static_cast<std::size_t>(c)] = {m.emissive[c], nullptr};
  }
}

}  // namespace

void make_surface(FragmentBatch& batch, bool uv) {
  set_uniform(batch);
  apply_colors(batch);
  const RasterMaterial& raster = *batch.material;
  const Material& m = raster.material;
  if (uv) {
    for (std::size_t i = 0; i < batch.count; ++i) {
      const TexturePoint point = texture_point(batch, i, 0);
      batch.uv[0][i] = point.uv.x;
      batch.uv[1][i] = point.uv.y;
    }
  }
  if (raster.base_color != nullptr) {
    float* base[4];
    for (std::size_t c = 0; c < 4; ++c) base[c] = vary(batch, batch.base_color[c], kBaseColor + c);
    for_samples(batch, raster.base_color, m.base_color_texture, [&](std::size_t i, const glm::vec4& texel) {
      for (int c = 0; c < 4; ++c) base[c][i] *= texel[c];
    });
  }
  if (raster.metallic_roughness != nullptr) {
    float* const metallic = vary(batch, batch.metallic, kMetallic);
    float* const roughness = vary(batch, batch.roughness, kRoughness);
    for_samples(batch, raster.metallic_roughness, m.metallic_roughness_texture,
                [&](std::size_t i, const glm::vec4& texel) {
                  roughness[i] *= texel.g;
                  metallic[i] *= texel.b;
                });
  }
  if (raster.occlusion != nullptr) {
    float* const occlusion = vary(batch, batch.occlusion, kOcclusion);
    const float strength = m.occlusion_texture.strength;
    for_samples(batch, raster.occlusion, m.occlusion_texture,
                [&](std::size_t i, const glm::vec4& texel) { occlusion[i] = 1 + strength * (texel.r - 1); });
  }
  const auto tint = [&](const TextureMap* map, const TextureUse& use, std::array<Parameter, 3>& color,
                        std::size_t slot) {
    if (map == nullptr) return;
    float* channels[3];
    for (std::size_t c = 0; c < 3; ++c) channels[c] = vary(batch, color[c], slot + c);
    for_samples(batch, map, use, [&](std::size_t i, const glm::vec4& texel) {
      for (int c = 0; c < 3; ++c) channels[c][i] *= texel[c];
    });
  };
  tint(raster.emissive, m.emissive_texture, batch.emissive, kEmissive);
  tint(raster.specular, m.specular_texture, batch.specular, kSpecular);
  apply_normal_map(batch);
}

}  // namespace azulejo
