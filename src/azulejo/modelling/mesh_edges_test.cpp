#include "azulejo/modelling/mesh_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "azulejo/io/weld.h"

namespace azulejo {
namespace {

Array<MeshEdge> edges_of(const Mesh& mesh, const Run& run = {}) {
  return mesh_edges(mesh, weld_exactly(mesh.positions, run).corners, run);
}

Mesh two_triangles() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.corners = {0, 1, 2, 0, 2, 3};
  return mesh;
}

TEST(MeshEdges, SharedOnesAreThereOnce) {
  const Mesh mesh = two_triangles();
  const Array<MeshEdge> edges = edges_of(mesh);
  ASSERT_EQ(edges.size(), 5U);
  std::set<std::pair<std::uint32_t, std::uint32_t>> found;
  for (const MeshEdge& edge : edges) {
    found.insert(std::minmax(mesh.corners[edge.begin], mesh.corners[edge.end]));
    const bool shared = found.contains({0, 2}) && std::minmax(mesh.corners[edge.begin], mesh.corners[edge.end]) ==
                                                      std::pair<const std::uint32_t&, const std::uint32_t&>(0U, 2U);
    EXPECT_EQ(edge.faces, shared ? 2U : 1U);
    EXPECT_EQ(edge.other_face, shared ? 1U : MeshEdge::kNone);
    EXPECT_FALSE(edge.turned);
  }
  EXPECT_EQ(found.size(), 5U);
}

TEST(MeshEdges, EqualPositionsAreOneVertex) {
  Mesh mesh = two_triangles();
  // The second triangle has vertices of its own, as files with seams have.
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-0.0F, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.corners = {0, 1, 2, 3, 4, 5};
  EXPECT_EQ(edges_of(mesh).size(), 5U);
}

TEST(MeshEdges, OfPolygonsHaveNoDiagonals) {
  Mesh mesh = two_triangles();
  mesh.corners = {0, 1, 2, 3};
  mesh.face_offsets = {0, 4};
  EXPECT_EQ(edges_of(mesh).size(), 4U);
}

TEST(MeshEdges, FacesInsideOutAndCrowdsAreSeen) {
  Mesh mesh = two_triangles();
  mesh.corners = {0, 1, 2, 0, 3, 2};  // both run from 2 to 0
  const Array<MeshEdge> turned = edges_of(mesh);
  EXPECT_EQ(std::ranges::count_if(turned, [](const MeshEdge& edge) { return edge.turned; }), 1);
  mesh.positions.emplace_back(0, 0, 1);
  mesh.corners = {0, 1, 2, 0, 2, 3, 0, 2, 4};
  const Array<MeshEdge> crowded = edges_of(mesh);
  EXPECT_EQ(crowded.size(), 7U);
  EXPECT_EQ(std::ranges::count_if(crowded, [](const MeshEdge& edge) { return edge.faces == 3; }), 1);
}

TEST(MeshEdges, DegenerateFaces) {
  Mesh mesh = two_triangles();
  EXPECT_TRUE(edges_of(Mesh()).empty());
  mesh.corners = {0, 1, 0, 0, 0, 0, 1, 2};
  mesh.face_offsets = {0, 0, 2, 5, 8};  // nothing; there and back; a point thrice; a triangle
  const Array<MeshEdge> edges = edges_of(mesh);
  ASSERT_EQ(edges.size(), 3U);
  EXPECT_EQ(edges[0].faces, 1U);  // 0–1: the face of two corners has none
}

/// As a map of pairs finds them.
TEST(MeshEdges, AgreeWithAMapOnRandomFaces) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    std::mt19937 random(seed);
    Mesh mesh;
    const std::uint32_t vertices = 40000;
    for (std::uint32_t v = 0; v < vertices; ++v)
      mesh.positions.emplace_back(static_cast<float>(v / 2), 1, 0);  // two at each position
    for (int i = 0; i < 90000; ++i) mesh.corners.push_back(static_cast<std::uint32_t>(random() % vertices));
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> expected;
    for (std::size_t face = 0; face < mesh.corners.size(); face += 3) {
      const std::uint32_t at[3] = {mesh.corners[face] / 2, mesh.corners[face + 1] / 2, mesh.corners[face + 2] / 2};
      if (at[0] == at[1] || at[1] == at[2] || at[2] == at[0]) continue;
      for (int i = 0; i < 3; ++i) ++expected[std::minmax(at[i], at[(i + 1) % 3])];
    }
    const Array<MeshEdge> edges = edges_of(mesh);
    ASSERT_EQ(edges.size(), expected.size()) << "seed " << seed;
    for (const MeshEdge& edge : edges) {
      const std::pair<std::uint32_t, std::uint32_t> key =
          std::minmax(mesh.corners[edge.begin] / 2, mesh.corners[edge.end] / 2);
      ASSERT_EQ(edge.faces, expected[key]) << "seed " << seed;
      ASSERT_EQ(edge.face, edge.begin / 3);
    }
    const Array<MeshEdge> alone = edges_of(mesh, {.threads = 1});
    ASSERT_TRUE(std::ranges::equal(
        edges, alone, [](const MeshEdge& a, const MeshEdge& b) { return a.begin == b.begin && a.end == b.end; }));
  }
}

}  // namespace
}  // namespace azulejo
