#include "azulejo/modelling/flatten.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "azulejo/core/error.h"
#include "azulejo/modelling/normals.h"
#include "azulejo/modelling/scene_testing.h"

namespace azulejo {
namespace {

using testing::add_mesh;
using testing::add_node;
using testing::triangle;
using testing::vector_at;

void expect_near(const glm::vec3& actual, const glm::vec3& expected, float tolerance = 1e-6F) {
  EXPECT_LT(glm::distance(actual, expected), tolerance)
      << actual.x << ", " << actual.y << ", " << actual.z << " instead of " << expected.x << ", " << expected.y << ", "
      << expected.z;
}

TEST(Flatten, PutsInstancesOneAfterTheOther) {
  Scene scene;
  scene.name = "two";
  scene.space = {UpAxis::Z, 0.001F};
  scene.materials.resize(2);
  Mesh first = triangle();
  first.material = {1};
  const MeshId mesh = add_mesh(scene, std::move(first));
  Mesh second = triangle();
  second.lines = {0, 2};
  const MeshId plain = add_mesh(scene, std::move(second));
  const NodeId parent = add_node(scene, {}, {.translation = {10, 0, 0}});
  add_node(scene, mesh, {.translation = {0, 1, 0}}, parent);
  add_node(scene, plain, {.scale = {2, 2, 2}});
  const NodeId hidden = add_node(scene, mesh);
  add_node(scene, mesh, {}, hidden);
  scene.nodes[hidden.index].visible = false;
  scene.check("scene");

  const Mesh flat = flatten(scene);
  flat.check("flat");
  EXPECT_EQ(flat.name, "two");
  EXPECT_EQ(flat.space, scene.space);
  ASSERT_EQ(flat.vertex_count(), 6U);
  EXPECT_TRUE(flat.all_triangles());
  expect_near(flat.positions[1], {11, 1, 0});
  expect_near(flat.positions[5], {0, 2, 0});
  EXPECT_EQ(flat.corners, (Array<std::uint32_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(flat.lines, (Array<std::uint32_t>{3, 5}));
  EXPECT_EQ(flat.material, (Array<std::uint32_t>{1, MaterialId::kNone}));
  ASSERT_NE(flat.find("NODE"), nullptr);
  EXPECT_EQ(flat.find("NODE")->domain, Domain::Face);
  EXPECT_EQ(*flat.find("NODE")->get<std::uint32_t>(), (Array<std::uint32_t>{1, 2}));
}

TEST(Flatten, TurnsMirroredInstancesBackAndKeepsThemWhole) {
  Mesh quad;
  quad.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  quad.corners = {0, 1, 2, 3};
  quad.face_offsets = {0, 4};
  quad.attributes.push_back({"NORMAL", Domain::Vertex, 3, Array<float>{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}});
  quad.attributes.push_back({"id", Domain::Corner, 1, Array<std::uint32_t>{0, 1, 2, 3}});
  quad.attributes.push_back(
      {"TANGENT", Domain::Vertex, 4, Array<float>{1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}});
  Scene scene;
  const MeshId mesh = add_mesh(scene, std::move(quad));
  add_node(scene, mesh, {.scale = {-2, 1, 1}});
  add_node(scene, mesh, {.scale = {-2, -1, 3}});
  const Mesh flat = flatten(scene);
  flat.check("flat");
  EXPECT_EQ(flat.corners, (Array<std::uint32_t>{0, 3, 2, 1, 4, 5, 6, 7}));
  EXPECT_EQ(*flat.find("id")->get<std::uint32_t>(), (Array<std::uint32_t>{0, 3, 2, 1, 0, 1, 2, 3}));
  const Array<glm::vec3> faces = face_normals(flat);
  for (std::size_t v = 0; v < 8; ++v) {
    expect_near(vector_at(*flat.find("NORMAL"), v), {0, 0, 1});
    expect_near(faces[v / 4], {0, 0, 1});
    expect_near(vector_at(*flat.find("TANGENT"), v), {-1, 0, 0});
    // Across: w · N × T, which was y: it is y mirrored once in neither, and once in the second.
    const float w = (*flat.find("TANGENT")->get<float>())[4 * v + 3];
    expect_near(w * glm::cross(glm::vec3(0, 0, 1), glm::vec3(-1, 0, 0)), {0, v < 4 ? 1 : -1, 0});
  }
}

TEST(Flatten, TakesNormalsAlongWithAnyMatrix) {
  std::mt19937 random(4);
  std::normal_distribution<float> number;
  for (int i = 0; i < 100; ++i) {
    Scene scene;
    add_node(scene, add_mesh(scene, triangle()));
    glm::mat4 matrix(1.0F);
    for (int c = 0; c < 4; ++c) {
      for (int r = 0; r < 3; ++r) matrix[c][r] = number(random);
    }
    scene.nodes[0].placement = matrix;
    const Mesh flat = flatten(scene);
    const glm::vec3 face = face_normals(flat)[0];
    expect_near(vector_at(*flat.find("NORMAL"), 0), face, 1e-4F);
  }
  // One that makes everything flat leaves the normal that it had.
  Scene scene;
  add_node(scene, add_mesh(scene, triangle()), {.scale = {1, 1, 0}});
  expect_near(vector_at(*flatten(scene).find("NORMAL"), 0), {0, 0, 1});
}

TEST(Flatten, GivesAllMeshesTheAttributesOfAll) {
  Scene scene;
  Mesh bytes = triangle();
  bytes.attributes.push_back({"COLOR_0", Domain::Vertex, 3, Array<std::uint8_t>{255, 0, 188, 0, 0, 0, 0, 0, 0}});
  bytes.attributes.push_back({"only", Domain::Face, 1, Array<std::uint32_t>{7}});
  Mesh floats = triangle();
  floats.attributes.clear();
  floats.attributes.push_back(
      {"COLOR_0", Domain::Corner, 4, Array<float>{0.1F, 0.2F, 0.3F, 0.4F, 0, 0, 0, 0, 0, 0, 0, 0}});
  add_node(scene, add_mesh(scene, std::move(bytes)));
  add_node(scene, add_mesh(scene, std::move(floats)));
  Mesh plain = triangle();
  plain.attributes.clear();
  add_node(scene, add_mesh(scene, std::move(plain)));
  const Mesh flat = flatten(scene);
  flat.check("flat");

  const Attribute& color = *flat.find("COLOR_0");
  EXPECT_EQ(color.domain, Domain::Corner);
  ASSERT_EQ(color.components, 4);
  const Array<float>& values = *color.get<float>();
  EXPECT_EQ(values[0], 1);
  EXPECT_EQ(values[1], 0);
  EXPECT_NEAR(values[2], 0.502886F, 1e-5F);  // ((188/255 + 0.055) / 1.055)^2.4
  EXPECT_EQ(values[3], 1);
  EXPECT_EQ(values[12], 0.1F);
  EXPECT_EQ(values[15], 0.4F);
  for (std::size_t i = 24; i < 36; ++i) EXPECT_EQ(values[i], 1);
  EXPECT_EQ(*flat.find("only")->get<std::uint32_t>(), (Array<std::uint32_t>{7, 0, 0}));
  expect_near(vector_at(*flat.find("NORMAL"), 2), {0, 0, 1});
  EXPECT_EQ(vector_at(*flat.find("NORMAL"), 3), glm::vec3(0));
}

TEST(Flatten, MixesPolygonsPointsAndTriangles) {
  Scene scene;
  Mesh polygons;
  polygons.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  polygons.corners = {0, 1, 2, 3, 0, 1};
  polygons.face_offsets = {0, 4, 6};
  Mesh points;
  points.positions = {{5, 5, 5}};
  add_node(scene, add_mesh(scene, triangle()));
  add_node(scene, add_mesh(scene, std::move(points)));
  add_node(scene, add_mesh(scene, std::move(polygons)));
  const Mesh flat = flatten(scene);
  flat.check("flat");
  EXPECT_EQ(flat.face_offsets, (Array<std::uint32_t>{0, 3, 7, 9}));
  EXPECT_EQ(flat.corners, (Array<std::uint32_t>{0, 1, 2, 4, 5, 6, 7, 4, 5}));
  EXPECT_EQ(*flat.find("NODE")->get<std::uint32_t>(), (Array<std::uint32_t>{0, 2, 2}));
  const Mesh nothing = flatten(Scene());
  EXPECT_EQ(nothing.vertex_count(), 0U);
  EXPECT_EQ(nothing.face_count(), 0U);
}

TEST(Flatten, StopsAtItsLimit) {
  Scene scene;
  const MeshId mesh = add_mesh(scene, triangle());
  for (int i = 0; i < 1000; ++i) add_node(scene, mesh);
  azulejo::Run run;
  run.limits.memory_bytes = 1000 * (36 + 12 + 12 + 36);
  EXPECT_EQ(flatten(scene, run).face_count(), 1000U);
  --run.limits.memory_bytes;
  EXPECT_THROW(flatten(scene, run), Error);
}

}  // namespace
}  // namespace azulejo
