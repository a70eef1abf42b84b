#include "azulejo/modelling/topology.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "azulejo/modelling/primitive.h"
#include "azulejo/modelling/self_intersections.h"

namespace azulejo {
namespace {

Mesh made(PrimitiveKind kind) {
  PrimitiveOptions options;
  options.kind = kind;
  return primitive(options);
}

/// Boxes of unit size at whole places, vertices at one place shared.
Mesh boxes(const std::vector<glm::ivec3>& corners) {
  Mesh mesh;
  mesh.face_offsets = {0};
  for (const glm::ivec3& corner : corners) {
    std::uint32_t index[8];
    for (int i = 0; i < 8; ++i) {
      const glm::vec3 at(corner + glm::ivec3(i & 1, i >> 1 & 1, i >> 2 & 1));
      const auto found = std::find(mesh.positions.begin(), mesh.positions.end(), at);
      index[i] = static_cast<std::uint32_t>(found - mesh.positions.begin());
      if (found == mesh.positions.end()) mesh.positions.push_back(at);
    }
    int count = 0;
    for (const int i : {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5}) {
      mesh.corners.push_back(index[i]);
      if (++count % 4 == 0) mesh.face_offsets.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
    }
  }
  return mesh;
}

/// A grid of u × v squares that is rolled up: along u, and along v, with or without half a twist where it closes.
Mesh rolled(int u, int v, bool close_u, bool close_v, bool twist_v) {
  Mesh mesh;
  const int across = close_u ? u : u + 1;
  const int along = close_v ? v : v + 1;
  std::mt19937 random(1);
  for (int i = 0; i < across * along; ++i) {
    mesh.positions.emplace_back(random() % 1000, random() % 1000, random() % 1000);
  }
  const auto vertex = [&](int i, int j) {
    if (close_v && j == v) {
      j = 0;
      if (twist_v) i = u - i;
    }
    if (close_u) i = (i + u) % u;
    return static_cast<std::uint32_t>(j * across + i);
  };
  mesh.face_offsets = {0};
  for (int j = 0; j < v; ++j) {
    for (int i = 0; i < u; ++i) {
      for (const auto corner : {vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)}) {
        mesh.corners.push_back(corner);
      }
      mesh.face_offsets.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
    }
  }
  return mesh;
}

TEST(Topology, CountsSolids) {
  const struct {
    PrimitiveKind kind;
    long euler;
    std::size_t genus;
  } kCases[] = {{PrimitiveKind::Cube, 2, 0},         {PrimitiveKind::Tetrahedron, 2, 0},
                {PrimitiveKind::Dodecahedron, 2, 0}, {PrimitiveKind::UvSphere, 2, 0},
                {PrimitiveKind::IcoSphere, 2, 0},    {PrimitiveKind::Cylinder, 2, 0},
                {PrimitiveKind::Cone, 2, 0},         {PrimitiveKind::Torus, 0, 1}};
  for (const auto& each : kCases) {
    const Topology found = topology(made(each.kind));
    SCOPED_TRACE(static_cast<int>(each.kind));
    EXPECT_EQ(found.euler(), each.euler);
    EXPECT_EQ(found.genus(), each.genus);
    EXPECT_EQ(found.euler_poincare(), 0);
    EXPECT_EQ(found.shells.size(), 1U);
    EXPECT_TRUE(found.printable());
    EXPECT_GT(found.shells[0].volume, 0);
    EXPECT_EQ(found.regular_edges, found.edges);
    EXPECT_EQ(found.regular_vertices, found.vertices);
    EXPECT_EQ(found.euler_preconditions().empty(), each.genus == 0);
  }
  EXPECT_NEAR(topology(made(PrimitiveKind::Cube)).shells[0].volume, 8, 1e-6);
  EXPECT_NEAR(topology(made(PrimitiveKind::Cube)).shells[0].area, 24, 1e-6);
}

TEST(Topology, CountsHandlesOfRolledGrids) {
  const Topology torus = topology(rolled(7, 5, true, true, false));
  EXPECT_EQ(torus.genus(), 1U);
  EXPECT_TRUE(torus.closed() && torus.oriented());
  const Topology tube = topology(rolled(7, 5, true, false, false));
  EXPECT_EQ(tube.genus(), 0U);
  EXPECT_EQ(tube.holes.size(), 2U);
  EXPECT_EQ(tube.euler_poincare(), 0);
  const Topology sheet = topology(rolled(7, 5, false, false, false));
  EXPECT_EQ(sheet.holes.size(), 1U);
  EXPECT_EQ(sheet.holes[0].edges, 24U);
  EXPECT_EQ(sheet.euler(), 1);
  EXPECT_EQ(sheet.euler_poincare(), 0);
  const Topology strip = topology(rolled(3, 9, false, true, true));  // Möbius
  EXPECT_FALSE(strip.oriented());
  EXPECT_FALSE(strip.shells[0].orientable);
  EXPECT_EQ(strip.shells[0].genus, 1U) << "one cross-cap";
  EXPECT_EQ(strip.holes.size(), 1U);
  const Topology bottle = topology(rolled(6, 9, true, true, true));  // Klein
  EXPECT_TRUE(bottle.closed());
  EXPECT_FALSE(bottle.shells[0].orientable);
  EXPECT_EQ(bottle.shells[0].genus, 2U) << "two cross-caps";
  EXPECT_EQ(bottle.euler(), 0);
}

TEST(Topology, TakesTwoCubesThatShareAVertexForNoManifold) {
  const Topology at_vertex = topology(boxes({{0, 0, 0}, {1, 1, 1}}));
  EXPECT_EQ(at_vertex.count(MeshFaultKind::SingularVertex), 1U);
  EXPECT_EQ(at_vertex.of(MeshFaultKind::SingularVertex).listed[0].place, glm::vec3(1));
  EXPECT_EQ(at_vertex.euler(), 3);
  EXPECT_EQ(at_vertex.shells.size(), 2U);
  EXPECT_EQ(at_vertex.components, 1U);
  EXPECT_FALSE(at_vertex.manifold());
  EXPECT_FALSE(at_vertex.euler_poincare().has_value());
  const Topology at_edge = topology(boxes({{0, 0, 0}, {1, 1, 0}}));
  EXPECT_EQ(at_edge.count(MeshFaultKind::SingularEdge), 1U);
  EXPECT_EQ(at_edge.of(MeshFaultKind::SingularEdge).listed[0].place, glm::vec3(1, 1, 0.5F));
  EXPECT_EQ(at_edge.count(MeshFaultKind::SingularVertex), 0U) << "said by its edge";
  EXPECT_EQ(at_edge.regular_vertices, at_edge.vertices - 2);
  const Topology apart = topology(boxes({{0, 0, 0}, {3, 0, 0}}));
  EXPECT_EQ(apart.euler(), 4);
  EXPECT_EQ(apart.euler_poincare(), 0);
  EXPECT_TRUE(apart.printable());
  EXPECT_EQ(apart.components, 2U);
}

TEST(Topology, FindsEachFault) {
  Mesh mesh = boxes({{0, 0, 0}});
  // An open box with a turned face, the opposite one twice, a face without area, two that are no faces.
  std::swap(mesh.corners[9], mesh.corners[11]);
  mesh.corners.resize(20);
  for (const std::uint32_t corner : {3, 1, 0, 2, 0, 1, 0, 1, 2, 2, 8, 9, 10}) mesh.corners.push_back(corner);
  mesh.face_offsets = {0, 4, 8, 12, 16, 20, 24, 27, 30, 33};
  for (const float x : {0.0F, 1.0F, 2.0F}) mesh.positions.emplace_back(5 + x, 5 + 2 * x, 5 + 3 * x);
  mesh.positions.emplace_back(0, 0, 0);
  mesh.positions.emplace_back(std::numeric_limits<float>::quiet_NaN(), 0, 0);
  mesh.lines = {7, 3};
  const Topology found = topology(mesh);
  EXPECT_EQ(found.count(MeshFaultKind::DegenerateFace), 2U);
  EXPECT_EQ(found.of(MeshFaultKind::DegenerateFace).listed[0].index, 6U);
  EXPECT_EQ(found.count(MeshFaultKind::FlatFace), 1U);
  EXPECT_EQ(found.of(MeshFaultKind::FlatFace).listed[0].index, 8U);
  EXPECT_EQ(found.count(MeshFaultKind::DuplicateFace), 1U);
  EXPECT_EQ(found.of(MeshFaultKind::DuplicateFace).listed[0].index, 5U);
  EXPECT_EQ(found.of(MeshFaultKind::DuplicateFace).listed[0].other, 0U);
  EXPECT_EQ(found.count(MeshFaultKind::TurnedEdge), 3U);  // two of the turned face, one of those that are equal
  EXPECT_EQ(found.count(MeshFaultKind::UnusedVertex), 2U);
  EXPECT_EQ(found.count(MeshFaultKind::DoubledVertex), 1U);
  EXPECT_EQ(found.of(MeshFaultKind::DoubledVertex).listed[0].other, 0U);
  EXPECT_EQ(found.count(MeshFaultKind::NotFiniteVertex), 1U);
  EXPECT_EQ(found.count(MeshFaultKind::LooseEdge), 1U);
  EXPECT_EQ(found.of(MeshFaultKind::LooseEdge).listed[0].index, 3U);
  EXPECT_FALSE(found.printable());
  const Report report = report_of(found);
  EXPECT_FALSE(report.verdict);
  EXPECT_EQ(report.json["duplicate_faces"].number(), 1);
  EXPECT_EQ(report.json["elements"]["duplicate_faces"][0]["first_face"].number(-1), 0);
  EXPECT_TRUE(report.json["intersecting_faces"].is_null());
}

TEST(Topology, FindsDuplicatesAlongCrowdedEdges) {
  // A book: all pages at one edge, and each a second time, turned over.
  constexpr std::uint32_t kPages = 50000;
  Mesh mesh;
  for (std::uint32_t v = 0; v < kPages + 2; ++v) {
    mesh.positions.emplace_back(static_cast<float>(v % 7), static_cast<float>(v / 7), static_cast<float>(v % 11));
  }
  for (std::uint32_t page = 2; page < kPages + 2; ++page) mesh.corners.insert(mesh.corners.end(), {0, 1, page});
  for (std::uint32_t page = 2; page < kPages + 2; ++page) mesh.corners.insert(mesh.corners.end(), {page, 1, 0});
  const Topology book = topology(mesh, {.listed = 1000000});
  EXPECT_EQ(book.count(MeshFaultKind::SingularEdge), 1U);
  ASSERT_EQ(book.count(MeshFaultKind::DuplicateFace), kPages);
  for (const MeshFault& each : book.of(MeshFaultKind::DuplicateFace).listed) EXPECT_EQ(each.index, each.other + kPages);

  // Few vertices and many faces: every edge has hundreds. Beside the first of each set of vertices, found by a map.
  std::mt19937 random(7);
  mesh.corners.clear();
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> first;
  std::vector<std::array<std::uint32_t, 2>> expected;
  for (std::uint32_t f = 0; f < 20000; ++f) {
    std::array<std::uint32_t, 3> face{};
    for (std::uint32_t& v : face) v = static_cast<std::uint32_t>(random() % 30);
    mesh.corners.insert(mesh.corners.end(), face.begin(), face.end());
    std::sort(face.begin(), face.end());
    if (face[0] == face[1] || face[1] == face[2]) continue;
    const auto [same, added] = first.emplace(face, f);
    if (!added) expected.push_back({f, same->second});
  }
  const Topology soup = topology(mesh, {.listed = 1000000});
  const std::vector<MeshFault>& found = soup.of(MeshFaultKind::DuplicateFace).listed;
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].index, expected[i][0]);
    EXPECT_EQ(found[i].other, expected[i][1]);
  }
}

