#include "azulejo/modelling/repair.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "azulejo/engine/operation.h"
#include "azulejo/io/model_testing.h"
#include "azulejo/modelling/primitive.h"
#include "azulejo/modelling/topology.h"

namespace azulejo {

extern const Operation kRepair;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Without some faces; triangles only.
Mesh without(const Mesh& mesh, const std::function<bool(std::size_t)>& goes) {
  Mesh left;
  left.positions = mesh.positions;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    if (goes(f)) continue;
    for (std::size_t i = 0; i < 3; ++i) left.corners.push_back(mesh.corners[3 * f + i]);
  }
  return left;
}

/// Every face with vertices of its own.
Mesh soup(const Mesh& mesh) {
  Mesh apart;
  for (const std::uint32_t v : mesh.corners) {
    apart.corners.push_back(static_cast<std::uint32_t>(apart.positions.size()));
    apart.positions.push_back(mesh.positions[v]);
  }
  apart.face_offsets = mesh.face_offsets;
  return apart;
}

/// A torus of triangles.
Mesh torus() {
  const Mesh quads = primitive({.kind = PrimitiveKind::Torus, .segments = 24, .rings = 12});
  Mesh mesh;
  mesh.positions = quads.positions;
  for (std::size_t f = 0; f < quads.face_count(); ++f) {
    const std::uint32_t* const v = &quads.corners[4 * f];
    for (const std::uint32_t each : {v[0], v[1], v[2], v[0], v[2], v[3]}) mesh.corners.push_back(each);
  }
  return mesh;
}

Mesh ball(int subdivisions = 4) {
  Mesh mesh = primitive({.kind = PrimitiveKind::IcoSphere, .subdivisions = subdivisions});
  mesh.attributes.clear();
  return mesh;
}

double volume(const Topology& topology) {
  double sum = 0;
  for (const MeshShell& each : topology.shells) sum += each.volume;
  return sum;
}

void expect_solid(const RepairedMesh& repaired, std::size_t genus) {
  repaired.mesh.check("repaired");
  EXPECT_TRUE(repaired.solid);
  const Topology found = topology(repaired.mesh);
  EXPECT_TRUE(found.printable());
  EXPECT_EQ(found.genus(), genus);
  const RepairedMesh again = repair(repaired.mesh);
  EXPECT_FALSE(again.changed);
  EXPECT_TRUE(same_mesh(again.mesh, repaired.mesh));
}

TEST(Repair, LeavesSolidsByteForByte) {
  for (const PrimitiveKind kind :
       {PrimitiveKind::Cube, PrimitiveKind::Torus, PrimitiveKind::UvSphere, PrimitiveKind::Dodecahedron,
        PrimitiveKind::Cylinder, PrimitiveKind::Cone, PrimitiveKind::TorusKnot, PrimitiveKind::Capsule}) {
    const Mesh mesh = primitive({.kind = kind});
    const RepairedMesh repaired = repair(mesh);
    EXPECT_TRUE(same_mesh(mesh, repaired.mesh)) << static_cast<int>(kind);
    EXPECT_FALSE(repaired.changed);
    EXPECT_TRUE(repaired.solid);
  }
}

TEST(Repair, GivesABallItsVolumeBack) {
  const Mesh whole = ball();
  const double full = volume(topology(whole));
  // Caps of a tenth and a quarter of the height: 3 % and 16 % of the volume.
  for (const auto& [height, tolerance] : {std::pair(0.8F, 0.005), std::pair(0.5F, 0.045)}) {
    const Mesh cut =
        without(whole, [&, h = height](std::size_t f) { return whole.positions[whole.corners[3 * f]].y > h; });
    const RepairedMesh repaired = repair(cut);
    expect_solid(repaired, 0);
    EXPECT_EQ(repaired.count(RepairAction::FilledHole), 1U);
    EXPECT_EQ(repaired.count(RepairAction::IntersectingFace), 0U);
    EXPECT_NEAR(volume(topology(repaired.mesh)), full, tolerance * full) << height;
  }
}

TEST(Repair, ClosesABoxFlat) {
  Mesh box = primitive({.kind = PrimitiveKind::Cube, .size = 2});
  box.attributes.clear();
  box.corners.resize(box.corners.size() - 4);
  box.face_offsets.pop_back();
  const RepairedMesh repaired = repair(box);
  expect_solid(repaired, 0);
  EXPECT_NEAR(volume(topology(repaired.mesh)), 8, 1e-6);
  EXPECT_EQ(repaired.added_faces, 2U);
}

