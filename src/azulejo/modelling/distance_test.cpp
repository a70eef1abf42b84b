#include "azulejo/modelling/distance.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "azulejo/core/error.h"
#include "azulejo/modelling/nearest_triangle.h"
#include "azulejo/modelling/primitive.h"
#include "azulejo/modelling/triangulate.h"

namespace azulejo {
namespace {

using Triangle = std::array<glm::dvec3, 3>;

/// Triangles of all shapes: some long and thin, some segments, some points.
std::vector<NearestTriangle::Triangle> soup(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-1, 1);
  std::vector<NearestTriangle::Triangle> list(count);
  for (std::size_t t = 0; t < count; ++t) {
    const glm::vec3 middle(place(random), place(random), place(random));
    for (glm::vec3& corner : list[t]) {
      corner = middle + 0.2F * glm::vec3(place(random), place(random), place(random));
    }
    if (t % 7 == 0) list[t][2] = list[t][1];
    if (t % 11 == 0) list[t][1] = list[t][0];
    if (t % 13 == 0) list[t][2] = (list[t][0] + list[t][1]) * 0.5F;
  }
  return list;
}

/// The smallest distance to points of a triangle, by nested ternary search in its convex distance.
double searched_distance(const glm::dvec3& p, const Triangle& t) {
  const auto along = [&](double u) {
    const glm::dvec3 a = t[0] + (t[1] - t[0]) * u;
    const glm::dvec3 b = t[0] + (t[2] - t[0]) * u;
    double low = 0;
    double high = 1;
    for (int i = 0; i < 100; ++i) {
      const double first = low + (high - low) / 3;
      const double second = high - (high - low) / 3;
      (glm::distance(p, a + (b - a) * first) < glm::distance(p, a + (b - a) * second) ? high : low) =
          glm::distance(p, a + (b - a) * first) < glm::distance(p, a + (b - a) * second) ? second : first;
    }
    return glm::distance(p, a + (b - a) * low);
  };
  double low = 0;
  double high = 1;
  for (int i = 0; i < 100; ++i) {
    const double first = low + (high - low) / 3;
    const double second = high - (high - low) / 3;
    if (along(first) < along(second)) {
      high = second;
    } else {
      low = first;
    }
  }
  return along(low);
}

TEST(ClosestPoint, IsWhatASearchInTheTriangleFinds) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  for (const NearestTriangle::Triangle& each : soup(150, 2)) {
    const Triangle triangle{glm::dvec3(each[0]), glm::dvec3(each[1]), glm::dvec3(each[2])};
    const glm::dvec3 p(place(random), place(random), place(random));
    const ClosestPoint found = closest_point(p, triangle);
    // The search knows a smooth minimum only to the root of the precision of doubles, its value to all of it.
    EXPECT_NEAR(std::sqrt(found.squared), searched_distance(p, triangle), 1e-9);
    EXPECT_NEAR(glm::distance(p, found.point), std::sqrt(found.squared), 1e-14);
  }
}

TEST(NearestTriangle, IsTheNearestOfAll) {
  for (const std::size_t count : {1U, 2U, 4U, 5U, 16U, 17U, 64U, 65U, 300U, 3000U}) {
    const auto triangles = soup(count, 3);
    const NearestTriangle tree(triangles, {});
    ASSERT_EQ(tree.size(), count);
    std::mt19937 random(4);
    std::uniform_real_distribution<double> place(-2, 2);
    std::uint32_t guess = NearestTriangle::kNone;
    for (int i = 0; i < 200; ++i) {
      const glm::dvec3 p(place(random), place(random), place(random));
      double nearest = std::numeric_limits<double>::infinity();
      for (const auto& each : triangles) {
        nearest = std::min(nearest,
                           closest_point(p, {glm::dvec3(each[0]), glm::dvec3(each[1]), glm::dvec3(each[2])}).squared);
      }
      const NearestTriangle::Found found = tree.find(p);
      // The same operations in the same order.
      EXPECT_EQ(found.squared, nearest) << count;
      EXPECT_EQ(found.squared, closest_point(p, tree.corners(found.slot)).squared);
      EXPECT_EQ(glm::vec3(tree.corners(found.slot)[0]), triangles[tree.index(found.slot)][0]);
      EXPECT_EQ(tree.find(p, guess).squared, nearest);
      guess = found.slot;
    }
  }
}

Mesh triangle_at(float height, float size = 1) {
  Mesh mesh;
  mesh.positions = {{0, 0, height}, {size, 0, height}, {0, size, height}};
  mesh.corners = {0, 1, 2};
  return mesh;
}

