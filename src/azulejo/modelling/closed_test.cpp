#include "azulejo/modelling/closed.h"

#include <chrono>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace azulejo {
namespace {

Mesh polygons(std::size_t vertices, std::initializer_list<std::vector<std::uint32_t>> faces) {
  Mesh mesh;
  for (std::size_t i = 0; i < vertices; ++i) {
    mesh.positions.emplace_back(static_cast<float>(i), static_cast<float>(i * i), 1.0F);
  }
  mesh.face_offsets.push_back(0);
  for (const auto& face : faces) {
    mesh.corners.insert(mesh.corners.end(), face.begin(), face.end());
    mesh.face_offsets.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  }
  mesh.check("polygons");
  return mesh;
}

Mesh tetrahedron() { return polygons(4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}); }

/// A grid on a torus, of triangles: closed, 3/2 edges a triangle.
Mesh torus(std::uint32_t across, std::uint32_t around) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < across * around; ++i) {
    const float u = 6.2831853F * static_cast<float>(i % across) / static_cast<float>(across);
    const float v = 6.2831853F * static_cast<float>(i / across) / static_cast<float>(around);
    mesh.positions.emplace_back((3 + std::cos(u)) * std::cos(v), (3 + std::cos(u)) * std::sin(v), std::sin(u));
  }
  for (std::uint32_t y = 0; y < around; ++y) {
    for (std::uint32_t x = 0; x < across; ++x) {
      const auto at = [&](std::uint32_t i, std::uint32_t j) { return (y + j) % around * across + (x + i) % across; };
      for (const std::uint32_t corner : {at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1)})
        mesh.corners.push_back(corner);
    }
  }
  return mesh;
}

/// Every corner has a vertex of its own.
Mesh soup(const Mesh& mesh) {
  Mesh result;
  for (const std::uint32_t corner : mesh.corners) {
    result.corners.push_back(static_cast<std::uint32_t>(result.corners.size()));
    result.positions.push_back(mesh.positions[corner]);
  }
  result.face_offsets.assign(mesh.face_offsets.begin(), mesh.face_offsets.end());
  return result;
}

TEST(Closed, TetrahedronIsAndNotWithoutAFace) {
  EXPECT_EQ(count_edges(tetrahedron()), (EdgeCounts{.edges = 6}));
  EXPECT_TRUE(is_closed(tetrahedron()));
  EXPECT_EQ(count_edges(polygons(4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}})), (EdgeCounts{.edges = 6, .border = 3}));
  EXPECT_FALSE(is_closed(polygons(4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}})));
}

TEST(Closed, AFaceInsideOutIsTold) {
  const Mesh mesh = polygons(4, {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  EXPECT_EQ(count_edges(mesh), (EdgeCounts{.edges = 6, .turned = 3}));
  EXPECT_FALSE(is_closed(mesh));
}

TEST(Closed, ThreeFacesAtAnEdgeAreTooMany) {
  const Mesh mesh = polygons(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  EXPECT_EQ(count_edges(mesh), (EdgeCounts{.edges = 7, .border = 6, .crowded = 1}));
}

TEST(Closed, EqualPositionsAreOneVertex) {
  EXPECT_TRUE(is_closed(soup(tetrahedron())));
  Mesh mesh = soup(tetrahedron());
  for (glm::vec3& each : mesh.positions) {
    if (each.x == 0) each.x = -0.0F;
    break;
  }
  EXPECT_TRUE(is_closed(mesh)) << "-0 is 0";
  mesh.positions[3].z = std::nextafter(mesh.positions[3].z, 9.0F);
  EXPECT_FALSE(is_closed(mesh));
  mesh.positions[3].z = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(is_closed(mesh));
}

TEST(Closed, FacesThatFallTogetherHaveNoEdges) {
  const Mesh mesh =
      polygons(5, {{0, 2, 1}, {0, 1, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 1, 1}, {4, 4, 2}, {2, 3, 2}, {3}, {}});
  EXPECT_EQ(count_edges(mesh), (EdgeCounts{.edges = 6}));
}

TEST(Closed, NothingIsNotClosed) {
  EXPECT_FALSE(is_closed(Mesh()));
  EXPECT_FALSE(is_closed(polygons(3, {})));
  EXPECT_FALSE(is_closed(polygons(3, {{0, 0, 0}})));
}

TEST(Closed, TorusOfAnyOrderAndNumberOfThreads) {
  const Mesh mesh = torus(90, 70);
  const std::size_t edges = mesh.face_count() * 3 / 2;
  EXPECT_EQ(count_edges(mesh), (EdgeCounts{.edges = edges}));
  Mesh shuffled = soup(mesh);
  std::mt19937 random(5);
  for (std::size_t face = shuffled.face_count() - 1; face > 0; --face) {
    const std::size_t other = random() % (face + 1);
    for (std::size_t i = 0; i < 3; ++i) std::swap(shuffled.positions[3 * face + i], shuffled.positions[3 * other + i]);
  }
  for (const int threads : {1, 2, 7}) {
    azulejo::Run run;
    run.threads = threads;
    EXPECT_EQ(count_edges(shuffled, run), (EdgeCounts{.edges = edges}));
  }
  shuffled.corners.resize(shuffled.corners.size() - 3);
  EXPECT_EQ(count_edges(shuffled), (EdgeCounts{.edges = edges, .border = 3}));
}

TEST(Closed, AVertexOfMillionsOfEdgesTakesNoLonger) {
  constexpr std::uint32_t kBlades = 1'000'000;
  Mesh fan;
  for (std::uint32_t i = 0; i <= kBlades; ++i) fan.positions.emplace_back(static_cast<float>(i), 0.5F, 0.0F);
  for (std::uint32_t i = 1; i < kBlades; ++i) {
    for (const std::uint32_t corner : {0U, i, i + 1}) fan.corners.push_back(corner);
  }
  EXPECT_EQ(count_edges(fan).border, kBlades + 1);
}

}  // namespace
}  // namespace azulejo
