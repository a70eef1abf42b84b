#include "azulejo/modelling/weld.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "azulejo/io/model_testing.h"
#include "azulejo/modelling/primitive.h"
#include "azulejo/modelling/topology.h"

namespace azulejo {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

Mesh cloud(const std::vector<glm::vec3>& points) {
  Mesh mesh;
  mesh.positions.assign(points.begin(), points.end());
  return mesh;
}

/// Whole multiples of a quarter, so that distances often are exactly the tolerance.
std::vector<glm::vec3> random_points(std::size_t count, unsigned range, unsigned seed) {
  std::mt19937 random(seed);
  const auto number = [&] { return 0.25F * (static_cast<float>(random() % range) - 0.5F * static_cast<float>(range)); };
  std::vector<glm::vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    points.emplace_back(number(), number(), number());
    if (random() % 60 == 0) points.back().z = kNan;
    if (random() % 60 == 0) points.back().x = kInfinity;
    if (random() % 5 == 0) points.back() *= -1.0F;
  }
  return points;
}

/// The rule of `distance`, each with each.
std::vector<std::uint32_t> plainly_near(const std::vector<glm::vec3>& points, double tolerance) {
  std::vector<std::uint32_t> result;
  std::vector<std::pair<std::size_t, std::uint32_t>> stayed;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto equal = std::find(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(i), points[i]);
    if (const auto j = static_cast<std::size_t>(equal - points.begin()); j < i) {
      result.push_back(result[j]);
      continue;
    }
    double least = std::numeric_limits<double>::infinity();
    std::uint32_t nearest = 0;
    for (const auto& [other, number] : stayed) {
      const glm::dvec3 way = glm::dvec3(points[other]) - glm::dvec3(points[i]);
      const double squared = glm::dot(way, way);
      if (squared <= tolerance * tolerance && squared < least) {
        least = squared;
        nearest = number;
      }
    }
    if (std::isinf(least)) {
      nearest = static_cast<std::uint32_t>(stayed.size());
      stayed.emplace_back(i, nearest);
    }
    result.push_back(nearest);
  }
  return result;
}

TEST(WeldMesh, DistanceIsByItsDefinition) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    for (const unsigned range : {6U, 30U, 200U}) {
      for (const float tolerance : {0.0F, 0.25F, 0.3F, 0.5F, 2.0F, 1e6F}) {
        SCOPED_TRACE(testing::Message() << "seed " << seed << ", range " << range << ", tolerance " << tolerance);
        const std::vector<glm::vec3> points = random_points(700, range, seed);
        EXPECT_EQ(listed(weld(cloud(points), {.tolerance = tolerance}).vertices),
                  plainly_near(points, static_cast<double>(tolerance)));
      }
    }
  }
}

TEST(WeldMesh, GridIsByItsDefinition) {
  const std::vector<glm::vec3> points = random_points(1000, 100, 4);
  const WeldedMesh welded = weld(cloud(points), {.tolerance = 1.5F, .method = WeldMethod::Grid});
  const auto cell = [](const glm::vec3& p) { return glm::roundEven(glm::dvec3(p) / 1.5); };
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const bool finite = std::isfinite(points[i].x + points[i].y + points[i].z);
      EXPECT_EQ(welded.vertices[i] == welded.vertices[j],
                points[i] == points[j] || (finite && cell(points[i]) == cell(points[j])))
          << i << " and " << j;
    }
  }
}

TEST(WeldMesh, EqualPlacesWithoutTolerance) {
  const WeldedMesh welded = weld(cloud({{0, 0, 0}, {-0.0F, 0, -0.0F}, {kNan, 0, 0}, {kNan, 0, 0}, {1e-30F, 0, 0}}));
  EXPECT_EQ(listed(welded.vertices), (std::vector<std::uint32_t>{0, 0, 1, 2, 3}));
  EXPECT_EQ(welded.welded, 1U);
}

