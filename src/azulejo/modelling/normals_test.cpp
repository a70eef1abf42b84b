#include "azulejo/modelling/normals.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

glm::vec3 at(const Attribute& attribute, std::size_t element) {
  const Array<float>& values = *attribute.get<float>();
  return {values[3 * element], values[3 * element + 1], values[3 * element + 2]};
}

void expect_near(const glm::vec3& actual, const glm::vec3& expected, float tolerance = 1e-6F) {
  EXPECT_LT(glm::distance(actual, expected), tolerance)
      << actual.x << ", " << actual.y << ", " << actual.z << " instead of " << expected.x << ", " << expected.y << ", "
      << expected.z;
}

/// The cube −1 … 1 of six quads.
Mesh cube() {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) mesh.positions.emplace_back((i & 1) * 2 - 1, (i & 2) - 1, (i & 4) / 2 - 1);
  mesh.corners = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
  mesh.face_offsets = {0, 4, 8, 12, 16, 20, 24};
  return mesh;
}

/// Its faces cut by diagonals in two ways that favour some corners.
Mesh triangulated_cube() {
  Mesh mesh = cube();
  Array<std::uint32_t> corners;
  for (std::size_t f = 0; f < 6; ++f) {
    for (const std::size_t i : {0, 1, 2, 0, 2, 3}) corners.push_back(mesh.corners[4 * f + i]);
  }
  mesh.corners = corners;
  mesh.face_offsets.clear();
  return mesh;
}

/// A grid of n × n quads on a wavy surface.
Mesh waves(int n) {
  Mesh mesh;
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) {
      const float u = static_cast<float>(x) / static_cast<float>(n);
      const float v = static_cast<float>(y) / static_cast<float>(n);
      mesh.positions.emplace_back(u, v, 0.1F * std::sin(20 * u) * std::cos(17 * v));
    }
  }
  const auto vertex = [&](int x, int y) { return static_cast<std::uint32_t>(y * (n + 1) + x); };
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      for (const std::uint32_t v : {vertex(x, y), vertex(x + 1, y), vertex(x + 1, y + 1)}) mesh.corners.push_back(v);
      for (const std::uint32_t v : {vertex(x, y), vertex(x + 1, y + 1), vertex(x, y + 1)}) mesh.corners.push_back(v);
    }
  }
  return mesh;
}

TEST(Normals, OfFacesPointOutside) {
  const Array<glm::vec3> normals = face_normals(cube());
  const glm::vec3 expected[] = {{0, 0, -1}, {0, 0, 1}, {0, -1, 0}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 0}};
  for (std::size_t f = 0; f < 6; ++f) expect_near(normals[f], expected[f]);
  const Array<glm::vec3> halves = face_normals(triangulated_cube());
  for (std::size_t f = 0; f < 12; ++f) expect_near(halves[f], expected[f / 2]);
}

TEST(Normals, OfPolygonsAreNewells) {
  Mesh mesh;
  // An arrow head whose first corner is its notch: a normal from the first three corners would point the other way.
  mesh.positions = {{0, 1, 0}, {-1, 0, 0}, {0, 3, 0}, {1, 0, 0}};
  mesh.corners = {0, 3, 2, 1};
  mesh.face_offsets = {0, 4};
  expect_near(face_normals(mesh)[0], {0, 0, 1});
}

TEST(Normals, ByAngleDontDependOnDiagonals) {
  for (const Mesh& mesh : {cube(), triangulated_cube()}) {
    const Attribute normals = vertex_normals(mesh);
    EXPECT_EQ(normals.name, "NORMAL");
    EXPECT_EQ(normals.domain, Domain::Vertex);
    EXPECT_EQ(normals.components, 3);
    ASSERT_EQ(normals.size(), 8U);
    for (std::size_t v = 0; v < 8; ++v) expect_near(at(normals, v), glm::normalize(mesh.positions[v]));
  }
}

TEST(Normals, ByAreaAndUniformAreTheirSums) {
  // At the origin a face of area 1/2 with normal z, another of area 3 with normal x.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 0, 3}};
  mesh.corners = {0, 1, 2, 0, 3, 4};
  expect_near(at(vertex_normals(mesh, {.weight = NormalWeight::Area}), 0), glm::normalize(glm::vec3(6, 0, 1)));
  expect_near(at(vertex_normals(mesh, {.weight = NormalWeight::Uniform}), 0), glm::normalize(glm::vec3(1, 0, 1)));
}

