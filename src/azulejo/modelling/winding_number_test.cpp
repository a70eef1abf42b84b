#include "azulejo/modelling/winding_number.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "azulejo/core/error.h"
#include "azulejo/modelling/classify_points.h"
#include "azulejo/modelling/primitive.h"
#include "azulejo/modelling/tessellate.h"
#include "azulejo/modelling/winding_number_testing.h"

namespace azulejo {
namespace {

/// The cube from 0 to `size`, two triangles a side, those of the top last.
Mesh cube(float size, const glm::vec3& place = glm::vec3(0)) {
  Mesh mesh;
  for (unsigned i = 0; i < 8; ++i) {
    mesh.positions.push_back(place + size * glm::vec3(i & 1U, i >> 1 & 1U, i >> 2 & 1U));
  }
  mesh.corners = {0, 2, 3, 0, 3, 1, 0, 1, 5, 0, 5, 4, 1, 3, 7, 1, 7, 5,
                  3, 2, 6, 3, 6, 7, 2, 0, 4, 2, 4, 6, 4, 5, 7, 4, 7, 6};
  return mesh;
}

void append(Mesh& mesh, const Mesh& other, bool turned = false) {
  const auto first = static_cast<std::uint32_t>(mesh.vertex_count());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  for (std::size_t c = 0; c < other.corner_count(); c += 3) {
    mesh.corners.push_back(first + other.corners[c]);
    mesh.corners.push_back(first + other.corners[c + (turned ? 2 : 1)]);
    mesh.corners.push_back(first + other.corners[c + (turned ? 1 : 2)]);
  }
}

/// Every triangle with vertices of its own.
Mesh soup_of(const Mesh& mesh) {
  Mesh soup;
  for (const std::uint32_t corner : mesh.corners) {
    soup.corners.push_back(static_cast<std::uint32_t>(soup.positions.size()));
    soup.positions.push_back(mesh.positions[corner]);
  }
  return soup;
}

Mesh triangles(const PrimitiveOptions& options) { return tessellate(primitive(options)); }
Mesh knot() { return triangles({.kind = PrimitiveKind::TorusKnot, .segments = 12, .rings = 90}); }

std::vector<glm::vec3> random_points(std::size_t count, float reach, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-reach, reach);
  std::vector<glm::vec3> points;
  while (points.size() < count) points.emplace_back(place(random), place(random), place(random));
  return points;
}

/// Middles of edges and faces, as near to the surface as floats are, and what is beside vertices.
std::vector<glm::vec3> near_points(const Mesh& mesh) {
  std::vector<glm::vec3> points;
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (std::size_t c = 0; c < mesh.corner_count(); c += 3) {
    const glm::vec3 a = mesh.positions[mesh.corners[c]];
    const glm::vec3 b = mesh.positions[mesh.corners[c + 1]];
    const glm::vec3 d = mesh.positions[mesh.corners[c + 2]];
    points.push_back(0.5F * (a + b));
    points.push_back((a + b + d) / 3.0F);
    points.emplace_back(std::nextafter(a.x, kInfinity), a.y, a.z);
    points.emplace_back(a.x, std::nextafter(a.y, -kInfinity), a.z);
  }
  return points;
}

glm::vec3 turned(const glm::vec3& p) { return {p.y, p.z, p.x}; }
Mesh turned(const Mesh& mesh) {
  Mesh result = mesh.clone();
  for (glm::vec3& p : result.positions) p = turned(p);
  return result;
}

TEST(WindingNumber, OfACubeIsExactEverywhere) {
  for (const float size : {1.0F, 0.1F, 3e30F, 1e-40F}) {
    const WindingNumber number(cube(size), {.points = 1000});
    EXPECT_EQ(number.open_edges(), 0U);
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const std::array<float, 7> places{std::nextafter(0.0F, -1.0F), 0.0F, std::nextafter(0.0F, 1.0F),     size / 2,
                                      std::nextafter(size, 0.0F),  size, std::nextafter(size, kInfinity)};
    for (std::size_t i = 0; i < 7 * 7 * 7; ++i) {
      const std::array<std::size_t, 3> index{i % 7, i / 7 % 7, i / 49};
      const glm::vec3 p(places[index[0]], places[index[1]], places[index[2]]);
      const auto any = [&](auto&& is) { return is(index[0]) || is(index[1]) || is(index[2]); };
      const bool outside = any([](std::size_t k) { return k == 0 || k == 6; });
      const bool border = !outside && any([](std::size_t k) { return k == 1 || k == 5; });
      ASSERT_EQ(number.is_near(p), border) << i << " of size " << size;
      if (border) continue;
      ASSERT_EQ(number(p), outside ? 0 : 1) << i << " of size " << size;
    }
  }
}

TEST(WindingNumber, OfClosedSurfacesIsTheSameAlongAllAxes) {
  const Mesh meshes[] = {knot(), triangles({.kind = PrimitiveKind::Torus}), soup_of(knot())};
  for (const Mesh& mesh : meshes) {
    const WindingNumber number(mesh);
    const WindingNumber in_cells(mesh, {.points = 100000});
    const WindingNumber of_turned(turned(mesh));
    ASSERT_EQ(number.open_edges(), 0U);
    std::vector<glm::vec3> points = near_points(mesh);
    const std::vector<glm::vec3> far = random_points(2000, 3);
    points.insert(points.end(), far.begin(), far.end());
    int inside = 0;
    for (const glm::vec3& p : points) {
      const double winding = number(p);
      ASSERT_TRUE(winding == 0 || winding == 1) << winding;
      ASSERT_EQ(in_cells(p), winding);
      const bool on = number.is_near(p);
      ASSERT_EQ(in_cells.is_near(p), on);
      ASSERT_EQ(of_turned.is_near(turned(p)), on);
      inside += winding == 1 ? 1 : 0;
      if (on) continue;
      ASSERT_EQ(of_turned(turned(p)), winding);
    }
    EXPECT_GT(inside, 500);
    for (const glm::vec3& p : far) ASSERT_NEAR(number(p), winding_by_definition(mesh, glm::dvec3(p)), 1e-9);
  }
}

TEST(WindingNumber, CountsShells) {
  Mesh shells = cube(8);
  append(shells, cube(4, glm::vec3(2)));
  append(shells, cube(1, glm::vec3(1)), true);
  append(shells, cube(2, glm::vec3(20)), true);
  const WindingNumber number(shells, {.points = 5000});
  EXPECT_EQ(number(glm::vec3(7)), 1);
  EXPECT_EQ(number(glm::vec3(4)), 2);
  EXPECT_EQ(number(glm::vec3(1.5F)), 0);
  EXPECT_EQ(number(glm::vec3(21)), -1);
  EXPECT_EQ(number(glm::vec3(15)), 0);
  // Two cubes with the side between them doubled, and one that has only the half of it.
  Mesh neighbors = cube(1);
  append(neighbors, cube(1, glm::vec3(1, 0, 0)));
  EXPECT_EQ(WindingNumber(neighbors).open_edges(), 0U);
  EXPECT_EQ(WindingNumber(neighbors)(glm::vec3(1.5F, 0.5F, 0.25F)), 1);
}

TEST(WindingNumber, OfOpenSurfacesIsTheSumOfAngles) {
  std::mt19937 random(7);
  const Mesh whole = triangles({.kind = PrimitiveKind::UvSphere, .radius = 1, .segments = 80, .rings = 40});
  const std::vector<glm::vec3> points = random_points(300, 1.5F, 5);
  // Missing: a few triangles, a ring, half of it, most of it; then turned at random.
  for (const int kind : {0, 1, 2, 3, 4}) {
    SCOPED_TRACE(kind);
    Mesh mesh = whole.clone();
    mesh.attributes.clear();
    mesh.corners.clear();
    for (std::size_t c = 0; c < whole.corner_count(); c += 3) {
      const glm::vec3& p = whole.positions[whole.corners[c]];
      const bool missing = kind == 0   ? random() % 100 == 0
                           : kind == 1 ? std::abs(p.y - 0.3F) < 0.1F
                           : kind == 2 ? p.x + p.y > 0.1F
                           : kind == 3 ? random() % 4 != 0
                                       : false;
      if (missing) continue;
      const bool flip = kind == 4 && random() % 2 == 0;
      const auto corner = [&](std::size_t i) { return whole.corners[c + i]; };
      mesh.corners.insert(mesh.corners.end(), {corner(0), corner(flip ? 2 : 1), corner(flip ? 1 : 2)});
    }
    const WindingNumber number(mesh, {.points = 300});
    const WindingNumber precise(mesh, {.accuracy = 20});
    EXPECT_GT(number.open_edges(), 0U);
    for (const glm::vec3& p : points) {
      const double truth = winding_by_definition(mesh, glm::dvec3(p));
      ASSERT_NEAR(number(p), truth, 0.02);   // what is left of the series
      ASSERT_NEAR(precise(p), truth, 2e-5);  // a thousandth: it falls as the third power of the accuracy
    }
  }
}

TEST(WindingNumber, JumpsNowhereInAHole) {
  Mesh open = cube(1);
  open.corners.resize(30);  // no top
  const WindingNumber number(open);
  EXPECT_EQ(number.open_edges(), 4U);
  for (int i = 0; i < 9 * 9; ++i) {
    for (const float z : {1.0F, std::nextafter(1.0F, 0.0F), std::nextafter(1.0F, 2.0F)}) {
      const int row = i / 9;
      const glm::vec3 p(0.1F * static_cast<float>(1 + i % 9), 0.125F * static_cast<float>(row), z);
      if (p.y == 0 || p.y == 1) continue;
      ASSERT_NEAR(number(p), 0.5, 0.5);
      ASSERT_NEAR(number(p), winding_by_definition(open, glm::dvec3(p)), 1e-6) << p.x << ", " << p.y;
      EXPECT_FALSE(number.is_near(p));
    }
  }
  EXPECT_NEAR(number({0.5F, 0.5F, 0.01F}), winding_by_definition(open, {0.5, 0.5, 0.01F}), 1e-6);
  // Borders that meet in vertices; a strip that is turned once has one border, and no inside.
  Mesh corners = cube(1);
  corners.corners.erase(corners.corners.begin(), corners.corners.begin() + 3);
  corners.corners.erase(corners.corners.begin() + 12, corners.corners.begin() + 15);
  const Mesh strip = triangles({.kind = PrimitiveKind::Mobius});
  for (const Mesh* mesh : std::array{&std::as_const(corners), &strip}) {
    const WindingNumber of_mesh(*mesh, {.accuracy = 10});
    for (const glm::vec3& p : random_points(200, 1.5F, 3)) {
      ASSERT_NEAR(of_mesh(p), winding_by_definition(*mesh, glm::dvec3(p)), 1e-4);
    }
  }
}

TEST(WindingNumber, OfWhatHasNoSurface) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(WindingNumber(Mesh())({0, 0, 0}), 0);
  EXPECT_FALSE(WindingNumber(Mesh(), {.points = 1000}).is_near({0, 0, 0}, 1e9F));
  Mesh broken = cube(1);
  append(broken, cube(1, glm::vec3(kNan)));
  broken.corners.insert(broken.corners.end(), {0, 0, 1, 2, 2, 2, 0, 1, 0, 3, 8, 0});
  const WindingNumber number(broken);
  EXPECT_EQ(number({0.5F, 0.25F, 0.125F}), 1);
  EXPECT_EQ(number(glm::vec3(kNan)), 0);
  EXPECT_EQ(number({0.5F, std::numeric_limits<float>::infinity(), 0.5F}), 0);
  EXPECT_FALSE(number.is_near(glm::vec3(kNan), 1));
  std::mt19937 random(3);
  for (int round = 0; round < 100; ++round) {  // anything at all
    Mesh soup;
    for (int i = 0; i < 30; ++i) {
      soup.positions.emplace_back(random() % 4, random() % 4, random() % 4);
      for (int k = 0; k < 3; ++k) soup.corners.push_back(static_cast<std::uint32_t>(random() % 30));
    }
    const WindingNumber of_soup(soup, {.accuracy = 30, .points = 50});
    for (const glm::vec3& p : random_points(20, 3)) {
      ASSERT_NEAR(of_soup(p), winding_by_definition(soup, glm::dvec3(p)), 1e-4) << round;
    }
  }
}