TEST(Topology, NamesTheFirstOfWeldedVertices) {
  // A square of two triangles with vertices of their own, behind a vertex that nothing uses.
  Mesh mesh;
  for (const glm::vec2& p : {glm::vec2(9, 9), {0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}}) {
    mesh.positions.emplace_back(p, 0);
  }
  mesh.corners = {1, 2, 3, 4, 5, 6};
  const Topology found = topology(mesh, {.by_position = true});
  ASSERT_EQ(found.count(MeshFaultKind::BorderEdge), 4U);
  for (const MeshFault& each : found.of(MeshFaultKind::BorderEdge).listed) {
    EXPECT_EQ(0.5F * (mesh.positions[each.index] + mesh.positions[each.other]), each.place);
    EXPECT_NE(each.index, 4U);
    EXPECT_NE(each.other, 5U);
  }
  ASSERT_EQ(found.holes.size(), 1U);
  EXPECT_EQ(found.holes[0].vertex, 1U);
}

TEST(Topology, InsideOutIsNotPrintable) {
  Mesh mesh = boxes({{0, 0, 0}});
  for (std::size_t f = 0; f < 6; ++f) {
    std::reverse(mesh.corners.begin() + static_cast<std::ptrdiff_t>(4 * f),
                 mesh.corners.begin() + static_cast<std::ptrdiff_t>(4 * f + 4));
  }
  const Topology found = topology(mesh);
  EXPECT_TRUE(found.closed() && found.oriented());
  EXPECT_NEAR(found.shells[0].volume, -1, 1e-6);
  EXPECT_FALSE(found.printable());
  EXPECT_TRUE(report_of(found, {.expect = TopologyVerdict::Closed}).verdict);
}

