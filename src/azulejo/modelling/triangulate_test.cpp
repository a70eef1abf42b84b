#include "azulejo/modelling/triangulate.h"

#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <set>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace azulejo {
namespace {

using Outline = std::vector<glm::vec2>;

/// A mesh of one face in the plane z = 0.
Mesh face_of(const Outline& outline) {
  Mesh mesh;
  for (const glm::vec2& point : outline) mesh.positions.emplace_back(point.x, point.y, 0.0F);
  for (std::size_t i = 0; i < outline.size(); ++i) mesh.corners.push_back(static_cast<std::uint32_t>(i));
  mesh.face_offsets = {0, static_cast<std::uint32_t>(outline.size())};
  return mesh;
}

glm::dvec3 area_vector(const Mesh& mesh, const std::uint32_t* corners) {
  const glm::dvec3 a = mesh.positions[mesh.corners[corners[0]]];
  const glm::dvec3 b = mesh.positions[mesh.corners[corners[1]]];
  const glm::dvec3 c = mesh.positions[mesh.corners[corners[2]]];
  return 0.5 * glm::cross(b - a, c - a);
}

double outline_area(const Outline& outline) {
  double area = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec2 a = outline[i];
    const glm::dvec2 b = outline[(i + 1) % outline.size()];
    area += 0.5 * (a.x * b.y - a.y * b.x);
  }
  return area;
}

/// Triangles that add up to an outline's area, none of them turned over, cover it exactly once.
void expect_covered_once(const Outline& outline, bool all_have_area = true) {
  const Mesh mesh = face_of(outline);
  const Triangulation result = triangulate(mesh);
  ASSERT_EQ(result.face.size(), outline.size() - 2);
  ASSERT_EQ(result.corners.size(), 3 * result.face.size());
  double sum = 0;
  for (std::size_t t = 0; t < result.face.size(); ++t) {
    const double area = area_vector(mesh, &result.corners[3 * t]).z;
    if (all_have_area) {
      ASSERT_GT(area, 0) << "triangle " << t;
    } else {
      ASSERT_GE(area, 0) << "triangle " << t;
    }
    sum += area;
  }
  EXPECT_NEAR(sum, outline_area(outline), 1e-9 * outline_area(outline));
}

Outline random_star(std::mt19937& random, std::size_t points) {
  std::uniform_real_distribution<float> radius(0.1F, 1.0F);
  Outline outline;
  for (std::size_t i = 0; i < points; ++i) {
    const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(points);
    const float r = radius(random);
    outline.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  return outline;
}

bool cross(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d) {
  const auto side = [](const glm::dvec2& p, const glm::dvec2& q, const glm::dvec2& r) {
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x) > 0;
  };
  return side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b);
}

/// Random points in a random order, each crossing undone by turning the path between.
Outline random_simple(std::mt19937& random, std::size_t points) {
  std::uniform_real_distribution<float> place(0, 1);
  Outline outline;
  for (std::size_t i = 0; i < points; ++i) outline.emplace_back(place(random), place(random));
  for (bool crossed = true; crossed;) {
    crossed = false;
    for (std::size_t i = 0; i + 2 < points; ++i) {
      for (std::size_t j = i + 2; j < points; ++j) {
        if (i == 0 && j + 1 == points) continue;
        if (!cross(outline[i], outline[i + 1], outline[j], outline[(j + 1) % points])) continue;
        std::reverse(outline.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                     outline.begin() + static_cast<std::ptrdiff_t>(j) + 1);
        crossed = true;
      }
    }
  }
  if (outline_area(outline) < 0) std::reverse(outline.begin(), outline.end());
  return outline;
}