Mesh cloud(const std::vector<glm::vec3>& points) {
  Mesh mesh;
  mesh.positions.assign(points.begin(), points.end());
  return mesh;
}

TEST(ClassifyPoints, InAMeshGivesAttributesAndCounts) {
  Mesh points = cloud({{0.5F, 0.5F, 0.25F}, {1, 0.5F, 0.5F}, {2, 0, 0}, {0.5F, 0.5F, std::nanf("")}});
  points.attributes.push_back({"class", Domain::Face, 1, Array<float>()});
  const ClassifiedPoints result = classify_points(cube(1), points, ClassifyInMeshOptions());
  EXPECT_EQ(*result.points.find("class")->get<std::uint32_t>(), (Array<std::uint32_t>{1, 2, 0, 0}));
  const Array<float>& winding = *result.points.find("winding")->get<float>();
  EXPECT_EQ(winding[0], 1);
  EXPECT_EQ(winding[2], 0);
  EXPECT_EQ(winding[3], 0);
  EXPECT_EQ(result.points.attributes.size(), 2U);
  EXPECT_EQ(result.report.json["inside"].number(), 1);
  EXPECT_EQ(result.report.json["outside"].number(), 2);
  EXPECT_EQ(result.report.json["border"].number(), 1);
  EXPECT_EQ(result.report.json["open_edges"].number(), 0);
  EXPECT_THROW(classify_points(cube(1), points, ClassifyInMeshOptions{-1}), Error);

  Mesh inside_out;
  append(inside_out, cube(1), true);
  const ClassifiedPoints same = classify_points(inside_out, points, ClassifyInMeshOptions());
  EXPECT_EQ(same.points.find("winding")->get<float>()->front(), -1);
  EXPECT_EQ(same.points.find("class")->get<std::uint32_t>()->front(), 1U);
}