TEST(Topology, WeldsOnRequest) {
  Mesh soup;
  const Mesh cube = boxes({{0, 0, 0}});
  for (const std::uint32_t corner : cube.corners) {
    soup.corners.push_back(static_cast<std::uint32_t>(soup.positions.size()));
    soup.positions.push_back(cube.positions[corner]);
  }
  soup.face_offsets = cube.face_offsets;
  EXPECT_EQ(topology(soup).count(MeshFaultKind::BorderEdge), 24U);
  EXPECT_EQ(topology(soup).count(MeshFaultKind::DoubledVertex), 16U);
  EXPECT_TRUE(topology(soup, {.by_position = true}).printable());
}

// Self-intersections.

/// Whether triangles meet, by rational arithmetic: small whole coordinates, exact in long long. Two triangles meet where
/// the planes and edges can't be put apart: separating axes for convex sets.
bool meet_by_separation(const std::array<glm::dvec3, 3>& a, const std::array<glm::dvec3, 3>& b) {
  std::vector<glm::dvec3> axes;
  const auto add = [&](const glm::dvec3& axis) { axes.push_back(axis); };
  const glm::dvec3 na = glm::cross(a[1] - a[0], a[2] - a[0]);
  const glm::dvec3 nb = glm::cross(b[1] - b[0], b[2] - b[0]);
  add(na);
  add(nb);
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 ea = a[(i + 1) % 3] - a[i];
    add(glm::cross(na, ea));
    for (std::size_t j = 0; j < 3; ++j) {
      const glm::dvec3 eb = b[(j + 1) % 3] - b[j];
      add(glm::cross(ea, eb));
      if (i == 0) add(glm::cross(nb, eb));
    }
  }
  for (const glm::dvec3& axis : axes) {
    if (axis == glm::dvec3(0)) continue;
    double low_a = 1e300, high_a = -1e300, low_b = 1e300, high_b = -1e300;
    for (std::size_t i = 0; i < 3; ++i) {
      low_a = std::min(low_a, glm::dot(axis, a[i]));
      high_a = std::max(high_a, glm::dot(axis, a[i]));
      low_b = std::min(low_b, glm::dot(axis, b[i]));
      high_b = std::max(high_b, glm::dot(axis, b[i]));
    }
    if (high_a < low_b || high_b < low_a) return false;
  }
  return true;
}