TEST(Repair, ClosesRandomHolesWithTheGenusThatWasThere) {
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U}) {
    std::mt19937 random(seed);
    const Mesh whole = torus();
    const unsigned one_of = 4 + 8 * seed;
    // Pieces without their surroundings would become shells: those are few faces, left out of the count.
    const Mesh holed = without(whole, [&](std::size_t) { return random() % one_of == 0; });
    const RepairedMesh repaired = repair(holed, {.fair = seed % 2 == 0});
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    expect_solid(repaired, 1);
    EXPECT_EQ(topology(repaired.mesh).shells.size(), 1U);
    EXPECT_NEAR(volume(topology(repaired.mesh)), volume(topology(whole)), 0.05 * volume(topology(whole)));
  }
}

TEST(Repair, OrientsAFlippedSoup) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    std::mt19937 random(seed);
    const Mesh whole = torus();
    Mesh flipped = soup(whole);
    for (std::size_t f = 0; f < flipped.face_count(); ++f) {
      if (random() % 2 == 0) std::swap(flipped.corners[3 * f + 1], flipped.corners[3 * f + 2]);
    }
    const RepairedMesh repaired = repair(flipped);
    expect_solid(repaired, 1);
    EXPECT_NEAR(volume(topology(repaired.mesh)), volume(topology(whole)), 1e-9);
    EXPECT_EQ(repaired.mesh.vertex_count(), whole.vertex_count());
  }
}

/// Boxes with vertices of their own, from one corner to another; turned: inside out.
void add_box(Mesh& mesh, const glm::vec3& lower, const glm::vec3& upper, bool turned = false) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (int i = 0; i < 8; ++i) {
    mesh.positions.emplace_back((i & 1) != 0 ? upper.x : lower.x, (i & 2) != 0 ? upper.y : lower.y,
                                (i & 4) != 0 ? upper.z : lower.z);
  }
  if (mesh.face_offsets.empty()) mesh.face_offsets = {0};
  const std::uint32_t kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                      {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& face : kFaces) {
    for (int i = 0; i < 4; ++i) mesh.corners.push_back(first + face[turned ? 3 - i : i]);
    mesh.face_offsets.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  }
}

TEST(Repair, TurnsWhatIsInsideOutAndLeavesCavities) {
  Mesh mesh;
  add_box(mesh, {0, 0, 0}, {4, 4, 4}, true);  // inside out
  add_box(mesh, {1, 1, 1}, {3, 3, 3}, true);  // a cavity
  add_box(mesh, {1.5F, 1.5F, 1.5F}, {2, 2, 2});
  add_box(mesh, {9, 9, 9}, {10, 10, 10}, true);  // beside
  const RepairedMesh repaired = repair(mesh);
  expect_solid(repaired, 0);
  EXPECT_EQ(repaired.count(RepairAction::TurnedShell), 2U);
  EXPECT_NEAR(volume(topology(repaired.mesh)), 64 - 8 + 0.125 + 1, 1e-9);
  const RepairedMesh full = repair(mesh, {.remove_inside = true});
  EXPECT_EQ(full.count(RepairAction::InsideShell), 2U);
  EXPECT_NEAR(volume(topology(full.mesh)), 64 + 1, 1e-9);
}

TEST(Repair, MakesCavitiesOfNestedShellsThatDisagreed) {
  Mesh mesh;
  add_box(mesh, {0, 0, 0}, {4, 4, 4});
  add_box(mesh, {1, 1, 1}, {3, 3, 3});
  for (const std::size_t face : {2U, 8U}) {
    std::reverse(mesh.corners.begin() + static_cast<std::ptrdiff_t>(4 * face),
                 mesh.corners.begin() + static_cast<std::ptrdiff_t>(4 * face + 4));
  }
  const RepairedMesh repaired = repair(mesh);
  expect_solid(repaired, 0);
  EXPECT_EQ(repaired.count(RepairAction::TurnedFace), 2U);
  EXPECT_NEAR(volume(topology(repaired.mesh)), 64 - 8, 1e-9);
}