TEST(Normals, ByAngleWeightTheAngleOfTheCorner) {
  // Angles of 30° (normal z) and of 90° (normal x) meet at the origin.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {std::cos(kPi / 6), std::sin(kPi / 6), 0}, {0, 2, 0}, {0, 0, 3}};
  mesh.corners = {0, 1, 2, 0, 3, 4};
  expect_near(at(vertex_normals(mesh), 0), glm::normalize(glm::vec3(3, 0, 1)));
  // The notch of the arrow head is an angle of more than π. With a face of 90° and normal x beside it.
  mesh.positions = {{0, 0, 0}, {1, -1, 0}, {0, 2, 0}, {-1, -1, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.corners = {0, 1, 2, 3, 0, 4, 5};
  mesh.face_offsets = {0, 4, 7};
  expect_near(at(vertex_normals(mesh), 0), glm::normalize(glm::vec3(0.5F, 0, 1.5F)));
}

TEST(Normals, AreOfAnyScale) {
  for (const float scale : {1e-30F, 1e-12F, 1.0F, 1e12F, 1e30F}) {
    Mesh mesh = triangulated_cube();
    for (glm::vec3& point : mesh.positions) point *= scale;
    for (const NormalWeight weight : {NormalWeight::Angle, NormalWeight::Area, NormalWeight::Uniform}) {
      const Attribute normals = vertex_normals(mesh, {.weight = weight});
      for (std::size_t v = 0; v < 8; ++v) {
        SCOPED_TRACE(scale);
        EXPECT_GT(glm::dot(at(normals, v), glm::normalize(cube().positions[v])), 0.8F);
      }
    }
  }
}

TEST(Normals, SplitAtCreases) {
  const Mesh mesh = triangulated_cube();
  const Attribute split = vertex_normals(mesh, {.crease_angle = 0.5F * kPi - 0.01F});
  EXPECT_EQ(split.domain, Domain::Corner);
  ASSERT_EQ(split.size(), mesh.corner_count());
  const Array<glm::vec3> faces = face_normals(mesh);
  for (std::size_t c = 0; c < mesh.corner_count(); ++c) expect_near(at(split, c), faces[c / 3]);
  const Attribute whole = vertex_normals(mesh, {.crease_angle = 0.5F * kPi + 0.01F});
  EXPECT_EQ(whole.domain, Domain::Vertex);
  EXPECT_EQ(*whole.get<float>(), *vertex_normals(mesh).get<float>());
}

TEST(Normals, SmoothOnlyOneSideOfACrease) {
  // A prism around z: eight sides at 45°, and a lid. Along the rim, sides are smoothed with sides.
  Mesh mesh;
  for (int i = 0; i < 16; ++i) {
    const float angle = kPi / 4 * static_cast<float>(i % 8);
    mesh.positions.emplace_back(std::cos(angle), std::sin(angle), i < 8 ? 0 : 1);
  }
  mesh.face_offsets = {0};
  for (std::uint32_t i = 0; i < 8; ++i) {
    const std::uint32_t next = (i + 1) % 8;
    for (const std::uint32_t v : {i, next, next + 8, i + 8}) mesh.corners.push_back(v);
    mesh.face_offsets.push_back(4 * (i + 1));
  }
  for (std::uint32_t i = 8; i < 16; ++i) mesh.corners.push_back(i);
  mesh.face_offsets.push_back(40);
  const Attribute normals = vertex_normals(mesh, {.crease_angle = kPi / 3});
  ASSERT_EQ(normals.domain, Domain::Corner);
  for (std::size_t c = 0; c < 32; ++c) {
    const glm::vec3 point = mesh.positions[mesh.corners[c]];
    expect_near(at(normals, c), {point.x, point.y, 0});
  }
  for (std::size_t c = 32; c < 40; ++c) expect_near(at(normals, c), {0, 0, 1});
}

TEST(Normals, OfLargeFansFollowTheirCreases) {
  // A double cone of 4000 segments: at its tip, a corner's neighbours within 40° only. A cone's normals there turn with
  // the segment; the mean of an arc of ±40° is its middle's, tilted up.
  const int segments = 4000;
  Mesh mesh;
  mesh.positions = {{0, 0, 1}};
  for (int i = 0; i < segments; ++i) {
    const float angle = 2 * kPi * static_cast<float>(i) / segments;
    mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  for (int i = 0; i < segments; ++i) {
    const int vertices[] = {0, 1 + i, 1 + (i + 1) % segments};
    for (const int v : vertices) mesh.corners.push_back(static_cast<std::uint32_t>(v));
  }
  const Attribute normals = vertex_normals(mesh, {.crease_angle = 40 * kPi / 180});
  ASSERT_EQ(normals.domain, Domain::Corner);
  for (std::size_t f = 0; f < static_cast<std::size_t>(segments); ++f) {
    const float angle = 2 * kPi * (static_cast<float>(f) + 0.5F) / segments;
    const glm::vec3 face = glm::vec3(std::cos(angle), std::sin(angle), 1) / std::sqrt(2.0F);
    EXPECT_GT(glm::dot(at(normals, 3 * f), face), std::cos(0.25F)) << f;
  }
}

TEST(Normals, OfNothingAreZeroAndOfWhatCancelsTheFirst) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}, {nan, 0, 0}, {2, 0, 0}};
  mesh.corners = {0, 1, 2, 0, 2, 1, 1, 4, 2, 0, 1, 5};  // a face, its back, one with NaN, one without area
  const Array<glm::vec3> faces = face_normals(mesh);
  expect_near(faces[0], {0, 0, 1});
  expect_near(faces[1], {0, 0, -1});
  EXPECT_EQ(faces[2], glm::vec3(0));
  EXPECT_EQ(faces[3], glm::vec3(0));
  const Attribute normals = vertex_normals(mesh);
  for (const std::size_t v : {0U, 1U, 2U}) expect_near(at(normals, v), {0, 0, 1});
  for (const std::size_t v : {3U, 4U, 5U}) EXPECT_EQ(at(normals, v), glm::vec3(0));
  const Attribute split = vertex_normals(mesh, {.crease_angle = 1.0F});
  ASSERT_EQ(split.domain, Domain::Corner);
  expect_near(at(split, 0), {0, 0, 1});
  expect_near(at(split, 3), {0, 0, -1});
  EXPECT_EQ(at(split, 7), glm::vec3(0));
  EXPECT_EQ(vertex_normals(Mesh()).size(), 0U);
  EXPECT_THROW(vertex_normals(mesh, {.crease_angle = nan}), Error);
  EXPECT_THROW(vertex_normals(mesh, {.crease_angle = -0.1F}), Error);
}