TEST(SelfIntersections, AgreeWithSeparatingAxes) {
  std::mt19937 random(7);
  int met = 0;
  for (int i = 0; i < 40000; ++i) {
    const int range = 2 + i % 5;
    const int flat = i % 3;
    std::array<glm::dvec3, 3> t[2];
    for (auto& triangle : t) {
      for (glm::dvec3& p : triangle) {
        p = glm::dvec3(random() % static_cast<unsigned>(range), random() % static_cast<unsigned>(range),
                       flat == 0 ? 0U : random() % static_cast<unsigned>(range));
      }
    }
    const auto has_area = [](const std::array<glm::dvec3, 3>& p) {
      return glm::cross(p[1] - p[0], p[2] - p[0]) != glm::dvec3(0);
    };
    if (!has_area(t[0]) || !has_area(t[1])) {
      triangles_meet(t[0], t[1]);
      continue;
    }
    const bool expected = meet_by_separation(t[0], t[1]);
    met += expected ? 1 : 0;
    ASSERT_EQ(triangles_meet(t[0], t[1]), expected) << i;
    ASSERT_EQ(triangles_meet(t[1], t[0]), expected) << i;
  }
  EXPECT_GT(met, 5000);
}

TEST(SelfIntersections, CommonElementsAreNoIntersections) {
  for (const PrimitiveKind kind : {PrimitiveKind::Cube, PrimitiveKind::IcoSphere, PrimitiveKind::Torus}) {
    EXPECT_EQ(topology(made(kind), {.self_intersections = true}).count(MeshFaultKind::IntersectingFace), 0U);
  }
  // Two triangles of one plane on one side of their edge; folded up they only have the edge in common.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {3, 3, 0}};
  mesh.corners = {0, 1, 2, 1, 0, 3};
  EXPECT_EQ(topology(mesh, {.self_intersections = true}).count(MeshFaultKind::IntersectingFace), 1U);
  mesh.positions[3].z = 1e-30F;
  EXPECT_EQ(topology(mesh, {.self_intersections = true}).count(MeshFaultKind::IntersectingFace), 0U);
  // One corner in common, and the far edge of one through the other.
  mesh.positions = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 1}, {1, 1, -1}};
  mesh.corners = {0, 1, 2, 0, 3, 4};
  EXPECT_EQ(topology(mesh, {.self_intersections = true}).count(MeshFaultKind::IntersectingFace), 1U);
  mesh.positions[4].z = 1;
  mesh.positions[4].x = 2;
  EXPECT_EQ(topology(mesh, {.self_intersections = true}).count(MeshFaultKind::IntersectingFace), 0U);
}

