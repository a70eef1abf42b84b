#include "azulejo/modelling/winged_edge.h"

#include <cmath>
#include <random>
#include <sstream>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "azulejo/core/error.h"
#include "azulejo/modelling/closed.h"
#include "azulejo/modelling/primitive.h"
#include "azulejo/modelling/winged_edge_build.h"

namespace azulejo {
namespace {

using Half = WingedEdge::Half;

void expect_sound(const WingedEdge& solid) {
  const std::vector<std::string> faults = solid.faults(5);
  EXPECT_TRUE(faults.empty()) << (faults.empty() ? "" : faults[0]);
}

/// V + F − E − (L − F) − 2 (S − G) of a closed solid, without its G: 2 (S − G) where the formula holds.
long characteristic(const WingedEdge& solid) {
  return static_cast<long>(solid.vertex_count()) + 2 * static_cast<long>(solid.face_count()) -
         static_cast<long>(solid.edge_count()) - static_cast<long>(solid.loop_count());
}

double volume(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t face = 0; face < mesh.face_count(); ++face) {
    const auto at = [&](std::size_t corner) { return glm::dvec3(mesh.positions[mesh.corners[corner]]); };
    for (std::size_t c = mesh.face_begin(face) + 1; c + 1 < mesh.face_end(face); ++c) {
      sum += glm::dot(at(mesh.face_begin(face)), glm::cross(at(c), at(c + 1))) / 6;
    }
  }
  return sum;
}

/// A unit cube whose top and bottom are split into four triangles, as a course prints it: [first face at start, second
/// at start, first at end, second at end]. Its slips are mended (two faces, three wings, two positions); that it names
/// now the left and now the right face first is left.
constexpr const char* kTable = R"(
f0 4 8 9
f1 0 10 9
f2 5 10 11
f3 1 12 11
f4 6 12 13
f5 2 14 13
f6 7 14 15
f7 3 8 15
f8 4 16 19
f9 5 17 16
f10 6 18 17
f11 7 19 18
f12 0 23 20
f13 1 20 21
f14 2 21 22
f15 3 22 23
e0 0 1 1 12 9 23 10 20
e1 1 2 3 13 11 20 12 21
e2 2 3 5 14 13 21 14 22
e3 3 0 7 15 15 22 8 23
e4 4 5 0 8 8 19 9 16
e5 5 6 2 9 10 16 11 17
e6 6 7 4 10 12 17 13 18
e7 7 4 6 11 14 18 15 19
e8 0 4 7 0 3 9 15 4
e9 0 5 0 1 8 0 4 10
e10 1 5 1 2 0 11 9 5
e11 1 6 2 3 10 1 5 12
e12 2 6 3 4 1 13 11 6
e13 2 7 4 5 12 2 6 14
e14 3 7 5 6 2 15 13 7
e15 3 4 6 7 14 3 7 8
e16 5 8 8 9 4 5 19 17
e17 6 8 9 10 5 6 16 18
e18 7 8 10 11 6 7 17 19
e19 4 8 11 8 7 4 18 16
e20 1 9 12 13 0 1 23 21
e21 2 9 13 14 1 2 20 22
e22 3 9 14 15 2 3 21 23
e23 0 9 15 12 3 0 22 20
v0 0 0 0 8 9 0 23 3
v1 1 0 0 10 11 1 20 0
v2 1 1 0 12 13 2 21 1
v3 0 1 0 14 15 3 22 2
v4 0 0 1 8 15 7 19 4
v5 1 0 1 10 9 4 16 5
v6 1 1 1 12 11 5 17 6
v7 0 1 1 14 13 6 18 7
v8 0.5 0.5 1 16 17 18 19
v9 0.5 0.5 0 20 21 22 23
)";

struct Table {
  std::vector<std::uint32_t> face_edges;
  std::vector<WingedEdge::Edge> edges;
  std::vector<WingedEdge::Vertex> vertices;
  std::vector<std::vector<std::uint32_t>> rings;  ///< of the faces, then of the vertices
};

