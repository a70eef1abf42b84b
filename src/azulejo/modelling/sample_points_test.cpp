#include "azulejo/modelling/sample_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "azulejo/core/error.h"
#include "azulejo/modelling/closest_point.h"
#include "azulejo/modelling/primitive.h"

namespace azulejo {
namespace {

/// Two triangles and a quad of areas 0.5, 2 and 8, apart from one another.
Mesh three_faces() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0},  {1, 0, 0},  {0, 1, 0},  {10, 0, 0}, {12, 0, 0},
                    {10, 2, 0}, {20, 0, 0}, {24, 0, 0}, {24, 2, 0}, {20, 2, 0}};
  mesh.corners = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  mesh.face_offsets = {0, 3, 6, 10};
  return mesh;
}

const Array<std::uint32_t>& faces_of(const SampledPoints& sampled) {
  return *sampled.points.find("face")->get<std::uint32_t>();
}

TEST(SamplePoints, FacesHavePointsByTheirArea) {
  const SampledPoints sampled = sample_points(three_faces(), {.count = 100'000});
  EXPECT_DOUBLE_EQ(sampled.area, 10.5);
  EXPECT_TRUE(sampled.points.corners.empty());
  ASSERT_EQ(sampled.points.vertex_count(), 100'000U);
  std::array<double, 3> counts{};
  for (const std::uint32_t face : faces_of(sampled)) ++counts[face];
  double chi_square = 0;
  for (std::size_t f = 0; f < 3; ++f) {
    const double expected = 100'000 * std::array{0.5, 2.0, 8.0}[f] / 10.5;
    chi_square += (counts[f] - expected) * (counts[f] - expected) / expected;
  }
  EXPECT_LT(chi_square, 13.8);    // two degrees of freedom: exceeded once in a thousand
  EXPECT_GT(chi_square, 0.0020);  // and fallen below as rarely: chance, not order
}

TEST(SamplePoints, IsEvenWithinATriangle) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.corners = {0, 1, 2};
  // Cells of a grid of 8: 28 whole ones and 8 halves along the diagonal.
  const SampledPoints sampled = sample_points(mesh, {.count = 64'000, .seed = 3});
  std::array<double, 64> counts{};
  for (const glm::vec3& p : sampled.points.positions) {
    const auto cell = [](float value) { return std::min<std::size_t>(7, static_cast<std::size_t>(value * 8)); };
    ++counts[8 * cell(p.y) + cell(p.x)];
  }
  double chi_square = 0;
  for (std::size_t y = 0; y < 8; ++y) {
    for (std::size_t x = 0; x + y < 8; ++x) {
      const double expected = 64'000 * (x + y == 7 ? 1.0 : 2.0) / 64;
      chi_square += (counts[8 * y + x] - expected) * (counts[8 * y + x] - expected) / expected;
    }
  }
  EXPECT_LT(chi_square, 66.6);  // 35 degrees of freedom: exceeded once in a thousand
  EXPECT_GT(chi_square, 14.7);
}

TEST(SamplePoints, LieOnTheirFaces) {
  for (const SampleMethod method : {SampleMethod::Random, SampleMethod::Poisson}) {
    const Mesh mesh = primitive({.kind = PrimitiveKind::IcoSphere, .subdivisions = 3});
    ASSERT_TRUE(mesh.all_triangles());
    const SampledPoints sampled = sample_points(mesh, {.method = method, .count = 2000});
    ASSERT_EQ(sampled.points.vertex_count(), 2000U);
    for (std::size_t i = 0; i < 2000; ++i) {
      std::array<glm::dvec3, 3> corner;
      for (std::size_t c = 0; c < 3; ++c) {
        corner[c] = glm::dvec3(mesh.positions[mesh.corners[3 * std::size_t{faces_of(sampled)[i]} + c]]);
      }
      // Floats up to 1: rounded by up to 3·10⁻⁸ in each coordinate.
      EXPECT_LT(std::sqrt(closest_point(glm::dvec3(sampled.points.positions[i]), corner).squared), 6e-8) << i;
    }
  }
}

double smallest_distance(const Mesh& cloud) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < cloud.vertex_count(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      smallest = std::min(smallest, glm::distance(glm::dvec3(cloud.positions[i]), glm::dvec3(cloud.positions[j])));
    }
  }
  return smallest;
}

TEST(SamplePoints, OfPoissonKeepTheirDistance) {
  const Mesh ball = primitive({.kind = PrimitiveKind::IcoSphere, .subdivisions = 4});
  const SampledPoints counted = sample_points(ball, {.method = SampleMethod::Poisson, .count = 1500});
  ASSERT_EQ(counted.points.vertex_count(), 1500U);
  EXPECT_GE(smallest_distance(counted.points), counted.radius - 1e-6);
  // Of all points in a plane, 0.7 of what a lattice keeps is usual.
  EXPECT_GT(counted.radius, 0.65 * std::sqrt(2 * counted.area / (std::sqrt(3.0) * 1500)));
  EXPECT_LT(smallest_distance(sample_points(ball, {.count = 1500}).points), counted.radius / 4);

  const SampledPoints spaced = sample_points(ball, {.method = SampleMethod::Poisson, .radius = 0.1F});
  EXPECT_GE(smallest_distance(spaced.points), 0.1 - 1e-6);
  EXPECT_EQ(spaced.radius, static_cast<double>(0.1F));
  // Few gaps: of points at random hardly one is farther than the radius from all.
  const SampledPoints probes = sample_points(ball, {.count = 2000, .seed = 9});
  int gaps = 0;
  for (const glm::vec3& probe : probes.points.positions) {
    gaps += std::none_of(spaced.points.positions.begin(), spaced.points.positions.end(),
                         [&](const glm::vec3& p) { return glm::distance(p, probe) < 0.1F; })
                ? 1
                : 0;
  }
  EXPECT_LT(gaps, 60);
}

TEST(SamplePoints, AreTheSameForAnyNumberOfThreadsAndOthersForEachSeed) {
  const Mesh mesh = primitive({.kind = PrimitiveKind::Teapot});
  for (const SampleMethod method : {SampleMethod::Random, SampleMethod::Poisson}) {
    const SampledPoints one = sample_points(mesh, {.method = method, .count = 9000}, {.threads = 1});
    const SampledPoints many = sample_points(mesh, {.method = method, .count = 9000}, {.threads = 5});
    EXPECT_EQ(one.points.positions, many.points.positions);
    EXPECT_EQ(*one.points.find("NORMAL")->get<float>(), *many.points.find("NORMAL")->get<float>());
    const SampledPoints other = sample_points(mesh, {.method = method, .count = 9000, .seed = 1});
    EXPECT_NE(one.points.positions, other.points.positions);
  }
  const SampledPoints few = sample_points(mesh, {.count = 10});
  const SampledPoints more = sample_points(mesh, {.count = 20});
  EXPECT_TRUE(std::equal(few.points.positions.begin(), few.points.positions.end(), more.points.positions.begin()));
}

TEST(SamplePoints, CarryWhatCornersHave) {
  Mesh mesh = three_faces();
  // A linear function of the place is known at each point.
  Array<float> uv;
  for (const std::uint32_t corner : mesh.corners) {
    uv.push_back(mesh.positions[corner].x);
    uv.push_back(3 - mesh.positions[corner].y);
  }
  mesh.attributes.push_back({"TEXCOORD_0", Domain::Corner, 2, std::move(uv)});
  Array<std::uint8_t> color(3 * mesh.vertex_count());
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    color[3 * v] = static_cast<std::uint8_t>(10 * mesh.positions[v].x);
    color[3 * v + 1] = 255;
    color[3 * v + 2] = 0;
  }
  mesh.attributes.push_back({"COLOR_0", Domain::Vertex, 3, std::move(color)});
  mesh.attributes.push_back({"group", Domain::Face, 1, Array<std::uint32_t>{7, 8, 9}});
  mesh.attributes.push_back({"place", Domain::Vertex, 1, Array<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}});
  mesh.attributes.push_back({"JOINTS_0", Domain::Vertex, 4, Array<std::uint32_t>(40, 0)});
  const SampledPoints sampled = sample_points(mesh, {.count = 500});
  const Mesh& cloud = sampled.points;
  cloud.check("cloud");
  EXPECT_EQ(cloud.find("JOINTS_0"), nullptr);
  for (std::size_t i = 0; i < 500; ++i) {
    const glm::vec3& p = cloud.positions[i];
    EXPECT_NEAR((*cloud.find("TEXCOORD_0")->get<float>())[2 * i], p.x, 1e-5);
    EXPECT_NEAR((*cloud.find("TEXCOORD_0")->get<float>())[2 * i + 1], 3 - p.y, 1e-5);
    EXPECT_NEAR((*cloud.find("COLOR_0")->get<std::uint8_t>())[3 * i], 10 * p.x, 0.501);
    EXPECT_EQ((*cloud.find("COLOR_0")->get<std::uint8_t>())[3 * i + 1], 255);
    EXPECT_EQ((*cloud.find("group")->get<std::uint32_t>())[i], 7 + faces_of(sampled)[i]);
    // The corner with the largest share is one of the face's.
    const std::uint32_t place = (*cloud.find("place")->get<std::uint32_t>())[i];
    EXPECT_EQ(std::min(place / 3, 2U), faces_of(sampled)[i]);
    EXPECT_EQ((*cloud.find("NORMAL")->get<float>())[3 * i + 2], 1);
  }
}

