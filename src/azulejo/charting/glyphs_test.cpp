#include "azulejo/charting/glyphs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <string>

#include "azulejo/core/error.h"

namespace azulejo {
namespace {

/// Points with a vector each, in a box whose diagonal is 5.
Mesh field(std::initializer_list<glm::vec3> vectors) {
  Mesh mesh;
  Array<float> values;
  for (const glm::vec3& vector : vectors) {
    mesh.positions.push_back(mesh.positions.size() % 2 == 0 ? glm::vec3(0, 0, 0) : glm::vec3(3, 4, 0));
    values.insert(values.end(), {vector.x, vector.y, vector.z});
  }
  mesh.attributes.push_back({"flow", Domain::Vertex, 3, std::move(values)});
  return mesh;
}

/// The vertex of a glyph that is farthest along a direction.
glm::vec3 tip(const Mesh& mesh, std::size_t first, std::size_t count, const glm::vec3& direction) {
  glm::vec3 best = mesh.positions[first];
  for (std::size_t v = first; v < first + count; ++v) {
    if (glm::dot(mesh.positions[v], direction) > glm::dot(best, direction)) best = mesh.positions[v];
  }
  return best;
}

TEST(Glyphs, ArrowsGoFromTheirVerticesAlongTheirVectors) {
  const Mesh mesh = field({{0, 0, 2}, {-1, 0, 0}});
  const Mesh result = glyphs(mesh, {.attribute = "flow", .size = 0.2F});
  result.check("glyphs");
  const std::size_t each = result.vertex_count() / 2;
  // The longest is 0.2 of 5.
  EXPECT_LT(glm::distance(tip(result, 0, each, {0, 0, 1}), glm::vec3(0, 0, 1)), 1e-5F);
  EXPECT_LT(glm::distance(tip(result, each, each, {-1, 0, 0}), glm::vec3(2.5F, 4, 0)), 1e-5F);
  EXPECT_EQ((*result.find("value")->get<float>())[0], 2);
  EXPECT_EQ((*result.find("value")->get<float>())[each], 1);
  const Mesh alike = glyphs(mesh, {.attribute = "flow", .size = 0.2F, .scaled = false});
  EXPECT_LT(glm::distance(tip(alike, each, each, {-1, 0, 0}), glm::vec3(2, 4, 0)), 1e-5F);
}

TEST(Glyphs, AreTurnedOutsideOut) {
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  for (int round = 0; round < 50; ++round) {
    const glm::vec3 vector(normal(random), normal(random), normal(random));
    for (const GlyphKind kind : {GlyphKind::Arrow, GlyphKind::Cone, GlyphKind::Sphere}) {
      const Mesh result = glyphs(field({vector, vector}), {.kind = kind, .attribute = "flow"});
      const Array<float>& normals = *result.find("NORMAL")->get<float>();
      for (std::size_t f = 0; f < result.face_count(); ++f) {
        const std::size_t c = result.face_begin(f);
        const auto at = [&](std::size_t corner) { return result.positions[result.corners[corner]]; };
        const glm::vec3 face = glm::cross(at(c + 1) - at(c), at(c + 2) - at(c));
        const glm::vec3 told(normals[3 * c], normals[3 * c + 1], normals[3 * c + 2]);
        ASSERT_NEAR(glm::length(told), 1, 1e-4F);
        ASSERT_GT(glm::dot(face, told), 0) << "face " << f;
      }
    }
  }
}

TEST(Glyphs, NothingWhereThereIsNoVector) {
  const Mesh result = glyphs(field({{0, 0, 0}, {NAN, 0, 0}, {INFINITY, 0, 0}}), {.attribute = "flow"});
  EXPECT_EQ(result.vertex_count(), 0U);
  result.check("glyphs");
}

TEST(Glyphs, NoMoreThanAskedFor) {
  Mesh mesh = field({});
  Array<float> values;
  for (int i = 0; i < 1000; ++i) {
    mesh.positions.emplace_back(i, 0, 0);
    values.insert(values.end(), {0, 1, 0});
  }
  mesh.attributes[0].values = std::move(values);
  const auto glyph_count = [&](int most) {
    const std::size_t one = glyphs(field({{1, 0, 0}}), {.attribute = "flow"}).vertex_count();
    return glyphs(mesh, {.attribute = "flow", .most = most}).vertex_count() / one;
  };
  EXPECT_EQ(glyph_count(1000), 1000U);
  EXPECT_EQ(glyph_count(999), 500U);
  EXPECT_EQ(glyph_count(1), 1U);
}

TEST(Glyphs, SaysWhatIsNoVector) {
  Mesh mesh = field({{1, 0, 0}});
  mesh.attributes.push_back({"height", Domain::Vertex, 1, Array<float>{1}});
  EXPECT_THROW(glyphs(mesh, {.attribute = "height"}), Error);
  EXPECT_THROW(glyphs(mesh, {.attribute = "wind"}), Error);
  EXPECT_NO_THROW(glyphs(mesh, {})) << "normals are made; without faces there are none";
}

}  // namespace
}  // namespace azulejo