TEST(Triangulate, KeepsTriangles) {
  Mesh mesh;
  mesh.positions.resize(5, glm::vec3(0));
  mesh.corners = {0, 1, 2, 2, 3, 4};
  const Triangulation result = triangulate(mesh);
  EXPECT_EQ(result.corners, (Array<std::uint32_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(result.face, (Array<std::uint32_t>{0, 1}));
}

TEST(Triangulate, CutsAQuadAlongItsShorterDiagonalAndAConcaveOneInside) {
  EXPECT_EQ(triangulate(face_of({{0, 0}, {3, 0}, {4, 1}, {0, 1}})).corners, (Array<std::uint32_t>{0, 1, 3, 1, 2, 3}));
  EXPECT_EQ(triangulate(face_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}})).corners, (Array<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  // An arrow head: the diagonal through its notch is the only one, though the other is shorter for the first.
  for (const float notch : {0.1F, 2.9F}) {
    expect_covered_once({{0, notch}, {1, 0}, {0, 3}, {-1, 0}});
    expect_covered_once({{1, 0}, {0, 3}, {-1, 0}, {0, notch}});
  }
  // A corner in the middle of a side: the diagonal from there is the one that makes two triangles.
  expect_covered_once({{0, 0}, {1, 0}, {2, 0}, {1, 2}});
}

TEST(Triangulate, CoversRandomSimplePolygonsOnce) {
  for (unsigned seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    expect_covered_once(random_simple(random, 4 + seed % 45));
    expect_covered_once(random_star(random, 5 + seed));
  }
}

TEST(Triangulate, WorksInAnyPlaneAndForEachFaceAlone) {
  std::mt19937 random(3);
  const Outline outline = random_simple(random, 30);
  const double area = outline_area(outline);
  std::normal_distribution<float> axis;
  Mesh mesh;
  mesh.face_offsets = {0};
  std::vector<glm::dvec3> normals;
  for (int i = 0; i < 40; ++i) {
    const glm::vec3 u = glm::normalize(glm::vec3(axis(random), axis(random), axis(random)));
    const glm::vec3 v = glm::normalize(glm::cross(u, glm::vec3(axis(random), axis(random), axis(random))));
    normals.emplace_back(glm::cross(u, v));
    for (const glm::vec2& point : outline) {
      mesh.corners.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      mesh.positions.push_back(point.x * u + point.y * v);
    }
    mesh.face_offsets.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  }
  const Triangulation result = triangulate(mesh);
  ASSERT_EQ(result.face.size(), 40U * 28);
  std::vector<double> sums(40, 0);
  for (std::size_t t = 0; t < result.face.size(); ++t) {
    const std::uint32_t face = result.face[t];
    const double along = glm::dot(area_vector(mesh, &result.corners[3 * t]), normals[face]);
    EXPECT_GT(along, -1e-7);  // positions are rounded to floats: they leave the plane by 6e-8
    sums[face] += along;
    for (int i = 0; i < 3; ++i) {
      ASSERT_GE(result.corners[3 * t + static_cast<std::size_t>(i)], mesh.face_begin(face));
      ASSERT_LT(result.corners[3 * t + static_cast<std::size_t>(i)], mesh.face_end(face));
    }
  }
  for (const double sum : sums) EXPECT_NEAR(sum, area, 1e-6);
}

TEST(Triangulate, CoversAFaceWithABridgedHole) {
  // A square ring: outside counter-clockwise, along the bridge, the hole clockwise, and back.
  expect_covered_once({{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0}, {1, 1}, {1, 2}, {2, 2}, {2, 1}, {1, 1}});
  // A round one, whose bridge runs along the axis through further corners' heights.
  Outline ring;
  for (int i = 0; i <= 64; ++i)
    ring.emplace_back(std::cos(0.0981748F * static_cast<float>(i % 64)),
                      std::sin(0.0981748F * static_cast<float>(i % 64)));
  for (int i = 64; i >= 0; --i)
    ring.emplace_back(0.9F * std::cos(0.0981748F * static_cast<float>(i % 64)),
                      0.9F * std::sin(0.0981748F * static_cast<float>(i % 64)));
  expect_covered_once(ring);
}

TEST(Triangulate, CoversWhatHasCornersAlongItsSidesOrTwice) {
  expect_covered_once({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}});
  expect_covered_once({{0, 0}, {1, 0}, {2, 0}, {1, 2}, {0.5F, 1}});
  Outline doubled;
  for (const glm::vec2& point : Outline{{0, 0}, {2, 0}, {2, 2}, {1, 1}, {0, 2}})
    doubled.insert(doubled.end(), 3, point);
  expect_covered_once(doubled, false);
  // A whisker: out and back along the same line.
  expect_covered_once({{0, 0}, {2, 0}, {2, 1}, {3, 1}, {2, 1}, {2, 2}, {0, 2}}, false);
}