TEST(SamplePoints, NormalsAreTheMeshesOwnAndOfUnitLength) {
  const Mesh ball = primitive({.kind = PrimitiveKind::IcoSphere, .subdivisions = 2, .smooth = true});
  ASSERT_NE(ball.find("NORMAL"), nullptr);
  const Mesh cloud = sample_points(ball, {.count = 300}).points;
  for (std::size_t i = 0; i < 300; ++i) {
    const float* const n = cloud.find("NORMAL")->get<float>()->data() + 3 * i;
    const glm::vec3 normal(n[0], n[1], n[2]);
    EXPECT_NEAR(glm::length(normal), 1, 1e-6);
    EXPECT_GT(glm::dot(normal, glm::normalize(cloud.positions[i])), 0.999F);
  }
}

TEST(SamplePoints, TakesADensity) {
  EXPECT_EQ(sample_points(three_faces(), {.density = 10}).points.vertex_count(), 105U);
  EXPECT_EQ(sample_points(three_faces(), {.method = SampleMethod::Poisson, .density = 10}).points.vertex_count(), 105U);
  EXPECT_EQ(sample_points(three_faces()).points.vertex_count(), 10'000U);
  EXPECT_EQ(sample_points(three_faces(), {.count = 0}).points.vertex_count(), 0U);
}

TEST(SamplePoints, RefusesWhatDoesNotFitTogether) {
  EXPECT_THROW(sample_points(three_faces(), {.count = 5, .density = 5}), Error);
  EXPECT_THROW(sample_points(three_faces(), {.radius = 1}), Error);
  EXPECT_THROW(sample_points(three_faces(), {.density = 1e20F}), Error);
  EXPECT_THROW(sample_points(three_faces(), {.method = SampleMethod::Poisson, .radius = 1e-5F}), Error);
  EXPECT_THROW(sample_points(three_faces(), {.count = -1}), Error);
}

TEST(SamplePoints, OfAnything) {
  EXPECT_EQ(sample_points(Mesh()).points.vertex_count(), 0U);
  Mesh broken = three_faces();
  broken.positions[7].x = std::numeric_limits<float>::quiet_NaN();
  std::vector<std::string> warnings;
  azulejo::Run run;
  run.warn = [&](const std::string& message) { warnings.push_back(message); };
  const SampledPoints sampled = sample_points(broken, {.count = 1000}, run);
  EXPECT_EQ(warnings.size(), 1U);
  for (const glm::vec3& p : sampled.points.positions) EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
  Mesh line = three_faces();
  for (glm::vec3& p : line.positions) p.y = 0;
  EXPECT_EQ(sample_points(line).points.vertex_count(), 0U);
  // A speck beside what is far: the points of one are all at one place.
  Mesh speck;
  speck.positions = {{0, 0, 0}, {1e-30F, 0, 0}, {0, 1e-30F, 0}};
  speck.corners = {0, 1, 2};
  EXPECT_EQ(sample_points(speck, {.method = SampleMethod::Poisson, .count = 50}).points.vertex_count(), 50U);
}

}  // namespace
}  // namespace azulejo
