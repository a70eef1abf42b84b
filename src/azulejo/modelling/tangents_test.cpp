#include "azulejo/modelling/tangents.h"

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "azulejo/modelling/normals.h"
#include "azulejo/modelling/primitive.h"
#include "azulejo/modelling/tessellate.h"

namespace azulejo {
namespace {

struct Point {
  glm::vec3 position;
  glm::vec2 uv;
};

/// Triangles of vertices of their own points, or of these by number; the normal is +z.
Mesh flat_mesh(const std::vector<Point>& points, const std::vector<std::uint32_t>& corners) {
  Mesh mesh;
  Array<float> uv;
  Array<float> normals;
  for (const Point& each : points) {
    mesh.positions.push_back(each.position);
    uv.insert(uv.end(), {each.uv.x, each.uv.y});
    normals.insert(normals.end(), {0, 0, 1});
  }
  mesh.corners.assign(corners.begin(), corners.end());
  mesh.attributes.push_back({"TEXCOORD_0", Domain::Vertex, 2, std::move(uv)});
  mesh.attributes.push_back({"NORMAL", Domain::Vertex, 3, std::move(normals)});
  return mesh;
}

/// The value that an attribute has at a corner.
const float* at(const Mesh& mesh, const std::string& name, std::size_t corner) {
  const Attribute& attribute = *mesh.find(name);
  const std::size_t element = attribute.domain == Domain::Vertex ? mesh.corners[corner] : corner;
  return attribute.get<float>()->data() + element * static_cast<std::size_t>(attribute.components);
}
glm::vec4 tangent(const Mesh& mesh, std::size_t corner) {
  const float* const t = at(mesh, "TANGENT", corner);
  return {t[0], t[1], t[2], t[3]};
}
glm::vec3 normal(const Mesh& mesh, std::size_t corner) {
  const float* const n = at(mesh, "NORMAL", corner);
  return {n[0], n[1], n[2]};
}
glm::vec3 bitangent(const Mesh& mesh, std::size_t corner) {
  const glm::vec4 t = tangent(mesh, corner);
  return glm::cross(normal(mesh, corner), glm::vec3(t)) * t.w;
}

void expect_near(const glm::vec3& actual, const glm::vec3& expected, float tolerance = 1e-6F) {
  EXPECT_LT(glm::distance(actual, expected), tolerance) << actual.x << ", " << actual.y << ", " << actual.z;
}

TEST(Tangents, OfAPlaneAreWhereURises) {
  // A square whose texture stands upright: v falls as y rises.
  const std::vector<Point> square = {
      {{0, 0, 0}, {0, 1}}, {{2, 0, 0}, {1, 1}}, {{2, 2, 0}, {1, 0}}, {{0, 2, 0}, {0, 0}}};
  const Mesh upright = tangents(flat_mesh(square, {0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(upright.find("TANGENT")->domain, Domain::Vertex);
  for (std::size_t c = 0; c < 6; ++c) {
    EXPECT_EQ(tangent(upright, c), glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(bitangent(upright, c), glm::vec3(0, 1, 0)) << "up in the image";
  }
  std::vector<Point> mirrored = square;
  for (Point& each : mirrored) each.uv.x = -each.uv.x;
  const Mesh left = tangents(flat_mesh(mirrored, {0, 1, 2, 0, 2, 3}));
  for (std::size_t c = 0; c < 6; ++c) {
    EXPECT_EQ(tangent(left, c), glm::vec4(-1, 0, 0, -1));
    EXPECT_EQ(bitangent(left, c), glm::vec3(0, 1, 0));
  }
}

TEST(Tangents, OfASphereFollowItsParallels) {
  const Mesh sphere = tangents(primitive({.kind = PrimitiveKind::UvSphere, .segments = 64, .rings = 32}));
  sphere.check("tangents");
  for (std::size_t f = 0; f < sphere.face_count(); ++f) {
    if (sphere.face_end(f) - sphere.face_begin(f) != 4) continue;  // at the poles u is not one
    const std::size_t first = sphere.face_begin(f);
    for (std::size_t c = first; c < sphere.face_end(f); ++c) {
      const glm::vec3 p = sphere.positions[sphere.corners[c]];
      if (std::abs(p.y) > 0.98F) continue;
      // By a step along the face's edge on which u rises and v stays.
      glm::vec3 rising(0);
      for (std::size_t k = first; k < sphere.face_end(f); ++k) {
        const std::size_t next = k + 1 < sphere.face_end(f) ? k + 1 : first;
        const float du = at(sphere, "TEXCOORD_0", next)[0] - at(sphere, "TEXCOORD_0", k)[0];
        if (std::abs(du) > 1e-3F) {
          rising += du * (sphere.positions[sphere.corners[next]] - sphere.positions[sphere.corners[k]]);
        }
      }
      const float around = glm::dot(rising, {-p.z, 0, p.x}) > 0 ? 1.0F : -1.0F;
      // Mirror symmetry to both sides of a meridian: exact but for rounding. At a seam there is one side only: half a
      // segment, 0.05, off.
      expect_near(glm::vec3(tangent(sphere, c)), around * glm::normalize(glm::vec3(-p.z, 0, p.x)), 0.06F);
      EXPECT_GT(bitangent(sphere, c).y, 0.0F) << "v runs from top to bottom";
    }
  }
}

TEST(Tangents, AreWeightedByAngle) {
  // Around vertex 0 a right angle whose u rises along x, and one of 45° whose u rises along (1, 1, 0): connected by an
  // edge, with the same handedness.
  const std::vector<Point> points = {
      {{0, 0, 0}, {0, 0}}, {{1, 0, 0}, {1, 0}}, {{0, 1, 0}, {0, 1}}, {{-1, 1, 0}, {-1, 2}}};
  const Mesh mesh = tangents(flat_mesh(points, {0, 1, 2, 0, 2, 3}));
  // Of the second: e1 = (0, 1), uv (0, 1); e2 = (-1, 1), uv (-1, 2): dp/du = 2 e1 - e2 = (1, 1).
  const glm::vec2 expected = glm::normalize(90.0F * glm::vec2(1, 0) + 45.0F * glm::normalize(glm::vec2(1, 1)));
  expect_near(glm::vec3(tangent(mesh, 0)), {expected.x, expected.y, 0});
  expect_near(glm::vec3(tangent(mesh, 1)), {1, 0, 0});
  EXPECT_EQ(tangent(mesh, 0).w, -1.0F);
}

TEST(Tangents, AreTurnedIntoTheNormalsPlane) {
  Mesh mesh = flat_mesh({{{0, 0, 0}, {0, 1}}, {{1, 0, 0}, {1, 1}}, {{0, 1, 0}, {0, 0}}}, {0, 1, 2});
  const glm::vec3 tilted = glm::normalize(glm::vec3(1, 0, 1));
  mesh.attributes[1].values = Array<float>{tilted.x, tilted.y, tilted.z, 0, 0, 1, 0, 0, 1};
  const Mesh result = tangents(mesh);
  expect_near(glm::vec3(tangent(result, 0)), glm::normalize(glm::vec3(1, 0, -1)));
  expect_near(glm::vec3(tangent(result, 1)), {1, 0, 0});
}

TEST(Tangents, MirroredTexturesAreKeptApart) {
  // Two triangles at one edge, the texture mirrored there: corners on it have two tangents.
  const std::vector<Point> points = {
      {{0, -1, 0}, {0, 1}}, {{0, 1, 0}, {0, 0}}, {{1, 0, 0}, {1, 0.5F}}, {{-1, 0, 0}, {1, 0.5F}}};
  const Mesh mesh = tangents(flat_mesh(points, {0, 2, 1, 0, 1, 3}));
  ASSERT_EQ(mesh.find("TANGENT")->domain, Domain::Corner);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(tangent(mesh, c), glm::vec4(1, 0, 0, 1));
  for (std::size_t c = 3; c < 6; ++c) EXPECT_EQ(tangent(mesh, c), glm::vec4(-1, 0, 0, -1));
}

TEST(Tangents, EqualCornersOfDifferentVerticesAreOne) {
  const std::vector<Point> apart = {{{0, 0, 0}, {0, 0}}, {{1, 0, 0}, {1, 0}}, {{0, 1, 0}, {0, 1}},
                                    {{0, 0, 0}, {0, 0}}, {{0, 1, 0}, {0, 1}}, {{-1, 1, 0}, {-1, 2}}};
  const Mesh joined = tangents(flat_mesh({apart[0], apart[1], apart[2], apart[5]}, {0, 1, 2, 0, 2, 3}));
  const Mesh soup = tangents(flat_mesh(apart, {0, 1, 2, 3, 4, 5}));
  for (std::size_t c = 0; c < 6; ++c) EXPECT_EQ(tangent(soup, c), tangent(joined, c));
}

TEST(Tangents, TrianglesWithoutAnAreaTakeTheirNeighbors) {
  // The second has no area in the texture, the third none in space, the fourth neither and nobody beside it.
  const std::vector<Point> points = {{{0, 0, 0}, {0, 1}},     {{1, 0, 0}, {1, 1}}, {{0, 1, 0}, {0, 0}},
                                     {{-1, 0, 0}, {0, 0.5F}}, {{5, 5, 0}, {0, 0}}, {{6, 5, 0}, {0, 0}},
                                     {{5, 6, 0}, {0, 0}}};
  const Mesh mesh = tangents(flat_mesh(points, {0, 1, 2, 0, 2, 3, 0, 0, 1, 4, 5, 6}));
  for (std::size_t c = 0; c < 5; ++c) EXPECT_EQ(tangent(mesh, c), glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(tangent(mesh, 6), glm::vec4(1, 0, 0, 1));
  for (std::size_t c = 9; c < 12; ++c) EXPECT_EQ(tangent(mesh, c), glm::vec4(1, 0, 0, 1)) << "any across the normal";
}

void expect_frames(const Mesh& mesh) {
  for (std::size_t c = 0; c < mesh.corner_count(); ++c) {
    const glm::vec4 t = tangent(mesh, c);
    EXPECT_NEAR(glm::length(glm::vec3(t)), 1, 1e-5);
    EXPECT_EQ(std::abs(t.w), 1.0F);
    const glm::vec3 n = normal(mesh, c);
    if (std::abs(glm::length(n) - 1) < 1e-5F) {
      EXPECT_NEAR(glm::dot(n, glm::vec3(t)), 0, 1e-5);
    }
  }
}

TEST(Tangents, AreFramesOfAnySurface) {
  for (const PrimitiveKind kind : {PrimitiveKind::Cube, PrimitiveKind::Cone, PrimitiveKind::Torus,
                                   PrimitiveKind::Teapot, PrimitiveKind::Mobius, PrimitiveKind::Dodecahedron}) {
    const Mesh mesh = tangents(primitive({.kind = kind}));
    mesh.check("tangents");
    expect_frames(mesh);
  }
  for (const unsigned seed : {1U, 2U, 3U}) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const auto step = [&](unsigned steps) {
      return static_cast<float>(random() % steps) / static_cast<float>(steps - 1);
    };
    std::vector<Point> points;
    for (int i = 0; i < 60; ++i) points.push_back({{step(3), step(3), step(3)}, {step(4), step(4)}});
    std::vector<std::uint32_t> corners;
    for (int i = 0; i < 3 * 400; ++i) corners.push_back(static_cast<std::uint32_t>(random() % 60));
    Mesh mesh = flat_mesh(points, corners);
    mesh.positions[0].x = std::numeric_limits<float>::quiet_NaN();
    mesh.positions[1].y = std::numeric_limits<float>::infinity();
    expect_frames(tangents(mesh));
  }
}

TEST(Tangents, AreTheSameForAnyNumberOfThreads) {
  const Mesh mesh = primitive({.kind = PrimitiveKind::Teapot});
  azulejo::Run one;
  one.threads = 1;
  azulejo::Run many;
  many.threads = 7;
  EXPECT_EQ(tangents(mesh, {}, one).find("TANGENT")->values, tangents(mesh, {}, many).find("TANGENT")->values);
}

TEST(Tangents, OfLargeFansTakeNoSquareOfTime) {
  // Each triangle has a texture of its own at the middle, every other one none.
  constexpr std::uint32_t kRim = 200000;
  std::vector<Point> points;
  std::vector<std::uint32_t> corners;
  for (std::uint32_t i = 0; i < kRim; ++i) {
    const float angle = 6.2831853F * static_cast<float>(i) / kRim;
    const float u = static_cast<float>(i);
    const float v = i % 2 == 0 ? 1.0F : 0.0F;
    const auto first = static_cast<std::uint32_t>(points.size());
    points.push_back({{0, 0, 0}, {u, 0}});
    points.push_back({{std::cos(angle), std::sin(angle), 0}, {u + 1, 0}});
    points.push_back({{std::cos(angle + 3e-5F), std::sin(angle + 3e-5F), 0}, {u, v}});
    corners.insert(corners.end(), {first, first + 1, first + 2});
  }
  EXPECT_NE(tangents(flat_mesh(points, corners)).find("TANGENT"), nullptr);
}

TEST(Tangents, NeedTextureCoordinates) {
  const auto warned = [](const Mesh& mesh, const TangentsOptions& options) {
    std::string said;
    azulejo::Run run;
    run.warn = [&](const std::string& text) { said = text; };
    const Mesh result = tangents(mesh, options, run);
    EXPECT_EQ(result.find("TANGENT"), nullptr);
    return said;
  };
  Mesh mesh = primitive({.kind = PrimitiveKind::Cube});
  EXPECT_NE(warned(mesh, {.texcoord = 3}).find("has no TEXCOORD_3"), std::string::npos);
  EXPECT_NE(warned(Mesh(), {}).find("has no faces"), std::string::npos);
  std::erase_if(mesh.attributes, [](const Attribute& each) { return each.name == "NORMAL"; });
  const Mesh result = tangents(mesh);
  EXPECT_NE(result.find("NORMAL"), nullptr) << "computed";
  expect_frames(result);
}

}  // namespace
}  // namespace azulejo