TEST(WeldMesh, NothingGoesFartherThanTheToleranceAndAgainChangesNothing) {
  for (const WeldMethod method : {WeldMethod::Distance, WeldMethod::Grid}) {
    Mesh mesh = random_mesh(2000, 3000, false, 5);
    for (glm::vec3& each : mesh.positions) each *= 0.2F;
    mesh.attributes.push_back(random_attribute<float>(mesh, "TEXCOORD_0", Domain::Vertex, 2, 6));
    mesh.attributes.push_back(random_attribute<std::uint8_t>(mesh, "COLOR_0", Domain::Corner, 3, 7));
    mesh.attributes.push_back(random_attribute<float>(mesh, "quality", Domain::Face, 1, 8));
    mesh.lines = {1, 2, 3, 4, 5, 5};
    const WeldedMesh once = weld(mesh, {.tolerance = 0.3F, .method = method});
    once.mesh.check("welded");
    EXPECT_GT(once.welded, 100U);
    EXPECT_GT(once.dropped_faces, 100U);
    const double farthest = method == WeldMethod::Grid ? 0.3 * std::sqrt(3) : 0.3;
    EXPECT_LE(once.largest_distance, farthest * (1 + 1e-6));
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
      const glm::vec3 now = once.mesh.positions[once.vertices[v]];
      EXPECT_LE(glm::distance(glm::dvec3(mesh.positions[v]), glm::dvec3(now)), once.largest_distance);
    }
    const WeldedMesh twice = weld(once.mesh, {.tolerance = 0.3F, .method = method});
    EXPECT_TRUE(same_mesh(once.mesh, twice.mesh));
    azulejo::Run run;
    run.threads = 3;
    EXPECT_TRUE(same_mesh(once.mesh, weld(mesh, {.tolerance = 0.3F, .method = method}, run).mesh));
  }
}

TEST(WeldMesh, WhatIsWholeStaysByteForByte) {
  for (const PrimitiveKind kind : {PrimitiveKind::Torus, PrimitiveKind::Cylinder, PrimitiveKind::Icosahedron}) {
    const Mesh mesh = primitive({.kind = kind});
    EXPECT_TRUE(same_mesh(mesh, weld(mesh).mesh));
    EXPECT_TRUE(same_mesh(mesh, weld(mesh, {.tolerance = 1e-3F}).mesh));
  }
}

TEST(WeldMesh, SoupBecomesTheSurfaceThatItWas) {
  std::mt19937 random(10);
  const Mesh sphere = primitive({.kind = PrimitiveKind::IcoSphere});
  Mesh soup;
  for (const std::uint32_t v : sphere.corners) {
    const glm::vec3 shake(random() % 100, random() % 100, random() % 100);
    soup.corners.push_back(static_cast<std::uint32_t>(soup.positions.size()));
    soup.positions.push_back(sphere.positions[v] + 1e-6F * shake);
  }
  // Shaken by no more than 1e-4 · √3, edges are longer than 0.1.
  EXPECT_TRUE(topology(weld(soup, {.tolerance = 2e-4F}).mesh).printable());
  EXPECT_TRUE(topology(weld(soup, {.relative_tolerance = 1e-4F}).mesh).printable());
  EXPECT_FALSE(topology(weld(soup).mesh).closed());
}

/// Two squares beside each other, each with its own vertices and texture coordinates.
Mesh two_squares() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}};
  mesh.corners = {0, 1, 2, 3, 4, 5, 6, 7};
  mesh.face_offsets = {0, 4, 8};
  mesh.attributes.push_back({"U", Domain::Vertex, 1, Array<float>{0, 1, 1, 0, 5, 6, 6, 5}});
  mesh.attributes.push_back({"Z", Domain::Vertex, 1, Array<float>{0, 1, 2, 3, 1, 5, 6, 2}});
  return mesh;
}

TEST(WeldMesh, AttributesThatDifferGoToCorners) {
  const WeldedMesh welded = weld(two_squares());
  EXPECT_EQ(listed(welded.mesh.corners), (std::vector<std::uint32_t>{0, 1, 2, 3, 1, 4, 5, 2}));
  EXPECT_EQ(welded.corner_attributes, std::vector<std::string>{"U"});
  EXPECT_EQ(welded.mesh.find("U")->domain, Domain::Corner);
  EXPECT_EQ(values_of<float>(welded.mesh, "U"), (std::vector<float>{0, 1, 1, 0, 5, 6, 6, 5}));
  EXPECT_EQ(welded.mesh.find("Z")->domain, Domain::Vertex);
  EXPECT_EQ(values_of<float>(welded.mesh, "Z"), (std::vector<float>{0, 1, 2, 3, 5, 6}));
  welded.mesh.check("welded");
}

