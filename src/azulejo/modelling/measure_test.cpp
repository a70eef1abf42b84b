#include "azulejo/modelling/measure.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "azulejo/modelling/primitive.h"

namespace azulejo {
namespace {

constexpr double kPi = std::numbers::pi;

Mesh cuboid(const glm::vec3& size, const glm::vec3& lower = {0, 0, 0}) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) mesh.positions.push_back(lower + size * glm::vec3(i & 1, i >> 1 & 1, i >> 2 & 1));
  mesh.corners = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
  mesh.face_offsets = {0, 4, 8, 12, 16, 20, 24};
  return mesh;
}

Mesh tetrahedron() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.corners = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  return mesh;
}

void append(Mesh& mesh, const Mesh& other) {
  const auto first = static_cast<std::uint32_t>(mesh.vertex_count());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  for (const std::uint32_t corner : other.corners) mesh.corners.push_back(first + corner);
}

Mesh moved(const Mesh& mesh, const glm::dmat3& matrix, const glm::dvec3& by = {0, 0, 0}) {
  Mesh result = mesh.clone();
  for (glm::vec3& p : result.positions) p = glm::vec3(matrix * glm::dvec3(p) + by);
  return result;
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}
void expect_near(const glm::dmat3& a, const glm::dmat3& b, double tolerance) {
  for (int i = 0; i < 3; ++i) expect_near(a[i], b[i], tolerance);
}

TEST(Measure, OfACuboid) {
  const MeshMeasure found = measure(cuboid({2, 3, 4}, {10, 20, 30}));
  EXPECT_DOUBLE_EQ(found.all.area, 2 * (6 + 8 + 12));
  ASSERT_TRUE(found.all.solid);
  EXPECT_DOUBLE_EQ(found.all.solid->volume, 24);
  expect_near(found.all.solid->centroid, {11, 21.5, 32}, 1e-13);
  expect_near(found.all.surface_centroid, {11, 21.5, 32}, 1e-13);
  // m/12 (b² + c²) …
  expect_near(found.all.solid->inertia, {{50, 0, 0}, {0, 40, 0}, {0, 0, 26}}, 1e-12);
  expect_near(found.all.solid->moments, {26, 40, 50}, 1e-12);
  expect_near(found.all.solid->axes[0], {0, 0, 1}, 1e-12);
  EXPECT_EQ(found.all.box, (Box3{{10, 20, 30}, {12, 23, 34}}));
  EXPECT_DOUBLE_EQ(found.oriented_box.volume(), 24);
  expect_near(found.oriented_box.center, {11, 21.5, 32}, 1e-13);
  EXPECT_EQ(found.edges.count, 12U);
  EXPECT_EQ(found.edges.minimum, 2);
  EXPECT_EQ(found.edges.mean, 3);
  EXPECT_EQ(found.edges.maximum, 4);
  EXPECT_EQ(found.shells.size(), 1U);
  EXPECT_EQ(found.quality.triangles, 12U);
  EXPECT_NEAR(found.quality.smallest_angle, std::atan2(2, 4), 1e-14);
  EXPECT_NEAR(found.quality.largest_angle, kPi / 2, 1e-14);
}

TEST(Measure, OfATetrahedron) {
  const MeshMeasure found = measure(tetrahedron());
  ASSERT_TRUE(found.all.solid);
  EXPECT_NEAR(found.all.solid->volume, 1.0 / 6, 1e-16);
  expect_near(found.all.solid->centroid, glm::dvec3(0.25), 1e-15);
  // ∫x² = 1/60, ∫xy = 1/120 about the origin; less V/16 about the centroid: 1/160 and −1/480.
  expect_near(found.all.solid->inertia,
              {{1.0 / 80, 1.0 / 480, 1.0 / 480}, {1.0 / 480, 1.0 / 80, 1.0 / 480}, {1.0 / 480, 1.0 / 480, 1.0 / 80}},
              1e-16);
  EXPECT_DOUBLE_EQ(found.all.area, 1.5 + std::sqrt(3.0) / 2);
  EXPECT_DOUBLE_EQ(found.quality.minimum, 2 * std::sqrt(3.0) / 4);  // of the right-angled ones
  EXPECT_EQ(found.quality.histogram[8], 3U);
  EXPECT_EQ(found.quality.histogram[9], 1U);
}