Table read_table(const std::string& text) {
  Table table;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name;
    words >> name;
    if (name.empty()) continue;
    if (name[0] == 'e') {
      WingedEdge::Edge edge;
      words >> edge.vertex[0] >> edge.vertex[1] >> edge.face[0] >> edge.face[1];
      for (std::uint32_t& wing : edge.wing) words >> wing;
      table.edges.push_back(edge);
      continue;
    }
    if (name[0] == 'v') {
      WingedEdge::Vertex vertex;
      words >> vertex.position.x >> vertex.position.y >> vertex.position.z;
      table.vertices.push_back(vertex);
    }
    std::vector<std::uint32_t>& ring = table.rings.emplace_back();
    for (std::uint32_t edge = 0; words >> edge;) ring.push_back(edge);
    (name[0] == 'v' ? table.vertices.back().edge : table.face_edges.emplace_back()) = ring[0];
  }
  return table;
}

/// Puts the face to the left of each edge first, seen from outside: the cube's middle is inside.
void put_left_first(Table& table) {
  for (WingedEdge::Edge& edge : table.edges) {
    const glm::vec3 a = table.vertices[edge.vertex[0]].position;
    const glm::vec3 b = table.vertices[edge.vertex[1]].position;
    glm::vec3 middle(0);
    const std::vector<std::uint32_t>& ring = table.rings[edge.face[0]];
    for (const std::uint32_t each : ring) {
      for (const std::uint32_t v : table.edges[each].vertex) middle += table.vertices[v].position;
    }
    middle /= 2 * ring.size();
    const glm::vec3 outward = middle - glm::vec3(0.5F);
    if (glm::dot(glm::cross(b - a, middle - a), outward) > 0) continue;
    std::swap(edge.face[0], edge.face[1]);
    std::swap(edge.wing[0], edge.wing[1]);
    std::swap(edge.wing[2], edge.wing[3]);
  }
}

TEST(WingedEdge, HoldsTheTableOfACourse) {
  Table table = read_table(kTable);
  put_left_first(table);
  const WingedEdge solid = WingedEdge::from_records(table.vertices, table.edges, table.face_edges);
  expect_sound(solid);
  EXPECT_EQ(solid.vertex_count(), 10U);
  EXPECT_EQ(solid.edge_count(), 24U);
  EXPECT_EQ(solid.face_count(), 16U);
  EXPECT_EQ(solid.shell_count(), 1U);
  EXPECT_NEAR(volume(mesh_of(solid)), 1, 1e-6);
  // The printed rings, which begin anywhere and run one way or the other.
  const auto same_ring = [](std::vector<std::uint32_t> printed, std::vector<std::uint32_t> walked) {
    if (printed.size() != walked.size()) return false;
    for (int way = 0; way < 2; ++way) {
      for (std::size_t i = 0; i < walked.size(); ++i) {
        if (printed == walked) return true;
        std::rotate(walked.begin(), walked.begin() + 1, walked.end());
      }
      std::reverse(walked.begin(), walked.end());
    }
    return false;
  };
  const auto edges = [](const auto& halves) {
    std::vector<std::uint32_t> list;
    for (const Half half : halves) list.push_back(half >> 1);
    return list;
  };
  for (std::uint32_t f = 0; f < 16; ++f) EXPECT_TRUE(same_ring(table.rings[f], edges(solid.halves_of(f)))) << f;
  for (std::uint32_t v = 0; v < 10; ++v) EXPECT_TRUE(same_ring(table.rings[16 + v], edges(solid.edges_of(v)))) << v;
  const std::string printed = solid.table();
  for (const char* line : {"f0 4 8 9\n", "e8 v0 v4 f7 f0 3 9 15 4\n", "v8 0.5,0.5,1 16 "}) {
    EXPECT_NE(printed.find(line), std::string::npos) << line << "not in\n" << printed;
  }
}

