#include "azulejo/modelling/animate.h"

#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "azulejo/core/error.h"
#include "azulejo/io/model_io.h"
#include "azulejo/modelling/flatten.h"
#include "azulejo/modelling/scene_testing.h"

namespace azulejo {
namespace {

using testing::add_mesh;
using testing::add_node;

Scene animated(AnimatedProperty property, KeyInterpolation interpolation, Array<float> times, Array<float> values) {
  Scene scene;
  Mesh mesh = testing::triangle();
  mesh.morph_targets.resize(2);
  add_node(scene, add_mesh(scene, std::move(mesh)));
  Animation animation;
  animation.channels.push_back({NodeId(0), property, interpolation, std::move(times), std::move(values)});
  scene.animations.push_back(std::move(animation));
  return scene;
}

Placement placement_at(const Scene& scene, float seconds) {
  return std::get<Placement>(animate(scene, 0, seconds).nodes[0].placement);
}

TEST(Animate, MovesLinearlyAndStandsStillOutside) {
  const Scene scene =
      animated(AnimatedProperty::Translation, KeyInterpolation::Linear, {1, 2, 4}, {0, 0, 0, 10, 0, 0, 10, 20, 0});
  EXPECT_EQ(placement_at(scene, 0).translation, glm::vec3(0, 0, 0));
  EXPECT_EQ(placement_at(scene, 1.5F).translation, glm::vec3(5, 0, 0));
  EXPECT_EQ(placement_at(scene, 2).translation, glm::vec3(10, 0, 0));
  EXPECT_EQ(placement_at(scene, 2.5F).translation, glm::vec3(10, 5, 0));
  EXPECT_EQ(placement_at(scene, 4).translation, glm::vec3(10, 20, 0));
  EXPECT_EQ(placement_at(scene, 1000).translation, glm::vec3(10, 20, 0));
  EXPECT_EQ(std::get<Placement>(scene.nodes[0].placement).translation, glm::vec3(0));
}

TEST(Animate, StepsFromKeyToKey) {
  const Scene scene = animated(AnimatedProperty::Scale, KeyInterpolation::Step, {0, 1}, {1, 1, 1, 2, 3, 4});
  EXPECT_EQ(placement_at(scene, 0.999F).scale, glm::vec3(1));
  EXPECT_EQ(placement_at(scene, 1).scale, glm::vec3(2, 3, 4));
}

TEST(Animate, TurnsAtConstantSpeedTheShorterWay) {
  const float s = std::numbers::sqrt2_v<float> / 2;
  // A quarter around y, given as the quaternion of the other sign.
  const Scene scene =
      animated(AnimatedProperty::Rotation, KeyInterpolation::Linear, {0, 1}, {0, 0, 0, 1, 0, -s, 0, -s});
  for (const float t : {0.0F, 0.25F, 0.5F, 0.75F, 1.0F}) {
    const glm::quat rotation = placement_at(scene, t).rotation;
    const float half = t * std::numbers::pi_v<float> / 4;
    EXPECT_NEAR(std::abs(rotation.y), std::sin(half), 1e-6F);
    EXPECT_NEAR(std::abs(rotation.w), std::cos(half), 1e-6F);
    EXPECT_GE(rotation.y * rotation.w, 0);
  }
}

TEST(Animate, FollowsCubicsWithTheirTangents) {
  // x(t) = t³ on 0 … 2: values 0 and 8, derivatives 0 and 12. y has no tangents: an S. In-tangents come first.
  const Scene scene = animated(AnimatedProperty::Translation, KeyInterpolation::Cubic, {0, 2},
                               {9, 9, 9, 0, 0, 0, 0, 0, 0, 12, 0, 0, 8, 1, 0, 9, 9, 9});
  for (const float t : {0.0F, 0.5F, 1.0F, 1.5F, 2.0F}) {
    const float u = t / 2;
    EXPECT_NEAR(placement_at(scene, t).translation.x, t * t * t, 1e-5F);
    EXPECT_NEAR(placement_at(scene, t).translation.y, 3 * u * u - 2 * u * u * u, 1e-6F);
  }
}

TEST(Animate, ChangesMorphWeights) {
  const Scene scene = animated(AnimatedProperty::MorphWeights, KeyInterpolation::Linear, {0, 1}, {0, 1, 1, 0});
  EXPECT_EQ(animate(scene, 0, 0.25F).nodes[0].morph_weights, (std::vector<float>{0.25F, 0.75F}));
}

TEST(Animate, RefusesWhatDoesntFit) {
  const Scene scene = animated(AnimatedProperty::Translation, KeyInterpolation::Linear, {0, 1}, {0, 0, 0, 1, 1, 1});
  EXPECT_THROW(animate(scene, 1, 0), Error);
  EXPECT_THROW(animate(scene, 0, std::numeric_limits<float>::quiet_NaN()), Error);
  EXPECT_THROW(animate(animated(AnimatedProperty::Rotation, KeyInterpolation::Linear, {0, 1}, {0, 0, 0, 1}), 0, 0),
               Error);
  EXPECT_THROW(animate(animated(AnimatedProperty::Scale, KeyInterpolation::Linear, {1, 0}, {0, 0, 0, 1, 1, 1}), 0, 0),
               Error);
  Scene matrix = scene.clone();
  matrix.nodes[0].placement = glm::mat4(1.0F);
  EXPECT_THROW(animate(matrix, 0, 0), Error);
  // Without keys, or with one: no change, and that one.
  EXPECT_EQ(placement_at(animated(AnimatedProperty::Translation, KeyInterpolation::Linear, {}, {}), 3).translation,
            glm::vec3(0));
  EXPECT_EQ(
      placement_at(animated(AnimatedProperty::Translation, KeyInterpolation::Linear, {1}, {1, 2, 3}), 3).translation,
      glm::vec3(1, 2, 3));
}

/// A vertex of a sample scene at a time; what was expected stands in its documentation.
void expect_sample(const std::string& name, float seconds, std::size_t vertex, const glm::vec3& expected) {
  const std::string path =
      std::string(AZULEJO_SOURCE_FOLDER) + "/../shared/data/scenes/gltf/" + name + "/" + name + ".gltf";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  const Model model = read_model(path);
  const Mesh flat = flatten(animate(std::get<Scene>(model), 0, seconds));
  // The samples' quaternions have three digits.
  EXPECT_LT(glm::distance(flat.positions[vertex], expected), 2e-3F)
      << flat.positions[vertex].x << ", " << flat.positions[vertex].y << " at " << seconds << " of " << name;
}

TEST(Animate, PlaysTheSampleTriangle) {
  expect_sample("AnimatedTriangle", 0, 1, {1, 0, 0});
  expect_sample("AnimatedTriangle", 0.125F, 1, {std::sqrt(0.5F), std::sqrt(0.5F), 0});
  expect_sample("AnimatedTriangle", 0.5F, 1, {-1, 0, 0});
  expect_sample("AnimatedTriangle", 0.75F, 1, {0, -1, 0});
  expect_sample("AnimatedTriangle", 1, 1, {1, 0, 0});
}

TEST(Animate, PlaysTheSampleMorph) {
  expect_sample("SimpleMorph", 0, 2, {0.5F, 0.5F, 0});
  expect_sample("SimpleMorph", 1, 2, {1.5F, 1.5F, 0});
  expect_sample("SimpleMorph", 1.5F, 2, {1, 2, 0});
  expect_sample("SimpleMorph", 3, 2, {-0.5F, 1.5F, 0});
}

TEST(Animate, PlaysTheSampleSkin) {
  // The upper joint, at (0, 1), turns by a quarter to the left within the first second; the middle hangs on both.
  expect_sample("SimpleSkin", 0, 9, {0.5F, 2, 0});
  expect_sample("SimpleSkin", 1, 9, {-1, 1.5F, 0});
  expect_sample("SimpleSkin", 1, 5, {0.25F, 1.25F, 0});
  expect_sample("SimpleSkin", 1, 1, {0.5F, 0, 0});
  expect_sample("SimpleSkin", 4, 9, {1, 0.5F, 0});
}

}  // namespace
}  // namespace azulejo