TEST(Repair, PartsBoxesThatTouch) {
  // Along an edge, at a corner, and with a wall between, which goes.
  const struct {
    glm::vec3 at;
    std::size_t shells;
  } kCases[] = {{{1, 1, 0}, 2}, {{1, 1, 1}, 2}, {{1, 0, 0}, 1}};
  for (const auto& each : kCases) {
    Mesh mesh;
    add_box(mesh, {0, 0, 0}, {1, 1, 1});
    add_box(mesh, each.at, each.at + 1.0F);
    // Welded, so that they hang together.
    Mesh welded;
    welded.face_offsets = mesh.face_offsets;
    for (const std::uint32_t v : mesh.corners) {
      const auto found = std::find(welded.positions.begin(), welded.positions.end(), mesh.positions[v]);
      welded.corners.push_back(static_cast<std::uint32_t>(found - welded.positions.begin()));
      if (found == welded.positions.end()) welded.positions.push_back(mesh.positions[v]);
    }
    EXPECT_FALSE(topology(welded).manifold());
    const RepairedMesh repaired = repair(welded);
    expect_solid(repaired, 0);
    EXPECT_EQ(topology(repaired.mesh).shells.size(), each.shells);
    EXPECT_NEAR(volume(topology(repaired.mesh)), 2, 1e-9);
  }
}

TEST(Repair, DropsFinsAndWallsOfOneSheet) {
  Mesh mesh;
  add_box(mesh, {0, 0, 0}, {1, 1, 1});
  add_box(mesh, {1, 0, 0}, {2, 1, 1});
  // One wall instead of two between the boxes, and a fin beyond an edge.
  const auto shared = [&](std::uint32_t v) { return mesh.positions[v].x == 1.0F; };
  Mesh walled = soup(mesh);
  for (std::size_t f = 0; f < 12; ++f) {
    const bool is_wall = std::all_of(mesh.corners.begin() + static_cast<std::ptrdiff_t>(4 * f),
                                     mesh.corners.begin() + static_cast<std::ptrdiff_t>(4 * f + 4), shared);
    if (!is_wall || f < 6) continue;
    for (std::size_t i = 0; i < 4; ++i) walled.corners[4 * f + i] = walled.corners[4 * f];
  }
  const auto first = static_cast<std::uint32_t>(walled.positions.size());
  for (const glm::vec3& p : {glm::vec3(0, 0, 0), glm::vec3(0, 0, 1), glm::vec3(-1, -1, 0)})
    walled.positions.push_back(p);
  for (const std::uint32_t i : {0U, 1U, 2U}) walled.corners.push_back(first + i);
  walled.face_offsets.push_back(static_cast<std::uint32_t>(walled.corners.size()));
  const RepairedMesh repaired = repair(walled);
  expect_solid(repaired, 0);
  EXPECT_NEAR(volume(topology(repaired.mesh)), 2, 1e-9);
  EXPECT_GE(repaired.count(RepairAction::Sheet), 1U);
}

TEST(Repair, RemovesFlatFaces) {
  // A cube with a vertex on an edge that only one side knows, and a flat triangle between.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}, {1, 0, 0}};
  mesh.corners = {0, 3, 2, 0, 2, 1, 4, 5, 6, 4, 6, 7, 0, 8, 4, 8, 1, 5, 8, 5, 4,
                  3, 7, 6, 3, 6, 2, 0, 4, 7, 0, 7, 3, 1, 2, 6, 1, 6, 5, 0, 1, 8};
  EXPECT_EQ(topology(mesh).count(MeshFaultKind::FlatFace), 1U);
  const RepairedMesh flat = repair(mesh);
  expect_solid(flat, 0);
  EXPECT_EQ(flat.count(RepairAction::FlatFace), 1U);
  EXPECT_NEAR(volume(topology(flat.mesh)), 8, 1e-9);
  // The same without that triangle: a hole without an area.
  mesh.corners.resize(mesh.corners.size() - 3);
  const RepairedMesh holed = repair(mesh);
  expect_solid(holed, 0);
  EXPECT_NEAR(volume(topology(holed.mesh)), 8, 1e-9);
}

