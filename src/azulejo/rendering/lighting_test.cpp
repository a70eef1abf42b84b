#include "azulejo/rendering/lighting.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>

#include "azulejo/core/error.h"
#include "azulejo/rendering/camera_choice.h"
#include "azulejo/rendering/rendering_testing.h"

namespace azulejo {
namespace {

constexpr float kPi = 3.14159265F;

Scene box() { return scene_of_points(box_corners({-1, -1, -1}, {1, 1, 1})); }
View view_of(const Scene& scene) { return choose_camera(scene, {}, 100, 100).view; }

void add_light(Scene& scene, const LightSource& light, const glm::mat4& placement) {
  Node node;
  node.light = LightId(scene.lights.size());
  node.placement = placement;
  scene.lights.push_back(light);
  scene.roots.emplace_back(scene.nodes.size());
  scene.nodes.push_back(node);
}

TEST(Lighting, WithoutLightsThreeMoveWithTheCamera) {
  const Scene scene = box();
  for (const float azimuth : {0.0F, 77.0F, 200.0F}) {
    CameraOptions options;
    options.azimuth_deg = azimuth;
    const View view = choose_camera(scene, options, 100, 100).view;
    const ChosenLighting chosen = choose_lighting(scene, view);
    EXPECT_EQ(chosen.lights, LightChoice::Default);
    EXPECT_EQ(chosen.exposure, 1);
    ASSERT_EQ(chosen.lighting.lights.size(), 3U);
    const glm::mat3 view_from_world(view.view_from_world);
    const glm::vec3 key = view_from_world * chosen.lighting.lights[0].direction;
    const glm::vec3 fill = view_from_world * chosen.lighting.lights[1].direction;
    const glm::vec3 rim = view_from_world * chosen.lighting.lights[2].direction;
    // Light travels: the key to the right, down and away.
    EXPECT_TRUE(key.x > 0 && key.y < 0 && key.z < 0);
    EXPECT_TRUE(fill.x < 0 && fill.z < 0);
    EXPECT_TRUE(rim.y < 0 && rim.z > 0);
    EXPECT_GT(chosen.lighting.lights[0].color.x, chosen.lighting.lights[1].color.x);
    for (const ShadingLight& light : chosen.lighting.lights) EXPECT_NEAR(glm::length(light.direction), 1, 1e-5);
    EXPECT_GT(chosen.lighting.sky.x, chosen.lighting.ground.x);
    EXPECT_EQ(chosen.lighting.up, glm::vec3(0, 1, 0));
  }
}

TEST(Lighting, DefaultLightsNeitherDrownNorBurn) {
  const Scene scene = box();
  const View view = view_of(scene);
  const Lighting lighting = choose_lighting(scene, view).lighting;
  const glm::mat3 world_from_view = glm::transpose(glm::mat3(view.view_from_world));
  float most = 0;
  float least = 10;
  // Normals that the camera sees.
  for (int i = 0; i < 50; ++i) {
    for (int j = 1; j < 25; ++j) {
      const float around = 2 * kPi * static_cast<float>(i) / 50;
      const float off = 0.5F * kPi * static_cast<float>(j) / 25;
      const glm::vec3 normal = world_from_view * glm::vec3(std::cos(around) * std::sin(off),
                                                           std::sin(around) * std::sin(off), std::cos(off));
      float sum = glm::mix(lighting.ground.x, lighting.sky.x, 0.5F * (glm::dot(normal, lighting.up) + 1));
      for (const ShadingLight& light : lighting.lights) {
        sum += light.color.x * std::max(0.0F, -glm::dot(normal, light.direction));
      }
      most = std::max(most, sum);
      least = std::min(least, sum);
    }
  }
  EXPECT_LT(most, 1.05F);
  EXPECT_GT(most, 0.8F);
  EXPECT_GT(least, 0.1F);
}

TEST(Lighting, FileLightsStandInTheWorld) {
  Scene scene = box();
  scene.space.metres_per_unit = 0.01F;
  add_light(scene, {.name = {}, .color = {1, 0.5F, 0}, .intensity = kPi},
            glm::rotate(glm::mat4(1), -0.5F * kPi, {1, 0, 0}));
  add_light(scene, {.name = {}, .kind = LightKind::Point, .intensity = kPi, .range = 2},
            glm::translate(glm::mat4(1), {5, 6, 7}) * glm::scale(glm::mat4(1), glm::vec3(9)));
  add_light(scene, {.name = {}, .kind = LightKind::Spot, .inner_cone = 0.2F, .outer_cone = 0.2F}, glm::mat4(1));
  const ChosenLighting chosen = choose_lighting(scene, view_of(scene));
  EXPECT_EQ(chosen.lights, LightChoice::File);
  const auto& lights = chosen.lighting.lights;
  ASSERT_EQ(lights.size(), 3U);
  EXPECT_LT(glm::length(lights[0].direction - glm::vec3(0, -1, 0)), 1e-6);
  EXPECT_NEAR(lights[0].color.x, 1, 1e-5) << "π lux on white is white";
  EXPECT_NEAR(lights[0].color.y, 0.5, 1e-5);
  EXPECT_EQ(lights[1].position, glm::vec3(5, 6, 7));
  EXPECT_NEAR(lights[1].color.x / 10000, 1, 1e-4) << "a metre is 100 units";
  EXPECT_NEAR(lights[1].range, 200, 1e-3);
  EXPECT_GT(lights[2].cos_inner, lights[2].cos_outer);
}

TEST(Lighting, ExposureMakesTheBrightestWhite) {
  for (const float intensity : {0.001F, 3.0F, 50000.0F}) {
    Scene sun = box();
    add_light(sun, {.name = {}, .intensity = intensity * kPi}, glm::mat4(1));
    const ChosenLighting chosen = choose_lighting(sun, view_of(sun));
    EXPECT_NEAR(chosen.exposure * intensity, 1, 1e-4);
    EXPECT_NEAR(chosen.lighting.sky.x * chosen.exposure, 0.08, 1e-5);
    Scene lamp = box();
    add_light(lamp, {.name = {}, .kind = LightKind::Point, .intensity = intensity * kPi},
              glm::translate(glm::mat4(1), {0, 10, 0}));
    EXPECT_NEAR(choose_lighting(lamp, view_of(lamp)).exposure * intensity / 100, 1, 1e-4);
  }
}

TEST(Lighting, LightsThatDontShineAreLeftOut) {
  Scene scene = box();
  add_light(scene, {.name = {}, .intensity = 0}, glm::mat4(1));
  add_light(scene, {.name = {}, .intensity = -3}, glm::mat4(1));
  add_light(scene, {.name = {}, .intensity = std::numeric_limits<float>::infinity()}, glm::mat4(1));
  add_light(scene, {.name = {}, .kind = LightKind::Point}, glm::mat4(std::nanf("")));
  add_light(scene, {}, glm::mat4(1));
  scene.nodes.back().visible = false;
  EXPECT_EQ(choose_lighting(scene, view_of(scene)).lights, LightChoice::Default);
  EXPECT_THROW(choose_lighting(scene, view_of(scene), {.lights = LightChoice::File}), Error);
}

TEST(Lighting, OptionsDecide) {
  Scene scene = box();
  add_light(scene, {}, glm::mat4(1));
  const View view = view_of(scene);
  EXPECT_EQ(choose_lighting(scene, view, {.lights = LightChoice::Default}).lighting.lights.size(), 3U);
  const ChosenLighting headlight = choose_lighting(scene, view, {.lights = LightChoice::Headlight, .ambient = 0.5F});
  ASSERT_EQ(headlight.lighting.lights.size(), 1U);
  EXPECT_EQ(headlight.lighting.sky, glm::vec3(0.5F));
  const glm::vec3 seen = glm::mat3(view.view_from_world) * headlight.lighting.lights[0].direction;
  EXPECT_LT(glm::length(seen - glm::vec3(0, 0, -1)), 1e-5);
}

TEST(Lighting, MoreLightsThanFitAreSaid) {
  Scene scene = box();
  for (int i = 0; i < 300; ++i) add_light(scene, {}, glm::mat4(1));
  azulejo::Run run;
  std::string warning;
  run.warn = [&](const std::string& message) { warning = message; };
  EXPECT_EQ(choose_lighting(scene, view_of(scene), {}, run).lighting.lights.size(), 256U);
  EXPECT_EQ(warning, "300 lights; the first 256 are used");
}

}  // namespace
}  // namespace azulejo