TEST(Normals, AreThoseOfASmoothSurface) {
  const Mesh mesh = waves(300);
  const Attribute normals = vertex_normals(mesh);
  float worst = 0;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const glm::vec3 p = mesh.positions[v];
    if (p.x == 0 || p.y == 0 || p.x == 1 || p.y == 1) continue;  // half a neighbourhood
    const glm::vec3 expected = glm::normalize(
        glm::vec3(-2 * std::cos(20 * p.x) * std::cos(17 * p.y), 1.7F * std::sin(20 * p.x) * std::sin(17 * p.y), 1));
    worst = std::max(worst, glm::distance(at(normals, v), expected));
  }
  EXPECT_LT(worst, 5e-3F);  // second order: step 1/300, third derivatives up to 800 / 6
}

TEST(Normals, AreTheSameForAnyNumberOfThreads) {
  const Mesh mesh = waves(300);
  for (const std::optional<float> crease : {std::optional<float>(), std::optional<float>(0.3F)}) {
    azulejo::Run run;
    run.threads = 1;
    const Attribute one = vertex_normals(mesh, {.crease_angle = crease}, run);
    for (const int threads : {2, 7}) {
      run.threads = threads;
      const Attribute many = vertex_normals(mesh, {.crease_angle = crease}, run);
      EXPECT_EQ(one.domain, many.domain);
      EXPECT_EQ(*one.get<float>(), *many.get<float>());
    }
  }
}

}  // namespace
}  // namespace azulejo
