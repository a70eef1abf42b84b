#include "azulejo/modelling/transform.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "azulejo/core/error.h"
#include "azulejo/math/transform2d.h"
#include "azulejo/math/transform3d.h"
#include "azulejo/modelling/primitive.h"

namespace azulejo {
namespace {

constexpr double kMirror = -1;

Mesh sphere() { return primitive({.kind = PrimitiveKind::IcoSphere}); }

/// Six times the volume, with a sign: negative where the inside is out.
double volume(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto at = [&](std::size_t corner) { return glm::dvec3(mesh.positions[mesh.corners[corner]]); };
    for (std::size_t c = mesh.face_begin(f) + 1; c + 1 < mesh.face_end(f); ++c)
      sum += glm::dot(at(mesh.face_begin(f)), glm::cross(at(c), at(c + 1)));
  }
  return sum;
}

/// Two triangles with everything that turns.
Mesh dressed() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.corners = {0, 1, 2, 3};
  mesh.face_offsets = {0, 4};
  mesh.attributes.push_back({"NORMAL", Domain::Vertex, 3, Array<float>{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}});
  mesh.attributes.push_back(
      {"TANGENT", Domain::Vertex, 4, Array<float>{1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}});
  mesh.attributes.push_back({"TEXCOORD_0", Domain::Corner, 2, Array<float>{0, 1, 2, 3, 4, 5, 6, 7}});
  mesh.morph_targets.push_back({"up", {{0, 0, 1}, {0, 0, 2}, {0, 0, 0}, {0, 0, 0}}, {{1, 0, 0}, {}, {}, {}}});
  return mesh;
}

TEST(TransformModel, MovesPositionsAndKeepsOutsideOut) {
  const Mesh mesh = sphere();
  const double before = volume(mesh);
  ASSERT_GT(before, 0);
  const glm::dmat4 turn = Rotation3d(0.7, {1, 2, 3}, {4, 5, 6}).matrix();
  for (const glm::dvec3& scale : {glm::dvec3(1, 2, 3), glm::dvec3(kMirror, 1, 1), glm::dvec3(-2, -1, -1)}) {
    const glm::dmat4 m = turn * Scaling3d{scale, {}}.matrix();
    const Mesh moved = transform(mesh, m);
    moved.check("moved");
    EXPECT_NEAR(volume(moved) / before, std::fabs(scale.x * scale.y * scale.z), 1e-4);
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
      ASSERT_EQ(moved.positions[v], transform_point(glm::mat4(m), mesh.positions[v]));
    const Array<float>& normals = *moved.find("NORMAL")->get<float>();
    const glm::vec3 center(m * glm::dvec4(0, 0, 0, 1));
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
      const glm::vec3 normal(normals[3 * v], normals[3 * v + 1], normals[3 * v + 2]);
      ASSERT_NEAR(glm::length(normal), 1, 1e-5);
      ASSERT_GT(glm::dot(normal, moved.positions[v] - center), 0) << "outwards";
    }
  }
}

TEST(TransformModel, MirroredFacesTurnWithTheirCorners) {
  const Mesh moved = transform(dressed(), Scaling3d{{kMirror, 1, 1}, {}}.matrix());
  EXPECT_EQ(std::vector<std::uint32_t>(moved.corners.begin(), moved.corners.end()),
            (std::vector<std::uint32_t>{0, 3, 2, 1}));
  const Array<float>& texture = *moved.find("TEXCOORD_0")->get<float>();
  EXPECT_EQ(std::vector<float>(texture.begin(), texture.end()), (std::vector<float>{0, 1, 6, 7, 4, 5, 2, 3}));
  const Array<float>& normal = *moved.find("NORMAL")->get<float>();
  EXPECT_EQ(normal[2], 1);
  const Array<float>& tangent = *moved.find("TANGENT")->get<float>();
  EXPECT_EQ(tangent[0], -1);
  EXPECT_EQ(tangent[3], -1) << "handedness";
}

TEST(TransformModel, MorphTargetsMoveAsTheMorphedMeshDoes) {
  const Mesh mesh = dressed();
  const glm::dmat4 m = Rotation3d(0.7, {1, 2, 3}, {4, 5, 6}).matrix() * Scaling3d{{1, 2, 4}, {}}.matrix();
  const Mesh moved = transform(mesh, m);
  for (std::size_t v = 0; v < 4; ++v) {
    const glm::vec3 expected = transform_point(glm::mat4(m), mesh.positions[v] + mesh.morph_targets[0].positions[v]);
    const glm::vec3 got = moved.positions[v] + moved.morph_targets[0].positions[v];
    EXPECT_LE(glm::length(expected - got), 1e-5F);
  }
  const glm::vec3 expected = transform_normal(glm::mat4(m), {1, 0, 1});
  const Array<float>& normals = *moved.find("NORMAL")->get<float>();
  const glm::vec3 got = glm::vec3(normals[0], normals[1], normals[2]) + moved.morph_targets[0].normals[0];
  EXPECT_LE(glm::length(expected - glm::normalize(got)), 1e-6F);
}

