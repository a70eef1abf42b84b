#include "azulejo/rendering/lighting.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "azulejo/core/error.h"
#include "azulejo/rendering/camera_basis.h"
#include "azulejo/rendering/framing.h"

namespace azulejo {
namespace {

constexpr std::size_t kMostLights = 256;
constexpr float kInversePi = 0.318309886F;

bool finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Cosines of a spot's cones, a hair apart: shading divides by their difference.
void set_cones(ShadingLight& light, const LightSource& source) {
  const float outer = std::clamp(source.outer_cone, 0.001F, 1.5707963F);
  const float inner = std::clamp(source.inner_cone, 0.0F, outer);
  light.cos_outer = std::cos(outer);
  light.cos_inner = std::max(std::cos(inner), light.cos_outer + 1e-4F);
}

/// False where the light has no place, no direction or no light.
bool shading_light(const LightSource& source, const glm::mat4& world_from_node, float units_per_metre,
                   ShadingLight& light) {
  light.kind = source.kind;
  light.position = glm::vec3(world_from_node[3]);
  const glm::dvec3 axis(world_from_node[2]);
  const double length = glm::length(axis);
  light.direction = length > 0 && std::isfinite(length) ? glm::vec3(-axis / length) : glm::vec3(0, 0, -1);
  light.color = source.color * (source.intensity * kInversePi);
  if (source.kind != LightKind::Directional) light.color *= units_per_metre * units_per_metre;
  light.range = source.range > 0 ? source.range * units_per_metre : 0;
  if (source.kind == LightKind::Spot) set_cones(light, source);
  const bool dark = !(light.color.x > 0 || light.color.y > 0 || light.color.z > 0);
  return !dark && finite(light.color) && finite(light.position) && std::isfinite(light.range);
}

std::vector<ShadingLight> lights_of(const Scene& scene, const Run& run) {
  std::vector<ShadingLight> lights;
  if (scene.lights.empty()) return lights;
  const float units_per_metre = scene.space.metres_per_unit > 0 ? 1 / scene.space.metres_per_unit : 1;
  std::size_t count = 0;
  for (const PlacedNode& placed : walk(scene)) {
    const LightId id = scene.nodes[placed.node.index].light;
    ShadingLight light;
    if (!placed.visible || !id ||
        !shading_light(scene.lights[id.index], placed.world_from_node, units_per_metre, light)) {
      continue;
    }
    if (++count <= kMostLights) lights.push_back(light);
  }
  if (count > kMostLights) warn(run, fmt::format("{} lights; the first {} are used", count, kMostLights));
  return lights;
}

float luminance(const glm::vec3& color) { return 0.2126F * color.x + 0.7152F * color.y + 0.0722F * color.z; }

/// What a white surface in the middle of the scene sends back at most, over the directions it may face.
float brightest(const std::vector<ShadingLight>& lights, const ScenePoints& points) {
  const glm::vec3 center(points.center());
  const auto radius = static_cast<float>(points.radius());
  std::vector<glm::vec3> arriving;  // the way to the light, as long as it is bright
  for (const ShadingLight& light : lights) {
    const float bright = luminance(light.color);
    if (light.kind == LightKind::Directional) {
      arriving.push_back(-light.direction * bright);
      continue;
    }
    const glm::vec3 way = light.position - center;
    const float distance = std::max(glm::length(way), 1e-6F * radius);
    // A lamp within the scene is taken at half its size: near surfaces may shine.
    const float reach = std::max(distance, 0.5F * radius);
    arriving.push_back(way / distance * (bright / (reach * reach)));
  }
  float most = 0;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const glm::vec3 normal = glm::normalize(glm::vec3(x, y, z));
        float sum = 0;
        for (const glm::vec3& each : arriving) sum += std::max(0.0F, glm::dot(normal, each));
        most = std::max(most, sum);
      }
    }
  }
  return most;
}

ShadingLight directional(const glm::mat3& world_from_view, const glm::vec3& from, float brightness) {
  ShadingLight light;
  light.direction = world_from_view * -glm::normalize(from);
  light.color = glm::vec3(brightness);
  return light;
}

void set_ambient(Lighting& lighting, float brightness) {
  // The ground sends back nearly half of the sky's light: what faces down is darker, not black, and metals see a horizon.
  lighting.sky = glm::vec3(brightness);
  lighting.ground = glm::vec3(0.45F * brightness);
}

}  // namespace

ChosenLighting choose_lighting(const Scene& scene, const View& view, const LightingOptions& options, const Run& run) {
  ChosenLighting chosen;
  std::vector<ShadingLight> own;
  if (options.lights.value_or(LightChoice::File) == LightChoice::File) own = lights_of(scene, run);
  chosen.lights = options.lights.value_or(own.empty() ? LightChoice::Default : LightChoice::File);
  if (chosen.lights == LightChoice::File && own.empty()) {
    throw Error(Error::Argument, "lights: file, expected default or headlight: the scene has no light that shines");
  }
  Lighting& lighting = chosen.lighting;
  lighting.up = glm::vec3(up_vector(scene.space.up));
  const glm::mat3 world_from_view = glm::transpose(glm::mat3(view.view_from_world));
  switch (chosen.lights) {
    case LightChoice::File: {
      const float most = brightest(own, ScenePoints(scene, run));
      if (most > 0 && std::isfinite(1 / most)) chosen.exposure = 1 / most;
      lighting.lights = std::move(own);
      set_ambient(lighting, options.ambient.value_or(0.08F) / chosen.exposure);
      break;
    }
    // The brightnesses were chosen on the default material: what faces the key is just below white, and the darkest
    // side keeps a sixth of that.
    case LightChoice::Default:
      lighting.lights = {directional(world_from_view, {-0.6F, 0.7F, 0.6F}, 0.72F),
                         directional(world_from_view, {0.9F, 0.1F, 0.5F}, 0.14F),
                         directional(world_from_view, {0.25F, 0.7F, -0.8F}, 0.35F)};
      set_ambient(lighting, options.ambient.value_or(0.26F));
      break;
    case LightChoice::Headlight:
      lighting.lights = {directional(world_from_view, {0, 0, 1}, 0.85F)};
      set_ambient(lighting, options.ambient.value_or(0.12F));
      break;
  }
  return chosen;
}

}  // namespace azulejo