Mesh ball(float radius, int subdivisions) {
  return primitive({.kind = PrimitiveKind::IcoSphere, .radius = radius, .subdivisions = subdivisions});
}

TEST(MeshDistance, ParallelPlanesAreApartByTheirDistance) {
  const MeshDistance found = distance(triangle_at(0), triangle_at(0.25F));
  EXPECT_DOUBLE_EQ(found.maximum(), 0.25);
  EXPECT_DOUBLE_EQ(found.maximum_bound(), 0.25);
  EXPECT_DOUBLE_EQ(found.mean(), 0.25);
  EXPECT_DOUBLE_EQ(found.rms(), 0.25);
  EXPECT_EQ(found.diagonal, std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(found.forward.nearest.z - found.forward.place.z, 0.25);
}

TEST(MeshDistance, HasADirection) {
  // A small triangle in the corner of a large one. Of x + y ≤ 1, (1, 0) is nearest to the large one's corner (2, 0).
  const MeshDistance found = distance(triangle_at(0), triangle_at(0, 2));
  EXPECT_EQ(found.forward.maximum, 0);
  EXPECT_EQ(found.forward.maximum_bound, 0);
  ASSERT_TRUE(found.backward);
  EXPECT_EQ(found.backward->maximum, 1);
  EXPECT_LE(found.backward->maximum_bound, 1 + 1e-4 * std::sqrt(2.0));
  EXPECT_EQ(found.maximum(), 1);
  EXPECT_FALSE(distance(triangle_at(0), triangle_at(0, 2), {.symmetric = false}).backward);
}

TEST(MeshDistance, MeanAndRmsAreIntegralsOverTheArea) {
  // From a triangle that stands on a plane: the distance is the height y in 0…1, with density 2 (1 − y).
  Mesh standing = triangle_at(0);
  for (glm::vec3& p : standing.positions) p = {p.x, 0, p.y};
  Mesh floor;
  floor.positions = {{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}};
  floor.corners = {0, 1, 2, 3};
  floor.face_offsets = {0, 4};
  const MeshDistance found = distance(standing, floor, {.symmetric = false, .samples = 100'000});
  // Mean 1/3, mean square 1/6, variance 1/18: five standard errors.
  EXPECT_NEAR(found.mean(), 1.0 / 3, 5 * std::sqrt(1.0 / 18 / 100'000));
  EXPECT_NEAR(found.rms(), std::sqrt(1.0 / 6), 5 * std::sqrt(1.0 / 18 / 100'000));
  EXPECT_NEAR(found.forward.mean_error, std::sqrt(1.0 / 18 / 100'000), 1e-5);
  EXPECT_EQ(found.maximum(), 1);
  EXPECT_EQ(found.forward.samples, 100'000U);
}

TEST(MeshDistance, FindsAMaximumThatNoVertexAndHardlyASampleHas) {
  // A floor whose vertices are on the eaves of a roof: its middle line, below the ridge, is farthest.
  Mesh roof;
  roof.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, -1, 1}, {0, 1, 1}};
  roof.corners = {0, 4, 5, 3, 4, 1, 2, 5};
  roof.face_offsets = {0, 4, 8};
  Mesh floor;
  floor.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  floor.corners = {0, 1, 2, 3};
  floor.face_offsets = {0, 4};
  for (const float tolerance : {1e-2F, 1e-4F}) {
    const MeshDistance found =
        distance(floor, roof, {.symmetric = false, .tolerance = tolerance, .samples = 1, .refinements = 1'000'000});
    // From the middle line to a roof of 45°: half of √2.
    const double truth = std::sqrt(0.5);
    EXPECT_LE(found.maximum(), truth + 1e-12);
    EXPECT_GE(found.maximum_bound(), truth - 1e-12);
    EXPECT_LE(found.maximum_bound() - found.maximum(), static_cast<double>(tolerance) * found.diagonal * (1 + 1e-9));
    EXPECT_NEAR(found.forward.place.x, 0, std::sqrt(2.0) * static_cast<double>(tolerance) * found.diagonal);
  }
}

TEST(MeshDistance, SpheresAreApartByTheDifferenceOfTheirRadii) {
  // Faces of a sphere of radius r, edges up to e: their points are r − e²/(6 r) and more from the middle.
  const Mesh inner = ball(1, 5);
  const Mesh outer = ball(1.5F, 5);
  const double sag = 2.0 * (1 - std::cos(1.107 / 32)) * 1.5;  // the edge of the icosahedron is 1.107, halved five times
  const MeshDistance found = distance(inner, outer);
  EXPECT_NEAR(found.maximum(), 0.5, sag);
  EXPECT_NEAR(found.mean(), 0.5, sag);
  EXPECT_GE(found.maximum_bound(), found.maximum());
  EXPECT_LE(found.maximum_bound(), found.maximum() + 1e-4 * found.diagonal * (1 + 1e-9));
}

TEST(MeshDistance, OfAMeshAndItselfIsNothing) {
  const Mesh knot = primitive({.kind = PrimitiveKind::TorusKnot});
  const MeshDistance found = distance(knot, knot);
  // Samples lie on the triangles but for rounding.
  EXPECT_LT(found.maximum(), 1e-14);
  EXPECT_LT(found.maximum_bound(), 1e-4 * found.diagonal);
  for (const float each : found.of_vertices) EXPECT_EQ(each, 0);
}

TEST(MeshDistance, GrowsWithTheModelsAndDoesNotMindWhereTheyAre) {
  const Mesh a = ball(1, 2);
  const Mesh b = ball(1, 4);
  const MeshDistance here = distance(a, b);
  const auto moved = [](const Mesh& mesh, float scale, const glm::vec3& by) {
    Mesh other = mesh.clone();
    for (glm::vec3& p : other.positions) p = p * scale + by;
    return other;
  };
  const MeshDistance large = distance(moved(a, 4, {}), moved(b, 4, {}));
  EXPECT_EQ(large.maximum(), 4 * here.maximum());  // a power of two: exactly
  EXPECT_EQ(large.mean(), 4 * here.mean());
  EXPECT_EQ(large.diagonal, 4 * here.diagonal);
  // Positions are rounded to 2⁻¹³ there.
  const MeshDistance far = distance(moved(a, 1, {1000, 2000, -500}), moved(b, 1, {1000, 2000, -500}));
  EXPECT_NEAR(far.maximum(), here.maximum(), 4e-4);
  EXPECT_NEAR(far.mean(), here.mean(), 4e-4);
}

TEST(MeshDistance, SwappedIsTheOtherWay) {
  const Mesh a = ball(1, 2);
  const Mesh b = primitive({.kind = PrimitiveKind::Cube, .size = 1.5F});
  const MeshDistance there = distance(a, b);
  const MeshDistance back = distance(b, a);
  EXPECT_EQ(there.forward.maximum, back.backward->maximum);
  EXPECT_EQ(there.forward.mean, back.backward->mean);
  EXPECT_EQ(there.backward->rms, back.forward.rms);
}

TEST(MeshDistance, IsTheSameForAnyNumberOfThreads) {
  const Mesh a = ball(1, 3);
  const Mesh b = primitive({.kind = PrimitiveKind::Teapot});
  const std::string one = report_of(distance(a, b, {}, {.threads = 1})).json.dump();
  for (const int threads : {2, 5}) {
    EXPECT_EQ(report_of(distance(a, b, {}, {.threads = threads})).json.dump(), one);
  }
  EXPECT_NE(report_of(distance(a, b, {.seed = 1})).json.dump(), one);
}

TEST(MeshDistance, BoundsHoldHoweverLittleIsLookedAt) {
  // Beside a measurement that is nearly exact.
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(-1, 1);
  for (unsigned seed = 0; seed < 10; ++seed) {
    Mesh a;
    Mesh b;
    for (Mesh* const mesh : {&a, &b}) {
      for (const auto& each : soup(30, seed * 2 + (mesh == &a ? 0 : 1))) {
        for (const glm::vec3& corner : each) {
          mesh->corners.push_back(static_cast<std::uint32_t>(mesh->positions.size()));
          mesh->positions.push_back(corner);
        }
      }
    }
    const MeshDistance exact = distance(a, b, {.tolerance = 1e-5F, .refinements = 10'000'000});
    EXPECT_LE(exact.maximum_bound() - exact.maximum(), 1e-5 * exact.diagonal * (1 + 1e-9)) << seed;
    for (const int refinements : {0, 1, 10, 100}) {
      const MeshDistance rough = distance(a, b, {.tolerance = 1e-5F, .samples = 1, .refinements = refinements});
      EXPECT_LE(rough.maximum(), exact.maximum_bound()) << seed;
      EXPECT_GE(rough.maximum_bound(), exact.maximum()) << seed;
      EXPECT_LE(rough.forward.refinements, static_cast<std::size_t>(refinements));
    }
  }
}

TEST(MeshDistance, TakesPoints) {
  Mesh cloud;
  cloud.positions = {{0, 0, 3}, {0, 0, 1}, {0.25F, 0.25F, 2}};
  const MeshDistance found = distance(cloud, triangle_at(0));
  EXPECT_EQ(found.forward.maximum, 3);
  EXPECT_EQ(found.forward.maximum_bound, 3);
  EXPECT_EQ(found.forward.mean, 2);
  EXPECT_EQ(found.forward.samples, 0U);
  EXPECT_EQ(found.of_vertices, (Array<float>{3, 1, 2}));
  EXPECT_EQ(found.backward->maximum, std::sqrt(2.0));  // from (1, 0, 0) to (0, 0, 1)
  Mesh one;
  one.positions = {{0, 0, 0}};
  const MeshDistance points = distance(cloud, one);
  EXPECT_EQ(points.maximum(), 3);
  EXPECT_EQ(points.diagonal, 0);
  EXPECT_TRUE(report_of(points).json["relative"]["maximum"].is_null());
}

TEST(MeshDistance, LeavesOutWhatIsNotFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  Mesh broken = triangle_at(1);
  broken.positions.emplace_back(nan, 0.0F, 0.0F);
  broken.positions.emplace_back(99.0F, 0.0F, 0.0F);  // used by no finite triangle
  broken.corners.insert(broken.corners.end(), {0, 1, 3, 0, 3, 4});
  std::vector<std::string> warnings;
  azulejo::Run run;
  run.warn = [&](const std::string& message) { warnings.push_back(message); };
  const MeshDistance found = distance(broken, triangle_at(0), {}, run);
  EXPECT_DOUBLE_EQ(found.maximum(), 1);
  EXPECT_EQ(warnings, std::vector<std::string>{"source: 2 of its triangles are not finite and left out"});
  EXPECT_TRUE(std::isnan(found.of_vertices[3]));
  EXPECT_FLOAT_EQ(found.of_vertices[4], 98);
}

TEST(MeshDistance, OfSurfacesWithoutAreaIsThatOfTheirVertices) {
  Mesh line = triangle_at(2);
  line.positions[2] = {2, 0, 2};
  const MeshDistance found = distance(line, triangle_at(0));
  EXPECT_EQ(found.forward.samples, 0U);
  EXPECT_EQ(found.forward.maximum, std::sqrt(5.0));
  EXPECT_DOUBLE_EQ(found.forward.mean, (4 + std::sqrt(5.0)) / 3);
}

TEST(MeshDistance, RefusesNothingAtAll) {
  Mesh nothing;
  EXPECT_THROW(distance(nothing, triangle_at(0)), Error);
  try {
    distance(triangle_at(0), nothing);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()), "reference: 0 vertices, none of them finite, expected one at least");
  }
  EXPECT_THROW(distance(triangle_at(0), triangle_at(0), {.tolerance = -1}), Error);
}

TEST(MeshDistance, SaysWhetherItIsClose) {
  const Mesh a = triangle_at(0);
  const Mesh b = triangle_at(0.25F);
  const auto close = [&](const MeshDistanceOptions& options) {
    return report_of(distance(a, b, options), options).verdict;
  };
  EXPECT_TRUE(close({}));
  EXPECT_TRUE(close({.at_most = 0.25F}));
  EXPECT_FALSE(close({.at_most = 0.24F}));
  EXPECT_FALSE(close({.metric = DistanceMetric::Mean, .at_most = 0.24F}));
  EXPECT_TRUE(close({.at_most = 0.18F, .relative = true}));  // 0.25 ÷ √2 = 0.177
  EXPECT_FALSE(close({.at_most = 0.17F, .relative = true}));
}

TEST(MeshDistance, LooksAsLongAsTheVerdictIsOpen) {
  // The bound of a rough measurement would be more than what is asked for.
  const Mesh a = ball(1, 1);
  const Mesh b = ball(1, 5);
  const MeshDistance rough = distance(a, b, {.tolerance = 0.1F, .samples = 1});
  const double asked = 1.001 * distance(a, b, {.tolerance = 1e-5F}).maximum_bound();
  ASSERT_GT(rough.maximum_bound(), asked);
  const MeshDistanceOptions options{.tolerance = 0.1F, .samples = 1, .at_most = static_cast<float>(asked)};
  EXPECT_TRUE(is_close(distance(a, b, options), options));
}

}  // namespace
}  // namespace azulejo