TEST(WingedEdge, NamesTheSlipsOfThePrintedTable) {
  const auto faults_with = [](const std::string& right, const std::string& printed) {
    std::string text = kTable;
    text.replace(text.find(right), right.size(), printed);
    Table table = read_table(text);
    put_left_first(table);
    return WingedEdge::from_records(table.vertices, table.edges, table.face_edges).faults();
  };
  const auto name = [](const std::vector<std::string>& faults, const std::string& edge) {
    return std::any_of(faults.begin(), faults.end(),
                       [&](const std::string& fault) { return fault.find(edge) != std::string::npos; });
  };
  EXPECT_TRUE(name(faults_with("e19 4 8 11 8 7 4 18 16", "e19 4 8 11 18 7 4 18 16"), "edge 19 names face 18"));
  EXPECT_TRUE(name(faults_with("e8 0 4 7 0 3 9 15 4", "e8 0 4 7 10 3 9 15 4"), "face 10"));
  EXPECT_TRUE(name(faults_with("e8 0 4 7 0 3 9 15 4", "e8 0 4 7 0 3 9 7 4"), "edge 8"));
  EXPECT_TRUE(name(faults_with("e15 3 4 6 7 14 3 7 8", "e15 3 4 6 7 14 3 7 15"), "edge 15"));
}

TEST(WingedEdge, FaultsSurviveAnyNumbers) {
  std::mt19937 random(5);
  const Table good = [] {
    Table table = read_table(kTable);
    put_left_first(table);
    return table;
  }();
  for (int i = 0; i < 3000; ++i) {
    Table table = good;
    for (int change = 0; change < 1 + i % 3; ++change) {
      WingedEdge::Edge& edge = table.edges[random() % table.edges.size()];
      const auto value = static_cast<std::uint32_t>(random() % 4 == 0 ? random() : random() % 26);
      const std::size_t place = random() % 8;
      (place < 2 ? edge.vertex[place] : place < 4 ? edge.face[place - 2] : edge.wing[place - 4]) = value;
    }
    table.face_edges[random() % 16] = static_cast<std::uint32_t>(random() % 40);
    WingedEdge::from_records(table.vertices, table.edges, table.face_edges).faults();
  }
}

WingedEdge solid_of(PrimitiveKind kind) {
  PrimitiveOptions options;
  options.kind = kind;
  WingedEdgeOfMesh made = winged_edge(primitive(options));
  return std::move(made.solid);
}

TEST(WingedEdge, TakesAndGivesBackMeshes) {
  for (const PrimitiveKind kind : {PrimitiveKind::Cube, PrimitiveKind::Icosahedron, PrimitiveKind::Dodecahedron}) {
    PrimitiveOptions options;
    options.kind = kind;
    const Mesh mesh = primitive(options);
    const WingedEdgeOfMesh made = winged_edge(mesh);
    expect_sound(made.solid);
    const Mesh back = mesh_of(made.solid, &mesh);
    ASSERT_EQ(back.face_count(), mesh.face_count());
    EXPECT_EQ(back.positions, mesh.positions);
    EXPECT_NEAR(volume(back), volume(mesh), 1e-6);
    EXPECT_EQ(back.attributes.size(), mesh.attributes.size());
    EXPECT_NO_THROW(back.check("back"));
  }
}

Mesh two_cubes(const glm::vec3& offset) {
  Mesh mesh;
  for (int cube = 0; cube < 2; ++cube) {
    std::uint32_t index[8];
    for (std::uint32_t i = 0; i < 8; ++i) {
      const glm::vec3 at = glm::vec3(i & 1U, i >> 1 & 1U, i >> 2 & 1U) + (cube == 1 ? offset : glm::vec3(0));
      const auto found = std::find(mesh.positions.begin(), mesh.positions.end(), at);
      index[i] = static_cast<std::uint32_t>(found - mesh.positions.begin());
      if (found == mesh.positions.end()) mesh.positions.push_back(at);
    }
    for (const std::uint32_t i : {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5}) {
      mesh.corners.push_back(index[i]);
    }
  }
  for (std::uint32_t f = 0; f <= 12; ++f) mesh.face_offsets.push_back(4 * f);
  return mesh;
}