TEST(Measure, OfASphereAndATorusOfManyFaces) {
  // Facets of angle δ leave out about δ² of area and volume; moments two orders more of the radius.
  const MeshMeasure ball = measure(primitive({.kind = PrimitiveKind::IcoSphere, .radius = 2, .subdivisions = 5}));
  ASSERT_TRUE(ball.all.solid);
  const double volume = 4.0 / 3 * kPi * 8;
  EXPECT_NEAR(ball.all.area, 4 * kPi * 4, 4 * kPi * 4 * 1e-3);
  EXPECT_NEAR(ball.all.solid->volume, volume, volume * 2e-3);
  expect_near(ball.all.solid->inertia, glm::dmat3(0.4 * volume * 4), 0.4 * volume * 4 * 4e-3);
  EXPECT_GT(ball.quality.minimum, 0.8);

  constexpr double kR = 3;
  constexpr double kTube = 1;
  const MeshMeasure ring =
      measure(primitive({.kind = PrimitiveKind::Torus, .radius = 3, .tube_radius = 1, .segments = 400, .rings = 200}));
  ASSERT_TRUE(ring.all.solid);
  const double mass = 2 * kPi * kPi * kR * kTube * kTube;
  EXPECT_NEAR(ring.all.solid->volume, mass, mass * 5e-4);
  EXPECT_NEAR(ring.all.area, 4 * kPi * kPi * kR * kTube, 4 * kPi * kPi * kR * kTube * 3e-4);
  const double about_axis = mass * (kR * kR + 0.75 * kTube * kTube);
  const double about_diameter = mass * (0.5 * kR * kR + 0.625 * kTube * kTube);
  expect_near(ring.all.solid->moments, {about_diameter, about_diameter, about_axis}, about_axis * 1e-3);
  EXPECT_NEAR(std::abs(ring.all.solid->axes[2].y), 1, 1e-9);  // y is up
}

/// A solid without symmetry.
Mesh wedge() {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(0.5F, 1.5F);
  Mesh mesh = primitive({.kind = PrimitiveKind::IcoSphere, .subdivisions = 3});
  for (glm::vec3& p : mesh.positions) p *= place(random);
  return moved(mesh, {{3, 0.5, 0}, {0.25, 1, 0.25}, {0, 0.5, 2}}, {0.5, -1, 2});
}

TEST(Measure, FollowsLinearMaps) {
  const Mesh mesh = wedge();
  const MeshMeasure before = measure(mesh);
  const glm::dmat3 map{{1.5, 0.25, -0.5}, {0, 0.75, 1}, {0.5, -1, 2}};
  const MeshMeasure after = measure(moved(mesh, map, {3, 4, 5}));
  ASSERT_TRUE(before.all.solid && after.all.solid);
  const double scale = glm::determinant(map);
  // Positions are rounded to floats: 6·10⁻⁸ of coordinates up to 20.
  EXPECT_NEAR(after.all.solid->volume, before.all.solid->volume * scale, before.all.solid->volume * scale * 1e-6);
  expect_near(after.all.solid->centroid, map * before.all.solid->centroid + glm::dvec3(3, 4, 5), 1e-5);
  const auto spread = [](const glm::dmat3& inertia) {
    return glm::dmat3((inertia[0][0] + inertia[1][1] + inertia[2][2]) / 2) - inertia;
  };
  const glm::dmat3 expected = map * spread(before.all.solid->inertia) * glm::transpose(map) * scale;
  expect_near(spread(after.all.solid->inertia), expected, 1e-5 * (expected[0][0] + expected[1][1] + expected[2][2]));
}

TEST(Measure, TurnsWithTheBody) {
  const Mesh mesh = wedge();
  const glm::dmat3 turn(glm::rotate(glm::dmat4(1), 0.7, glm::dvec3(1, 2, 3)));
  const MeshMeasure before = measure(mesh);
  const MeshMeasure after = measure(moved(mesh, turn));
  const double size = before.all.solid->moments.z;
  expect_near(after.all.solid->moments, before.all.solid->moments, 1e-6 * size);
  expect_near(after.all.solid->inertia, turn * before.all.solid->inertia * glm::transpose(turn), 1e-6 * size);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(std::abs(glm::dot(after.all.solid->axes[i], turn * before.all.solid->axes[i])), 1, 1e-6);
    EXPECT_NEAR(glm::length(after.all.solid->inertia * after.all.solid->axes[i] -
                            after.all.solid->moments[static_cast<int>(i)] * after.all.solid->axes[i]),
                0, 1e-12 * size);
  }
  EXPECT_NEAR(after.all.area, before.all.area, 1e-6 * before.all.area);
  EXPECT_NEAR(after.oriented_box.volume(), before.oriented_box.volume(), 1e-6 * before.oriented_box.volume());
}