TEST(TransformModel, ScenesGetARootAndLookAsTheirMeshesDo) {
  Scene scene = scene_of(sphere());
  const glm::dmat4 m = Translation3d{{5, 0, 0}}.matrix() * Scaling3d{{1, 2, kMirror}, {}}.matrix();
  const Scene moved = transform(scene, m);
  moved.check("moved");
  EXPECT_EQ(moved.roots.size(), 1U);
  const Box3 expected = bounds(transform(*scene.meshes[0], m));
  EXPECT_LE(glm::length(bounds(moved).lower - expected.lower), 1e-5F);
  EXPECT_LE(glm::length(bounds(moved).upper - expected.upper), 1e-5F);
  EXPECT_TRUE(transform(Scene(), m).nodes.empty());
}

TransformStep step(StepKind kind, std::vector<float> numbers) { return {.kind = kind, .numbers = std::move(numbers)}; }

TEST(TransformModel, DrawingsTurnAsSeenAndStepsAreDoneInOrder) {
  Drawing drawing;
  drawing.width = 20;
  drawing.height = 10;
  drawing.groups[0].parent_from_group = {1, 0, 0, 1, 3, 0};
  TransformOptions options;
  options.steps = {step(StepKind::Rotate, {90})};
  // y down: counter-clockwise as seen takes +x to −y.
  EXPECT_EQ(transform(drawing, options).groups[0].parent_from_group, (glm::mat3x2{0, -1, 1, 0, 0, -3}));
  options.steps[0].about_center = true;
  EXPECT_EQ(transformed(transform(drawing, options).groups[0].parent_from_group, {7, 5}), glm::vec2(10, 5));
  options.steps = {step(StepKind::Translate, {1, 2}), step(StepKind::Scale, {3})};
  EXPECT_EQ(transformed(transform(drawing, options).groups[0].parent_from_group, {0, 0}), glm::vec2(12, 6));
  // The center is where the steps before have moved it.
  options.steps[1].about_center = true;
  EXPECT_EQ(transformed(transform(drawing, options).groups[0].parent_from_group, {7, 5}), glm::vec2(11, 7));
  options.inverse = true;
  EXPECT_EQ(transformed(transform(drawing, options).groups[0].parent_from_group, {8, 7}), glm::vec2(10, 5));
}

TEST(TransformModel, MatricesOfBothConventions) {
  TransformOptions options;
  options.steps = {{.kind = StepKind::Matrix, .matrix = {2, 3, {1, 2, 3, 4, 5, 6}}}};
  EXPECT_EQ(picture_transform(options, {}), glm::dmat3(1, 4, 0, 2, 5, 0, 3, 6, 1));
  options.convention = MatrixConvention::Row;
  EXPECT_THROW(picture_transform(options, {}), Error);
  options.steps[0].matrix = {3, 2, {1, 4, 2, 5, 3, 6}};
  EXPECT_EQ(picture_transform(options, {}), glm::dmat3(1, 4, 0, 2, 5, 0, 3, 6, 1));
  options.steps[0].matrix = {4, 4, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 7, 8, 9, 1}};
  EXPECT_EQ(space_transform(options, {}), Translation3d({{7, 8, 9}}).matrix());
}

TEST(TransformModel, RefusesWhatIsNotAffine) {
  glm::dmat4 projective(1);
  projective[0].w = 0.1;
  EXPECT_THROW(transform(sphere(), projective), Error);
  TransformOptions options;
  options.steps = {step(StepKind::Scale, {1, 2, 3, 4})};
  EXPECT_THROW(transform(sphere(), options), Error);
  options.steps = {step(StepKind::Scale, {1, 0, 1})};
  EXPECT_NO_THROW(transform(sphere(), options)) << "flat, but a mesh";
  options.inverse = true;
  EXPECT_THROW(transform(sphere(), options), Error);
  options.steps = {step(StepKind::Rotate, {std::numeric_limits<float>::infinity()})};
  EXPECT_THROW(transform(sphere(), options), Error);
}

}  // namespace
}  // namespace azulejo