TEST(Triangulate, CoversLargeCombsAndSpiralsInTime) {
  Outline comb;
  const int teeth = 20000;
  for (int i = 0; i < teeth; ++i) {
    comb.emplace_back(static_cast<float>(i), 0.0F);
    comb.emplace_back(static_cast<float>(i) + 0.5F, 100.0F + static_cast<float>(i % 7));
  }
  comb.emplace_back(static_cast<float>(teeth), 200.0F);
  comb.emplace_back(0.0F, 200.0F);
  Outline spiral;
  for (int side : {1, -1}) {
    for (int i = 0; i < 5000; ++i) {
      const float t = 0.02F * static_cast<float>(side > 0 ? i : 4999 - i);
      const float r = 1 + t + (side > 0 ? 2.0F : 0.0F);
      spiral.emplace_back(r * std::cos(t), r * std::sin(t));
    }
  }
  const auto start = std::chrono::steady_clock::now();
  expect_covered_once(comb);
  expect_covered_once(spiral);
  std::mt19937 random(5);
  expect_covered_once(random_star(random, 100000));
  // Measured 0.15 s; a sanitizer's build is slower, what is quadratic is slower still.
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 20);
}

TEST(Triangulate, GivesTheNumberOfTrianglesForAnything) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  std::vector<Outline> outlines = {
      Outline(936, glm::vec2(1, 2)),
      Outline(5, glm::vec2(nan, nan)),
      {{0, 0}, {1, 0}, {infinity, 1}, {0, 1}, {0, 0.5F}},
      {{0, 0}, {1, 1}, {2, 2}, {3, 3}, {4, 4}, {1.5F, 1.5F}},
      {{0, 0}, {1, 1}, {1, 0}, {0, 1}, {0, 0.5F}, {2, 0.5F}},
      {{0, 0}, {1, 1}, {1, 0}, {0, 1}},
      {{3e38F, 0}, {0, 3e38F}, {-3e38F, 0}, {0, -3e38F}, {1e38F, -1e38F}},
      {{0, 0}, {0, nan}, {1, 1}, {0, 1}},
  };
  std::mt19937 random(11);
  for (std::size_t n : {5U, 9U, 300U, 3000U}) {
    Outline crossing;
    Outline lattice;
    for (std::size_t i = 0; i < n; ++i) {
      crossing.emplace_back(static_cast<float>(random() % 100000), static_cast<float>(random() % 100000));
      lattice.emplace_back(static_cast<float>(random() % 4), static_cast<float>(random() % 4));
    }
    outlines.push_back(crossing);
    outlines.push_back(lattice);
  }
  Outline line;
  for (int i = 0; i < 50000; ++i) line.emplace_back(static_cast<float>((i * 7919) % 50000), 0.0F);
  line.emplace_back(0.0F, 1.0F);
  outlines.push_back(line);
  for (std::size_t o = 0; o < outlines.size(); ++o) {
    SCOPED_TRACE(o);
    const Mesh mesh = face_of(outlines[o]);
    const Triangulation result = triangulate(mesh);
    ASSERT_EQ(result.face.size(), outlines[o].size() - 2);
    std::vector<std::uint8_t> used(outlines[o].size(), 0);
    for (const std::uint32_t corner : result.corners) {
      ASSERT_LT(corner, outlines[o].size());
      used[corner] = 1;
    }
    for (const std::uint8_t each : used) ASSERT_EQ(each, 1);
  }
}

TEST(Triangulate, TakesFacesOfEverySizeInOneMesh) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-1, 0.5F, 0}};
  mesh.corners = {0, 0, 1, 0, 1, 2, 0, 1, 2, 3, 0, 1, 2, 3, 4};
  mesh.face_offsets = {0, 0, 1, 3, 6, 10, 15};
  mesh.check("mesh");
  const Triangulation result = triangulate(mesh);
  EXPECT_EQ(result.face, (Array<std::uint32_t>{3, 4, 4, 5, 5, 5}));
  EXPECT_EQ(result.face.size(), mesh.triangle_count());
  EXPECT_EQ(triangulate(Mesh()).face.size(), 0U);
}

TEST(Triangulate, GivesTheSameForAnyNumberOfThreads) {
  std::mt19937 random(17);
  Mesh mesh;
  mesh.face_offsets = {0};
  for (int f = 0; f < 10000; ++f) {
    const std::size_t n = 3 + random() % 9;
    for (const glm::vec2& point : random_star(random, n)) {
      mesh.corners.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      mesh.positions.emplace_back(point.x, point.y, 0.0F);
    }
    mesh.face_offsets.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  }
  azulejo::Run one;
  one.threads = 1;
  azulejo::Run seven;
  seven.threads = 7;
  const Triangulation a = triangulate(mesh, one);
  const Triangulation b = triangulate(mesh, seven);
  EXPECT_EQ(a.corners, b.corners);
  EXPECT_EQ(a.face, b.face);
}

}  // namespace
}  // namespace azulejo
