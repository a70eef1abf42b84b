#include "azulejo/modelling/pose.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include "azulejo/core/error.h"
#include "azulejo/modelling/flatten.h"
#include "azulejo/modelling/scene_testing.h"

namespace azulejo {
namespace {

using testing::add_mesh;
using testing::add_node;
using testing::triangle;
using testing::vector_at;

constexpr float kPi = std::numbers::pi_v<float>;
const glm::quat kQuarterAroundZ = glm::angleAxis(kPi / 2, glm::vec3(0, 0, 1));

void expect_near(const glm::vec3& actual, const glm::vec3& expected) {
  EXPECT_LT(glm::distance(actual, expected), 1e-5F)
      << actual.x << ", " << actual.y << ", " << actual.z << " instead of " << expected.x << ", " << expected.y << ", "
      << expected.z;
}

/// A bar along x from 0 to 2, bound to joints at 0 and 1; its middle hangs on both.
Scene skinned() {
  Scene scene;
  Mesh bar;
  bar.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  bar.corners = {0, 1, 2};
  bar.attributes.push_back({"NORMAL", Domain::Vertex, 3, Array<float>{0, 1, 0, 0, 1, 0, 0, 1, 0}});
  bar.attributes.push_back({"JOINTS_0", Domain::Vertex, 4, Array<std::uint32_t>{0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0}});
  // The weights of the middle add up to 2: they are divided by that.
  bar.attributes.push_back({"WEIGHTS_0", Domain::Vertex, 4, Array<float>{1, 0, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0}});
  const NodeId bones = add_node(scene, {}, {.translation = {0, 0, 5}});
  const NodeId upper = add_node(scene, {}, {}, bones);
  const NodeId lower = add_node(scene, {}, {.translation = {1, 0, 0}, .rotation = kQuarterAroundZ}, upper);
  const NodeId body = add_node(scene, add_mesh(scene, std::move(bar)), {.translation = {100, 0, 0}});
  Skin skin;
  skin.joints = {upper, lower};
  skin.inverse_bind_matrices = {glm::mat4(1.0F), glm::mat4(1.0F)};
  skin.inverse_bind_matrices[1][3] = {-1, 0, 0, 1};
  scene.skins.push_back(std::move(skin));
  scene.nodes[body.index].skin = SkinId(0);
  return scene;
}

TEST(Pose, BendsASkinByItsJoints) {
  Scene scene = skinned();
  const NodeId child = add_node(scene, add_mesh(scene, triangle()), {}, NodeId(3));
  scene.check("scene");
  EXPECT_TRUE(needs_pose(scene));
  const Scene posed = pose(scene);
  posed.check("posed");
  EXPECT_FALSE(needs_pose(posed));
  ASSERT_EQ(posed.nodes.size(), 6U);
  EXPECT_EQ(posed.nodes[5].name, "node 3");
  EXPECT_FALSE(posed.nodes[3].mesh);
  EXPECT_EQ(posed.nodes[3].children, std::vector{child});
  const Mesh& mesh = *posed.meshes[posed.nodes[5].mesh.index];
  EXPECT_EQ(mesh.find("JOINTS_0"), nullptr);
  // The node's own place doesn't count; the joints' does.
  const Mesh flat = flatten(posed);
  ASSERT_EQ(flat.vertex_count(), 6U);
  expect_near(flat.positions[0], {100, 0, 0});  // the child stays where its parent is
  expect_near(flat.positions[3], {0, 0, 5});
  expect_near(flat.positions[4], {1, 0, 5});
  expect_near(flat.positions[5], {1, 1, 5});
  expect_near(vector_at(*mesh.find("NORMAL"), 0), {0, 1, 0});
  expect_near(vector_at(*mesh.find("NORMAL"), 1), glm::normalize(glm::vec3(-1, 1, 0)));
  expect_near(vector_at(*mesh.find("NORMAL"), 2), {-1, 0, 0});
}

TEST(Pose, LeavesASkinInItsBindPoseAsItIs) {
  Scene scene = skinned();
  std::get<Placement>(scene.nodes[2].placement).rotation = {1, 0, 0, 0};
  std::get<Placement>(scene.nodes[0].placement).translation = {0, 0, 0};
  const Mesh flat = flatten(scene);
  for (std::size_t v = 0; v < 3; ++v) expect_near(flat.positions[v], {static_cast<float>(v), 0, 0});
}

TEST(Pose, FindsJointsThatTheSceneDoesntShow) {
  Scene scene = skinned();
  scene.roots = {NodeId(3)};
  expect_near(flatten(scene).positions[2], {1, 1, 5});
}

TEST(Pose, AddsWhatMorphTargetsDiffer) {
  Scene scene;
  Mesh mesh = triangle();
  mesh.morph_targets.push_back({"up", {{0, 0, 1}, {0, 0, 2}, {0, 0, 3}}, {}});
  mesh.morph_targets.push_back({"tilt", {}, {{1, 0, -1}, {1, 0, -1}, {0, 0, 0}}});
  const MeshId id = add_mesh(scene, std::move(mesh));
  add_node(scene, id, {.translation = {1, 0, 0}});
  add_node(scene, id);
  EXPECT_FALSE(needs_pose(scene));
  scene.nodes[1].morph_weights = {0, 0};
  EXPECT_FALSE(needs_pose(scene));
  scene.nodes[0].morph_weights = {0.5F, 1, 1};  // one more than there are targets
  ASSERT_TRUE(needs_pose(scene));
  const Scene posed = pose(scene);
  EXPECT_FALSE(needs_pose(posed));
  EXPECT_EQ(posed.nodes[1].mesh, id);
  const Mesh& shape = *posed.meshes[posed.nodes[0].mesh.index];
  expect_near(shape.positions[0], {0, 0, 0.5F});
  expect_near(shape.positions[2], {0, 1, 1.5F});
  expect_near(vector_at(*shape.find("NORMAL"), 0), {1, 0, 0});
  expect_near(vector_at(*shape.find("NORMAL"), 2), {0, 0, 1});
  EXPECT_TRUE(shape.morph_targets.empty());
  int warnings = 0;
  azulejo::Run run;
  run.warn = [&](const std::string&) { ++warnings; };
  expect_near(flatten(scene, run).positions[0], {1, 0, 0.5F});
  EXPECT_EQ(warnings, 1);
}

TEST(Pose, RefusesJointsThatAreNotThere) {
  Scene scene = skinned();
  scene.skins[0].joints.pop_back();
  scene.skins[0].inverse_bind_matrices.pop_back();
  EXPECT_THROW(pose(scene), Error);
  azulejo::Run run;
  run.limits.memory_bytes = 10;
  EXPECT_THROW(pose(skinned(), run), Error);
}

TEST(Pose, LeavesVerticesWithoutWeightsWhereTheyAre) {
  Scene scene = skinned();
  Mesh mesh = scene.meshes[0]->clone();
  for (Attribute& each : mesh.attributes) {
    if (each.name == "WEIGHTS_0") std::get<Array<float>>(each.values).assign(12, 0);
  }
  scene.meshes[0] = std::make_shared<const Mesh>(std::move(mesh));
  expect_near(flatten(scene).positions[2], {2, 0, 0});
}

}  // namespace
}  // namespace azulejo