TEST(Measure, IsAsExactFarAwayAsNearby) {
  // Steps of 2⁻³ at a distance of 2²⁰: the moved positions are exact.
  const Mesh near = cuboid({2, 3, 4}, {-1, -1, -1});
  const MeshMeasure here = measure(near);
  const MeshMeasure far = measure(moved(near, glm::dmat3(1), {1048576, -524288, 262144}));
  EXPECT_EQ(far.all.solid->volume, here.all.solid->volume);
  EXPECT_EQ(far.all.solid->inertia, here.all.solid->inertia);
  EXPECT_EQ(far.all.solid->centroid, here.all.solid->centroid + glm::dvec3(1048576, -524288, 262144));
}

TEST(Measure, AddsShellsByTheParallelAxisTheorem) {
  Mesh two = tetrahedron();
  append(two, moved(tetrahedron(), glm::dmat3(2), {64, 0, 0}));
  const MeshMeasure found = measure(two);
  ASSERT_EQ(found.shells.size(), 2U);
  const SolidMeasure& a = *found.shells[0].solid;
  const SolidMeasure& b = *found.shells[1].solid;
  const SolidMeasure& all = *found.all.solid;
  EXPECT_NEAR(b.volume, 8 * a.volume, 1e-14);
  EXPECT_NEAR(all.volume, a.volume + b.volume, 1e-14);
  expect_near(all.centroid, (a.centroid * a.volume + b.centroid * b.volume) / all.volume, 1e-13);
  const glm::dvec3 apart = b.centroid - a.centroid;
  const double reduced = a.volume * b.volume / (a.volume + b.volume);
  const glm::dmat3 steiner = (glm::dmat3(glm::dot(apart, apart)) - glm::outerProduct(apart, apart)) * reduced;
  expect_near(all.inertia, a.inertia + b.inertia + steiner, 1e-10);
  EXPECT_EQ(found.all.faces, 8U);
}

TEST(Measure, CavitiesCountNegative) {
  Mesh hollow = tetrahedron();
  Mesh cavity = moved(tetrahedron(), glm::dmat3(0.25), glm::dvec3(0.125));
  for (std::size_t i = 0; i < cavity.corners.size(); i += 3) std::swap(cavity.corners[i], cavity.corners[i + 1]);
  append(hollow, cavity);
  const MeshMeasure found = measure(hollow);
  EXPECT_NEAR(found.shells[1].solid->volume, -1.0 / 6 / 64, 1e-16);
  EXPECT_NEAR(found.all.solid->volume, 1.0 / 6 - 1.0 / 6 / 64, 1e-16);
}

TEST(Measure, OpenSurfacesHaveNoVolumeAndSayWhy) {
  Mesh open = tetrahedron();
  open.corners.resize(9);
  const MeshMeasure found = measure(open);
  EXPECT_FALSE(found.all.solid);
  EXPECT_EQ(found.all.open, "3 edges have faces on one side only");
  EXPECT_DOUBLE_EQ(found.all.area, 1.5);
  Mesh turned = tetrahedron();
  std::swap(turned.corners[0], turned.corners[1]);
  EXPECT_EQ(measure(turned).all.open, "3 edges have two faces that are turned against each other");
  const Json json = report_of(measure(open)).json;
  EXPECT_TRUE(json["volume"].is_null());
  EXPECT_TRUE(json["inertia"].is_null());
  EXPECT_EQ(json["no_volume_because"].text(), "3 edges have faces on one side only");
  EXPECT_EQ(json["each_shell"].size(), 1U);
}

TEST(Measure, SeamsAreClosedByPosition) {
  const Mesh whole = tetrahedron();
  Mesh soup;
  for (const std::uint32_t corner : whole.corners) {
    soup.corners.push_back(static_cast<std::uint32_t>(soup.positions.size()));
    soup.positions.push_back(whole.positions[corner]);
  }
  EXPECT_EQ(measure(soup).shells.size(), 4U);
  EXPECT_FALSE(measure(soup).all.solid);
  const MeshMeasure found = measure(soup, {.by_position = true});
  ASSERT_TRUE(found.all.solid);
  EXPECT_NEAR(found.all.solid->volume, 1.0 / 6, 1e-16);
  EXPECT_EQ(found.shells.size(), 1U);
  EXPECT_EQ(found.edges.count, 6U);
}