TEST(SelfIntersections, ArePairsOfBruteForce) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(0, 10);
  std::uniform_real_distribution<float> size(-1, 1);
  Mesh mesh;
  for (std::uint32_t t = 0; t < 400; ++t) {
    const glm::vec3 middle(place(random), place(random), place(random));
    for (std::uint32_t i = 0; i < 3; ++i) {
      mesh.positions.push_back(middle + glm::vec3(size(random), size(random), size(random)));
      mesh.corners.push_back(3 * t + i);
    }
  }
  std::vector<std::array<std::uint32_t, 2>> expected;
  const auto triangle = [&](std::uint32_t t) {
    return std::array{glm::dvec3(mesh.positions[3 * t]), glm::dvec3(mesh.positions[3 * t + 1]),
                      glm::dvec3(mesh.positions[3 * t + 2])};
  };
  for (std::uint32_t a = 0; a < 400; ++a) {
    for (std::uint32_t b = a + 1; b < 400; ++b) {
      if (triangles_meet(triangle(a), triangle(b))) expected.push_back({a, b});
    }
  }
  std::vector<std::uint32_t> own(mesh.vertex_count());
  for (std::uint32_t v = 0; v < own.size(); ++v) own[v] = v;
  EXPECT_GT(expected.size(), 50U);
  EXPECT_EQ(self_intersections(mesh, own, {}), expected);
}

}  // namespace
}  // namespace azulejo