TEST(Repair, DropsWhatIsNoFace) {
  Mesh mesh = soup(ball(2));
  const std::size_t faces = mesh.face_count();
  mesh.positions.emplace_back(kNan, 0, 0);
  mesh.positions.emplace_back(5, 5, 5);
  const auto last = static_cast<std::uint32_t>(mesh.positions.size() - 2);
  for (const std::uint32_t v : {0U, 1U, last, 3U, 3U, 4U, 6U, 7U, 8U}) mesh.corners.push_back(v);
  const RepairedMesh repaired = repair(mesh);
  expect_solid(repaired, 0);
  EXPECT_EQ(repaired.mesh.face_count(), faces);
  EXPECT_EQ(repaired.count(RepairAction::NotFiniteFace), 1U);
  EXPECT_EQ(repaired.count(RepairAction::DegenerateFace), 1U);
  EXPECT_EQ(repaired.count(RepairAction::DuplicateFace), 1U);
  EXPECT_EQ(repaired.count(RepairAction::UnusedVertex), 5U);  // those that only dropped faces had, too
}

TEST(Repair, LeavesWhatIsNoSolid) {
  Mesh one;
  one.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  one.corners = {0, 1, 2};
  const RepairedMesh triangle = repair(one);
  EXPECT_FALSE(triangle.solid);
  EXPECT_TRUE(same_mesh(triangle.mesh, one));
  EXPECT_EQ(triangle.count(RepairAction::OpenHole), 1U);
  Mesh cloud;
  cloud.positions = {{0, 0, 0}, {0, 0, 0}, {kNan, 0, 0}};
  EXPECT_TRUE(same_mesh(repair(cloud).mesh, cloud));
  cloud.lines = {0, 1, 1, 2};
  EXPECT_TRUE(same_mesh(repair(cloud).mesh, cloud));
  EXPECT_FALSE(repair(Mesh()).solid);
}

TEST(Repair, CutsOneSidedSurfaces) {
  for (const PrimitiveKind kind : {PrimitiveKind::Mobius, PrimitiveKind::KleinBottle}) {
    const RepairedMesh repaired = repair(primitive({.kind = kind}));
    EXPECT_TRUE(repaired.solid);
    EXPECT_TRUE(topology(repaired.mesh).printable());
    EXPECT_FALSE(repair(repaired.mesh).changed);
  }
}

TEST(Repair, StepsCanBeLeftOut) {
  const Mesh whole = ball(3);
  const Mesh holed = without(whole, [&](std::size_t f) {
    const std::uint32_t* const v = &whole.corners[3 * f];
    return std::find(v, v + 3, 0U) != v + 3 || f == 1000;
  });
  EXPECT_FALSE(repair(holed, {.fill = false}).solid);
  const RepairedMesh small = repair(holed, {.max_hole_edges = 3});
  EXPECT_EQ(small.count(RepairAction::FilledHole), 1U);
  EXPECT_GE(small.count(RepairAction::OpenHole), 1U);
  RepairOptions none;
  none.weld_borders = none.drop = none.orient = none.split = none.fill = none.flat = false;
  EXPECT_TRUE(same_mesh(repair(holed, none).mesh, holed));
  EXPECT_THROW(repair(holed, {.tolerance = -1}), Error);
  EXPECT_THROW(repair(holed, {.max_hole_edges = -1}), Error);
}

TEST(Repair, PatchesHaveAttributes) {
  Mesh mesh = primitive({.kind = PrimitiveKind::IcoSphere, .subdivisions = 4});
  mesh.material.assign(mesh.face_count(), 7);
  Array<float> places(3 * mesh.vertex_count());
  for (std::size_t i = 0; i < places.size(); ++i) places[i] = mesh.positions[i / 3][static_cast<int>(i % 3)];
  mesh.attributes.push_back({"PLACE", Domain::Vertex, 3, places});
  mesh.attributes.push_back({"MARK", Domain::Face, 1, Array<std::uint32_t>(mesh.face_count(), 9)});
  Mesh cut = mesh.clone();
  // The last faces are around the last of the twenty corners.
  const std::size_t left = mesh.face_count() - 256;
  cut.corners.resize(3 * left);
  cut.material.resize(left);
  for (Attribute& each : cut.attributes) {
    if (each.domain == Domain::Vertex) continue;
    const std::size_t size =
        static_cast<std::size_t>(each.components) * (each.domain == Domain::Face ? left : 3 * left);
    std::visit([&](auto& values) { values.resize(size); }, each.values);
  }
  const RepairedMesh repaired = repair(cut);
  expect_solid(repaired, 0);
  ASSERT_GT(repaired.added_vertices, 50U);
  EXPECT_EQ(repaired.mesh.material.back(), 7U);
  EXPECT_EQ(values_of<std::uint32_t>(repaired.mesh, "MARK").back(), 9U);
  const std::vector<float> mixed = values_of<float>(repaired.mesh, "PLACE");
  const std::vector<float> normals = values_of<float>(repaired.mesh, "NORMAL");
  for (std::size_t v = repaired.mesh.vertex_count() - repaired.added_vertices; v < repaired.mesh.vertex_count(); ++v) {
    const glm::vec3 here = repaired.mesh.positions[v];
    EXPECT_LT(glm::distance(here, glm::vec3(mixed[3 * v], mixed[3 * v + 1], mixed[3 * v + 2])), 0.3F);
    EXPECT_GT(glm::dot(glm::normalize(here), glm::vec3(normals[3 * v], normals[3 * v + 1], normals[3 * v + 2])), 0.95F);
  }
}