TEST(Measure, OrientedBoxFindsTurnedBoxes) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int i = 0; i < 20; ++i) {
    const glm::dmat3 turn(
        glm::rotate(glm::dmat4(1), 3 * number(random), glm::dvec3(number(random), number(random), number(random) + 2)));
    const glm::dvec3 middle(5 * number(random), 5 * number(random), 5 * number(random));
    const OrientedBox box = measure(moved(cuboid({1, 2, 3}, {-0.5F, -1, -1.5F}), turn, middle)).oriented_box;
    EXPECT_NEAR(box.volume(), 6, 1e-5) << i;  // floats at 10: 10⁻⁶ of the size
    expect_near(box.center, middle, 1e-5);
    EXPECT_NEAR(glm::dot(glm::cross(box.axes[0], box.axes[1]), box.axes[2]), 1, 1e-12);
  }
}

TEST(Measure, OrientedBoxHoldsAllAndIsHardlyLargerThanOthers) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> number(0, 1);
    Mesh cloud;
    for (int i = 0; i < 50; ++i) cloud.positions.emplace_back(number(random), 2 * number(random), 3 * number(random));
    const OrientedBox box = measure(cloud).oriented_box;
    for (const glm::vec3& p : cloud.positions) {
      const glm::dvec3 from_center = glm::dvec3(p) - box.center;
      for (std::size_t a = 0; a < 3; ++a) {
        EXPECT_LE(std::abs(glm::dot(from_center, box.axes[a])), box.size[static_cast<int>(a)] / 2 + 1e-12) << seed;
      }
    }
    // Boxes at random; the smallest of all may have edges along edges of the hull only.
    for (int i = 0; i < 300; ++i) {
      const glm::dmat3 turn(glm::rotate(glm::dmat4(1), static_cast<double>(number(random)),
                                        glm::dvec3(number(random), number(random), number(random))));
      const glm::dvec3 size(bounds(moved(cloud, turn)).size());
      EXPECT_LE(box.volume(), size.x * size.y * size.z * 1.02) << seed;
    }
  }
}

TEST(Measure, FlatThingsHaveFlatBoxes) {
  Mesh flat;
  flat.positions = {{0, 0, 0}, {3, 3, 0}, {2, 4, 0}, {-1, 1, 0}};  // a turned rectangle, 3√2 by √2
  flat.corners = {0, 1, 2, 3};
  flat.face_offsets = {0, 4};
  const OrientedBox box = measure(flat).oriented_box;
  EXPECT_NEAR(box.size.x + box.size.y + box.size.z, 4 * std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(box.volume(), 0, 1e-12);
  Mesh line;
  line.positions = {{1, 1, 1}, {3, 3, 3}, {2, 2, 2}};
  const OrientedBox of_line = measure(line).oriented_box;
  EXPECT_NEAR(of_line.size.x + of_line.size.y + of_line.size.z, 2 * std::sqrt(3.0), 1e-6);
  expect_near(of_line.center, {2, 2, 2}, 1e-6);
}

TEST(Measure, TakesAnything) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(measure(Mesh()).all.open, "there are no faces");
  Mesh cloud;
  cloud.positions = {{0, 0, 0}, {1, 2, 3}, {nan, 0, 0}};
  EXPECT_EQ(measure(cloud).all.box, (Box3{{0, 0, 0}, {1, 2, 3}}));
  Mesh broken = tetrahedron();
  broken.positions[3].x = nan;
  std::vector<std::string> warnings;
  azulejo::Run run;
  run.warn = [&](const std::string& message) { warnings.push_back(message); };
  const MeshMeasure found = measure(broken, {}, run);
  EXPECT_EQ(warnings, std::vector<std::string>{"measure: 3 triangles are not finite and left out"});
  EXPECT_EQ(found.all.open, "3 triangles are not finite");
  EXPECT_DOUBLE_EQ(found.all.area, 0.5);
  Mesh degenerate = tetrahedron();
  degenerate.corners.insert(degenerate.corners.end(), {0, 0, 0, 1, 1, 2});
  EXPECT_NEAR(measure(degenerate).all.solid->volume, 1.0 / 6, 1e-16);
  EXPECT_EQ(measure(degenerate).quality.without_area, 2U);
}

TEST(Measure, IsTheSameForAnyNumberOfThreads) {
  Mesh mesh = primitive({
      .kind = PrimitiveKind::Teapot,
  });
  const std::string one = report_of(measure(mesh, {}, {.threads = 1})).json.dump();
  EXPECT_EQ(report_of(measure(mesh, {}, {.threads = 4})).json.dump(), one);
}

}  // namespace
}  // namespace azulejo