TEST(WingedEdge, SplitsWhatIsNoManifold) {
  // Cubes that share an edge come apart as two whole cubes; so do those that share a vertex.
  const WingedEdgeOfMesh at_edge = winged_edge(two_cubes({1, 1, 0}));
  expect_sound(at_edge.solid);
  EXPECT_EQ(at_edge.changes.split_edges.size(), 1U);
  EXPECT_EQ(at_edge.changes.split_vertices.size(), 2U);
  const WingedEdgeOfMesh at_vertex = winged_edge(two_cubes({1, 1, 1}));
  expect_sound(at_vertex.solid);
  EXPECT_TRUE(at_vertex.changes.split_edges.empty());
  EXPECT_EQ(at_vertex.changes.split_vertices.size(), 1U);
  for (const WingedEdgeOfMesh* made : {&at_edge, &at_vertex}) {
    EXPECT_EQ(made->solid.vertex_count(), 16U);
    EXPECT_EQ(made->solid.edge_count(), 24U);
    EXPECT_EQ(made->solid.shell_count(), 2U);
    EXPECT_EQ(made->solid.border_loop_count(), 0U);
    EXPECT_EQ(characteristic(made->solid), 4);
  }
}

TEST(WingedEdge, BordersAreLoops) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}, {9, 9, 9}};
  mesh.corners = {0, 1, 4, 3, 1, 2, 5, 4, 0, 0, 1, 2};
  mesh.face_offsets = {0, 4, 8, 10, 12};
  const WingedEdgeOfMesh made = winged_edge(mesh);
  expect_sound(made.solid);
  EXPECT_EQ(made.changes.dropped_faces, (std::vector<std::uint32_t>{2, 3}));
  EXPECT_EQ(made.solid.vertex_count(), 6U);
  EXPECT_EQ(made.solid.border_loop_count(), 1U);
  EXPECT_EQ(made.solid.degree(1), 3U);
  EXPECT_EQ(made.solid.faces_of(1).size(), 2U);
}

TEST(WingedEdge, TakesRandomSoup) {
  std::mt19937 random(11);
  for (int i = 0; i < 300; ++i) {
    Mesh mesh;
    const std::uint32_t vertices = 3 + static_cast<std::uint32_t>(random() % 12);
    for (std::uint32_t v = 0; v < vertices; ++v) {
      mesh.positions.emplace_back(random() % 4, random() % 4, random() % 4);
    }
    mesh.face_offsets = {0};
    for (int f = 0; f < 30; ++f) {
      for (std::size_t c = random() % 6; c-- > 0;)
        mesh.corners.push_back(static_cast<std::uint32_t>(random() % vertices));
      mesh.face_offsets.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
    }
    SCOPED_TRACE(i);
    const WingedEdgeOfMesh made = winged_edge(mesh);
    expect_sound(made.solid);
    const Mesh back = mesh_of(made.solid, &mesh);
    EXPECT_NO_THROW(back.check("back"));
    EXPECT_EQ(back.face_count() + made.changes.dropped_faces.size(), 30U);
  }
}

// Euler operators.

struct Counts {
  std::size_t vertices, edges, faces, loops, shells;
  friend bool operator==(const Counts&, const Counts&) = default;
};
Counts counts(const WingedEdge& solid) {
  return {solid.vertex_count(), solid.edge_count(), solid.face_count(), solid.loop_count(), solid.shell_count()};
}

/// A box from nothing: 8 vertices, 12 edges, 6 faces.
WingedEdge built_box() {
  WingedEdge solid;
  const auto seed = solid.make_vertex_face_shell({0, 0, 0});
  const auto first = solid.make_edge_vertex_at(seed.loop, {1, 0, 0});
  const Half bottom = first.edge << 1;
  const auto second = solid.make_edge_vertex(WingedEdge::twin(bottom), {1, 1, 0});
  const auto third = solid.make_edge_vertex(WingedEdge::twin(second.edge << 1), {0, 1, 0});
  solid.make_edge_face(WingedEdge::twin(third.edge << 1), bottom);
  expect_sound(solid);
  // The face of the seed is swept up: spurs at its vertices, then faces between them.
  std::vector<Half> ring;
  for (const Half half : solid.halves_of(solid.face(seed.face).loop)) ring.push_back(half);
  std::vector<Half> spurs;
  for (const Half half : ring) {
    const glm::vec3 at = solid.vertex(solid.from(half)).position;
    spurs.push_back(solid.make_edge_vertex(half, at + glm::vec3(0, 0, 1)).edge << 1);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    solid.make_edge_face(WingedEdge::twin(spurs[i]),
                         i == 3 ? solid.next(spurs[0]) : WingedEdge::twin(spurs[(i + 1) % 4]));
  }
  return solid;
}