TEST(ClassifyPoints, BorderOfAMeshHasAWidth) {
  const std::vector<glm::vec3> points = random_points(20000, 2, 9);
  const ClassifiedPoints result = classify_points(cube(1), cloud(points), ClassifyInMeshOptions{.border = 0.25F});
  const Array<std::uint32_t>& classes = *result.points.find("class")->get<std::uint32_t>();
  int borders = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 from_middle = glm::abs(glm::dvec3(points[i]) - 0.5);
    const glm::dvec3 out = glm::max(from_middle - 0.5, 0.0);
    const double within = 0.5 - std::max({from_middle.x, from_middle.y, from_middle.z});
    const double distance = within >= 0 ? within : glm::length(out);
    const std::uint32_t truth = distance <= 0.25 ? 2 : within > 0 ? 1 : 0;
    ASSERT_EQ(classes[i], truth) << i;
    borders += truth == 2;
  }
  EXPECT_GT(borders, 500);
}

TEST(ClassifyPoints, InAMeshIsTheSameForAnyNumberOfThreads) {
  Mesh open = knot();
  open.corners.resize(open.corner_count() - 300);
  const Mesh points = cloud(random_points(20000, 2));
  azulejo::Run one;
  one.threads = 1;
  azulejo::Run many;
  many.threads = 5;
  const ClassifiedPoints a = classify_points(open, points, ClassifyInMeshOptions(), one);
  const ClassifiedPoints b = classify_points(open, points, ClassifyInMeshOptions(), many);
  EXPECT_EQ(*a.points.find("winding")->get<float>(), *b.points.find("winding")->get<float>());
  EXPECT_EQ(*a.points.find("class")->get<std::uint32_t>(), *b.points.find("class")->get<std::uint32_t>());
}

}  // namespace
}  // namespace azulejo