TEST(WeldMesh, AttributesOfTheFirstOrSeparate) {
  const WeldedMesh first = weld(two_squares(), {.attributes = WeldAttributes::First});
  EXPECT_EQ(values_of<float>(first.mesh, "U"), (std::vector<float>{0, 1, 1, 0, 6, 6}));
  EXPECT_EQ(weld(two_squares(), {.attributes = WeldAttributes::Separate}).welded, 0U);
  Mesh alike = two_squares();
  alike.attributes.erase(alike.attributes.begin());
  EXPECT_EQ(weld(alike, {.attributes = WeldAttributes::Separate}).welded, 2U);
}

TEST(WeldMesh, WhatMovesDifferentlyStaysApart) {
  Mesh mesh = two_squares();
  mesh.morph_targets.resize(1);
  mesh.morph_targets[0].positions.assign(8, glm::vec3(0));
  mesh.morph_targets[0].positions[4] = {0, 0, 1};
  const WeldedMesh welded = weld(mesh);
  EXPECT_EQ(listed(welded.vertices), (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 2}));
  EXPECT_EQ(welded.mesh.morph_targets[0].positions[4], glm::vec3(0, 0, 1));
  mesh.morph_targets.clear();
  mesh.attributes.push_back({"WEIGHTS_0", Domain::Vertex, 1, Array<float>{0, 0, 1, 0, 0, 0, 2, 2}});
  EXPECT_EQ(weld(mesh).welded, 1U);
}

TEST(WeldMesh, WhatBecomesDegenerateGoesUnlessItIsKept) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.01F, 1, 0}, {1, 1.01F, 0}};
  mesh.corners = {0, 1, 2, 4, 3, 2, 5, 3, 4};  // a pentagon; a square that becomes an edge
  mesh.face_offsets = {0, 5, 9};
  mesh.lines = {3, 4, 0, 4};
  const WeldedMesh welded = weld(mesh, {.tolerance = 0.1F});
  EXPECT_EQ(listed(welded.mesh.corners), (std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(listed(welded.mesh.face_offsets), (std::vector<std::uint32_t>{0, 4}));
  EXPECT_EQ(listed(welded.mesh.lines), (std::vector<std::uint32_t>{0, 3}));
  EXPECT_EQ(welded.dropped_faces, 1U);
  EXPECT_EQ(welded.dropped_corners, 1U);
  EXPECT_EQ(welded.dropped_lines, 1U);
  const WeldedMesh kept = weld(mesh, {.tolerance = 0.1F, .drop_degenerate = false});
  EXPECT_EQ(listed(kept.mesh.corners), (std::vector<std::uint32_t>{0, 1, 2, 3, 3, 2, 2, 3, 3}));
  EXPECT_EQ(kept.mesh.lines.size(), 4U);
}

TEST(WeldMesh, ManyAtOnePlaceAndFarAway) {
  // A million within the tolerance of each other, and where a cell is smaller than the last bit of a coordinate.
  std::mt19937 random(11);
  std::vector<glm::vec3> points;
  for (int i = 0; i < 1'000'000; ++i) points.emplace_back(random() % 1000, random() % 1000, random() % 1000);
  EXPECT_EQ(weld(cloud(points), {.tolerance = 2000}).mesh.vertex_count(), 1U);
  EXPECT_EQ(weld(cloud({{3e38F, 0, 0}, {3e38F, 0, 1e-30F}, {2e38F, 0, 0}}), {.tolerance = 1e-20F}).welded, 1U);
  EXPECT_EQ(weld(cloud({{3e38F, 0, 0}, {-3e38F, 0, 0}}), {.tolerance = 1e30F}).welded, 0U);
}

TEST(WeldMesh, RefusesTolerances) {
  EXPECT_THROW(weld(Mesh(), {.tolerance = -1}), Error);
  EXPECT_THROW(weld(Mesh(), {.relative_tolerance = kNan}), Error);
  EXPECT_EQ(weld(Mesh()).mesh.vertex_count(), 0U);
}

}  // namespace
}  // namespace azulejo