TEST(WingedEdge, EulerOperatorsBuildABox) {
  const WingedEdge solid = built_box();
  expect_sound(solid);
  EXPECT_EQ(counts(solid), (Counts{8, 12, 6, 6, 1}));
  EXPECT_EQ(characteristic(solid), 2);
  for (std::uint32_t f = 0; f < 6; ++f) EXPECT_EQ(solid.vertices_of(f).size(), 4U);
  EXPECT_NEAR(std::abs(volume(mesh_of(solid))), 1, 1e-6);
}

TEST(WingedEdge, EulerOperatorsUndoEachOther) {
  WingedEdge solid = built_box();
  const std::string before = solid.table();
  const Half half = 0;
  const auto spur = solid.make_edge_vertex(half, {5, 5, 5});
  expect_sound(solid);
  solid.kill_edge_vertex(spur.edge << 1);
  const auto divided = solid.make_edge_face(half, solid.next(solid.next(half)));
  expect_sound(solid);
  EXPECT_EQ(counts(solid), (Counts{8, 13, 7, 7, 1}));
  solid.kill_edge_face(WingedEdge::twin(divided.edge << 1));
  expect_sound(solid);
  // A hole: a spur to a lone vertex, from which a triangle grows.
  const auto way = solid.make_edge_vertex(half, {0.2F, 0.2F, 0});
  const auto hole = solid.kill_edge_make_loop(way.edge << 1);
  expect_sound(solid);
  EXPECT_EQ(counts(solid), (Counts{9, 12, 6, 7, 1}));
  const auto back = solid.make_edge_kill_loop_at(half, hole.loop);
  EXPECT_EQ(back.edge, way.edge);
  expect_sound(solid);
  solid.kill_edge_vertex(back.edge << 1);
  const auto split = solid.split_edge(3, {0.5F, 0.5F, 0.5F});
  expect_sound(solid);
  solid.join_edges(split.edge, split.vertex);
  expect_sound(solid);
  EXPECT_EQ(counts(solid), (Counts{8, 12, 6, 6, 1}));
  std::string after = solid.table();
  std::sort(after.begin(), after.end());
  std::string sorted = before;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(after, sorted);
}

/// A triangle inside a face, as a hole with a face of its own in it.
std::uint32_t add_island(WingedEdge& solid, Half at, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const auto way = solid.make_edge_vertex(at, a);
  const std::uint32_t loop = solid.kill_edge_make_loop(way.edge << 1).loop;
  const auto first = solid.make_edge_vertex_at(loop, b);
  const auto second = solid.make_edge_vertex(WingedEdge::twin(first.edge << 1), c);
  return solid.make_edge_face(first.edge << 1, WingedEdge::twin(second.edge << 1)).face;
}