TEST(Repair, AnySoupWithAnyThreads) {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Mesh mesh = random_mesh(8 + 3 * seed, 40 * (1 + seed % 4), seed % 2 == 0, seed);
    if (seed % 3 == 0) {
      for (glm::vec3& p : mesh.positions) p = glm::round(p / 5.0F);  // many at one place, on lines
    }
    if (seed % 5 == 0) mesh.positions[0].x = kNan;
    mesh.attributes.push_back(random_attribute<float>(mesh, "U", Domain::Corner, 2, seed));
    mesh.attributes.push_back(random_attribute<std::uint8_t>(mesh, "C", Domain::Vertex, 4, seed));
    mesh.attributes.push_back(random_attribute<std::uint32_t>(mesh, "F", Domain::Face, 1, seed));
    mesh.lines = {0, 1, 2, 3};
    azulejo::Run one;
    one.threads = 1;
    const RepairedMesh repaired = repair(mesh, {}, one);
    repaired.mesh.check("repaired");
    azulejo::Run three;
    three.threads = 3;
    EXPECT_TRUE(same_mesh(repaired.mesh, repair(mesh, {}, three).mesh));
    if (!repaired.solid) continue;
    EXPECT_TRUE(topology(repaired.mesh).closed());
    EXPECT_TRUE(topology(repaired.mesh).oriented());
    EXPECT_EQ(topology(repaired.mesh).count(MeshFaultKind::FlatFace), 0U);
    EXPECT_TRUE(same_mesh(repair(repaired.mesh).mesh, repaired.mesh));
  }
}

TEST(Repair, ManyFacesAtOneEdgeAndHugeHoles) {
  Mesh star;
  star.positions = {{0, 0, 0}, {0, 0, 1}};
  for (std::uint32_t i = 0; i < 3'000; ++i) {
    star.positions.emplace_back(std::cos(0.1F * static_cast<float>(i)), std::sin(0.1F * static_cast<float>(i)), 0.5F);
    for (const std::uint32_t v : {0U, 1U, 2 + i}) star.corners.push_back(v);
  }
  repair(star).mesh.check("star");
  // A cone without a bottom, and a crown whose rim goes up and down.
  for (const float zigzag : {0.0F, 0.3F}) {
    Mesh cone;
    cone.positions = {{0, 0, 5}};
    const std::uint32_t n = 3'000;
    for (std::uint32_t i = 0; i < n; ++i) {
      const double angle = 2 * 3.14159265358979 * i / n;
      cone.positions.emplace_back(std::cos(angle), std::sin(angle), i % 2 == 0 ? zigzag : 0.0F);
      for (const std::uint32_t v : {0U, 1 + i, 1 + (i + 1) % n}) cone.corners.push_back(v);
    }
    const RepairedMesh repaired = repair(cone);
    expect_solid(repaired, 0);
    EXPECT_LE(repaired.added_vertices, 50'000U);
  }
}

TEST(Repair, SaysThatThereIsNoSolid) {
  std::vector<std::string> warnings;
  azulejo::Run run;
  run.warn = [&](const std::string& message) { warnings.push_back(message); };
  const auto options = kRepair.make_options();
  const Value nothing{Mesh()};
  EXPECT_FALSE(invoke(kRepair, options.get(), std::span(&nothing, 1), run)[1].report()->verdict);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("there is no solid"), std::string::npos) << warnings[0];
}

}  // namespace
}  // namespace azulejo