TEST(WingedEdge, HandlesRaiseTheGenus) {
  WingedEdge solid = built_box();
  // The face with four vertices at z 0, and that at z 1.
  std::uint32_t low = kNoElement;
  std::uint32_t high = kNoElement;
  for (std::uint32_t f = 0; f < 6; ++f) {
    float sum = 0;
    for (const std::uint32_t v : solid.vertices_of(f)) sum += solid.vertex(v).position.z;
    if (sum == 0) low = f;
    if (sum == 4) high = f;
  }
  const auto first = [&](std::uint32_t face) { return solid.loop(solid.face(face).loop).half; };
  const std::uint32_t lower = add_island(solid, first(low), {0.3F, 0.3F, 0}, {0.3F, 0.6F, 0}, {0.6F, 0.3F, 0});
  const std::uint32_t upper = add_island(solid, first(high), {0.3F, 0.3F, 1}, {0.6F, 0.3F, 1}, {0.3F, 0.6F, 1});
  expect_sound(solid);
  EXPECT_EQ(characteristic(solid), 2);
  // The islands become one face with two loops, a pipe without walls: V and E stay, F falls, L stays.
  const auto pipe = solid.kill_face_make_loop(lower, upper);
  expect_sound(solid);
  EXPECT_EQ(characteristic(solid), 0) << "S 1, G 1";
  EXPECT_EQ(solid.shell_count(), 1U);
  // Edges between the loops divide it into walls.
  const Half inner = solid.loop(pipe.loop).half;
  const Half outer = first(lower);
  const auto wall = solid.make_edge_kill_loop(outer, inner);
  expect_sound(solid);
  EXPECT_EQ(characteristic(solid), 0);
  EXPECT_EQ(solid.loops_of(low).size(), 2U);
  // A face with a hole is one polygon of a mesh, bridged: the area is that of the square without the triangle.
  const Mesh mesh = mesh_of(solid);
  EXPECT_NO_THROW(mesh.check("bridged"));
  double smallest = 2;
  for (std::size_t face = 0; face < mesh.face_count(); ++face) {
    double area = 0;
    bool flat = true;
    for (std::size_t c = mesh.face_begin(face); c < mesh.face_end(face); ++c) {
      const glm::vec3 p = mesh.positions[mesh.corners[c]];
      const std::size_t next = c + 1 == mesh.face_end(face) ? mesh.face_begin(face) : c + 1;
      const glm::vec3 q = mesh.positions[mesh.corners[next]];
      flat = flat && p.z == 0;
      area += 0.5 * static_cast<double>(p.x * q.y - q.x * p.y);
    }
    if (flat) smallest = std::abs(area);
  }
  EXPECT_NEAR(smallest, 1 - 0.045, 1e-6);
  const auto again = solid.kill_edge_make_loop(wall.edge << 1);
  EXPECT_EQ(again.loop, pipe.loop);
  const auto cap = solid.make_face_kill_loop(again.loop);
  EXPECT_EQ(cap.face, upper);
  expect_sound(solid);
  EXPECT_EQ(characteristic(solid), 2);
}

TEST(WingedEdge, KillsBackToNothing) {
  WingedEdge solid;
  const auto seed = solid.make_vertex_face_shell({1, 2, 3});
  const auto edge = solid.make_edge_vertex_at(seed.loop, {4, 5, 6});
  expect_sound(solid);
  EXPECT_THROW(solid.kill_vertex_face_shell(seed.face), Error);
  solid.kill_edge_vertex(edge.edge << 1);
  expect_sound(solid);
  solid.kill_vertex_face_shell(seed.face);
  EXPECT_EQ(counts(solid), (Counts{0, 0, 0, 0, 0}));
  EXPECT_EQ(mesh_of(solid).face_count(), 0U);
}

TEST(WingedEdge, OperatorsRefuseWhatTheyCannotDo) {
  WingedEdge solid = built_box();
  const std::string before = solid.table();
  EXPECT_THROW(solid.make_edge_face(0, 0), Error);
  EXPECT_THROW(solid.kill_edge_vertex(0), Error);
  EXPECT_THROW(solid.kill_edge_make_loop(0), Error);
  EXPECT_THROW(solid.make_edge_kill_loop(0, solid.next(0)), Error);
  EXPECT_THROW(solid.kill_face_make_loop(0, 0), Error);
  EXPECT_THROW(solid.kill_face_make_loop(0, 99), Error);
  EXPECT_THROW(solid.make_face_kill_loop(0), Error);
  EXPECT_THROW(solid.kill_vertex_face_shell(0), Error);
  EXPECT_THROW(solid.join_edges(0, solid.edge(0).vertex[0]), Error);
  EXPECT_THROW(solid.flip_edge(0), Error);
  EXPECT_EQ(solid.table(), before);
}

// Edits.

TEST(WingedEdge, FlippingFourTimesIsNothing) {
  WingedEdge solid = solid_of(PrimitiveKind::Icosahedron);
  const std::string before = solid.table();
  for (std::uint32_t edge = 0; edge < solid.edge_count(); ++edge) {
    ASSERT_EQ(solid.why_not_flip(edge), nullptr);
    for (int i = 0; i < 4; ++i) {
      solid.flip_edge(edge);
      if (edge == 0) expect_sound(solid);
      EXPECT_EQ(characteristic(solid), 2);
    }
  }
  expect_sound(solid);
  EXPECT_EQ(solid.vertex_count(), 12U);
  EXPECT_EQ(mesh_of(solid).positions, mesh_of(solid_of(PrimitiveKind::Icosahedron)).positions);
  EXPECT_NEAR(volume(mesh_of(solid)), volume(mesh_of(solid_of(PrimitiveKind::Icosahedron))), 1e-6);
}

TEST(WingedEdge, ATetrahedronCannotBeCollapsedNorFlipped) {
  const WingedEdge solid = solid_of(PrimitiveKind::Tetrahedron);
  for (std::uint32_t edge = 0; edge < 6; ++edge) {
    EXPECT_NE(solid.why_not_collapse(edge), nullptr);
    EXPECT_NE(solid.why_not_flip(edge), nullptr);
  }
}

TEST(WingedEdge, RandomEditsKeepTheSurface) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    std::mt19937 random(seed);
    PrimitiveOptions options;
    options.kind = seed % 2 == 0 ? PrimitiveKind::UvSphere : PrimitiveKind::Torus;
    Mesh mesh = primitive(options);
    if (seed >= 4) {  // with holes
      mesh.corners.resize(mesh.face_end(mesh.face_count() / 2));
      if (!mesh.face_offsets.empty()) mesh.face_offsets.resize(mesh.face_count() / 2 + 2);
      mesh.attributes.clear();
    }
    WingedEdge solid = winged_edge(mesh).solid;
    const auto measured = [&] { return characteristic(solid) + static_cast<long>(solid.border_loop_count()); };
    const long expected = measured();
    int done = 0;
    for (int i = 0; i < 4000; ++i) {
      const auto edge = static_cast<std::uint32_t>(random() % solid.edge_slots());
      if (!solid.edge_alive(edge)) continue;
      const glm::vec3 a = solid.vertex(solid.edge(edge).vertex[0]).position;
      switch (random() % 4) {
        case 0: solid.split_edge(edge, a); break;
        case 1:
          if (solid.why_not_flip(edge) == nullptr) solid.flip_edge(edge);
          break;
        case 2: {
          const Half half = edge << 1;
          const Half end = solid.next(solid.next(half));
          if (solid.left(half) != kNoElement && solid.next(end) != half && solid.from(end) != solid.from(half) &&
              solid.find(solid.from(half), solid.from(end)) == kNoElement) {
            solid.make_edge_face(half, end);
          }
          break;
        }
        default:
          if (solid.why_not_collapse(edge) == nullptr) {
            solid.collapse_edge(edge, a);
            ++done;
          }
      }
      if (i % 500 == 0) expect_sound(solid);
    }
    EXPECT_GT(done, 100);
    expect_sound(solid);
    EXPECT_EQ(measured(), expected) << "seed " << seed;
    EXPECT_NO_THROW(mesh_of(solid).check("edited"));
  }
}

TEST(WingedEdge, CollapsesToTheSmallestSurface) {
  WingedEdge solid = solid_of(PrimitiveKind::Icosahedron);
  for (bool any = true; any;) {
    any = false;
    for (std::uint32_t edge = 0; edge < solid.edge_slots(); ++edge) {
      if (!solid.edge_alive(edge) || solid.why_not_collapse(edge) != nullptr) continue;
      solid.collapse_edge(edge, solid.vertex(solid.edge(edge).vertex[0]).position);
      expect_sound(solid);
      any = true;
    }
  }
  EXPECT_EQ(counts(solid), (Counts{4, 6, 4, 4, 1}));
}

}  // namespace
}  // namespace azulejo
