#include "azulejo/modelling/convex_hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <vector>

#include "azulejo/core/error.h"
#include "azulejo/math/predicates.h"
#include "azulejo/modelling/closed.h"
#include "azulejo/modelling/primitive.h"

namespace azulejo {
namespace {

using Place = std::array<float, 3>;
using Places = std::set<Place>;

constexpr ConvexHullOptions kPolygons{HullFaces::Polygons};

Place place_of(const glm::vec3& p) { return {p.x + 0.0F, p.y + 0.0F, p.z + 0.0F}; }  // −0 is 0
glm::dvec3 point_of(const Place& p) { return {p[0], p[1], p[2]}; }

Mesh cloud(std::vector<glm::vec3> points) {
  Mesh mesh;
  mesh.positions.assign(points.begin(), points.end());
  return mesh;
}

Places vertices_of(const Mesh& mesh) {
  Places places;
  for (const glm::vec3& p : mesh.positions) places.insert(place_of(p));
  return places;
}

std::multiset<Places> faces_of(const Mesh& mesh) {
  std::multiset<Places> faces;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    Places places;
    for (std::size_t c = mesh.face_begin(f); c < mesh.face_end(f); ++c) {
      places.insert(place_of(mesh.positions[mesh.corners[c]]));
    }
    faces.insert(places);
  }
  return faces;
}

/// The faces by their corners, from the definition: a plane through three points is one where all others are on one side
/// of it; a point is a corner where nothing else is in all the planes that it is in.
std::multiset<Places> faces_by_brute_force(const Mesh& mesh) {
  const Places all = vertices_of(mesh);
  const std::vector<Place> points(all.begin(), all.end());
  std::set<Places> planes;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      for (std::size_t k = j + 1; k < points.size(); ++k) {
        Places plane;
        bool above = false;
        bool below = false;
        for (const Place& p : points) {
          const double side = orient3d(point_of(points[i]), point_of(points[j]), point_of(points[k]), point_of(p));
          above = above || side > 0;
          below = below || side < 0;
          if (side == 0) plane.insert(p);
        }
        if (above != below) planes.insert(plane);
      }
    }
  }
  Places corners;
  for (const Place& p : points) {
    Places common = all;
    for (const Places& plane : planes) {
      if (plane.count(p) == 0) continue;
      std::erase_if(common, [&](const Place& q) { return plane.count(q) == 0; });
    }
    if (common.size() == 1) corners.insert(p);
  }
  std::multiset<Places> faces;
  for (Places plane : planes) {
    std::erase_if(plane, [&](const Place& p) { return corners.count(p) == 0; });
    faces.insert(plane);
  }
  return faces;
}

/// What holds for every hull of triangles: nothing is outside, it is a closed ball, and its corners are corners.
void check_solid(const Mesh& source, const Mesh& hull) {
  hull.check("hull");
  const EdgeCounts edges = count_edges(hull);
  EXPECT_TRUE(edges.closed());
  EXPECT_EQ(static_cast<std::int64_t>(hull.vertex_count() + hull.face_count()) - static_cast<std::int64_t>(edges.edges),
            2);
  const Places given = vertices_of(source);
  for (const Place& place : vertices_of(hull)) ASSERT_EQ(given.count(place), 1U);
  std::vector<glm::dvec3> points;
  for (const glm::vec3& p : source.positions) {
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) points.emplace_back(p);
  }
  for (std::size_t c = 0; c < hull.corner_count(); c += 3) {
    const glm::dvec3 a(hull.positions[hull.corners[c]]);
    const glm::dvec3 b(hull.positions[hull.corners[c + 1]]);
    const glm::dvec3 d(hull.positions[hull.corners[c + 2]]);
    for (const glm::dvec3& p : points) ASSERT_GE(orient3d(a, b, d, p), 0) << p.x << ", " << p.y << ", " << p.z;
  }
}

void check_everything(const Mesh& source) {
  const Mesh hull = convex_hull(source);
  check_solid(source, hull);
  const Mesh polygons = convex_hull(source, kPolygons);
  EXPECT_EQ(vertices_of(polygons), vertices_of(hull));
  // No polygon has a corner in the middle of a side, or three corners of another's plane.
  for (std::size_t f = 0; f < polygons.face_count(); ++f) {
    const std::size_t count = polygons.face_end(f) - polygons.face_begin(f);
    const auto corner = [&](std::size_t i) {
      return glm::dvec3(polygons.positions[polygons.corners[polygons.face_begin(f) + i % count]]);
    };
    for (std::size_t i = 0; i < count; ++i) {
      const glm::dvec3 a = corner(i);
      const glm::dvec3 b = corner(i + 1);
      const glm::dvec3 c = corner(i + 2);
      EXPECT_TRUE(orient2d({a.x, a.y}, {b.x, b.y}, {c.x, c.y}) != 0 ||
                  orient2d({a.y, a.z}, {b.y, b.z}, {c.y, c.z}) != 0 ||
                  orient2d({a.z, a.x}, {b.z, b.x}, {c.z, c.x}) != 0);
    }
  }
  // The hull of a hull is the same, whatever order the points come in.
  EXPECT_EQ(faces_of(convex_hull(hull, kPolygons)), faces_of(polygons));
  Mesh shuffled = source.clone();
  std::shuffle(shuffled.positions.begin(), shuffled.positions.end(), std::mt19937(5));
  const Mesh again = convex_hull(shuffled);
  EXPECT_EQ(vertices_of(again), vertices_of(hull));
  EXPECT_EQ(faces_of(again), faces_of(hull));
}

TEST(ConvexHull, AgreesWithBruteForceExactly) {
  int flat = 0;
  for (unsigned seed = 0; seed < 600; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const unsigned size = 2 + seed % 4;
    const float unit = seed % 3 == 0 ? 0.1F : seed % 3 == 1 ? 1.0F : 1e6F;
    const auto number = [&] { return (static_cast<float>(random() % size) - 1) * unit; };
    std::vector<glm::vec3> points;
    for (unsigned count = 4 + seed % 12; count-- > 0;) points.emplace_back(number(), number(), number());
    const Mesh source = cloud(points);
    const Mesh hull = convex_hull(source, kPolygons);
    const std::multiset<Places> faces = faces_by_brute_force(source);
    if (faces.empty()) {  // all in a plane
      ++flat;
      EXPECT_LE(hull.face_count(), 1U);
      continue;
    }
    EXPECT_EQ(faces_of(hull), faces);
    check_everything(source);
  }
  EXPECT_GT(flat, 10);
  EXPECT_LT(flat, 200);
}

TEST(ConvexHull, OfGridsAndSolids) {
  std::vector<glm::vec3> grid;
  for (int i = 0; i < 12 * 12 * 12; ++i) grid.push_back(0.1F * glm::vec3(i % 12, i / 12 % 12, i / 144));
  const Mesh cube = cloud(grid);
  check_everything(cube);
  EXPECT_EQ(convex_hull(cube).face_count(), 12U);
  EXPECT_EQ(convex_hull(cube, kPolygons).face_count(), 6U);
  EXPECT_EQ(convex_hull(cube).vertex_count(), 8U);
  check_everything(primitive({.kind = PrimitiveKind::Teapot}));
  check_everything(primitive({.kind = PrimitiveKind::Torus}));
  check_everything(primitive({.kind = PrimitiveKind::Cylinder}));
}

TEST(ConvexHull, OfPointsEverywhere) {
  std::mt19937 random(17);
  std::normal_distribution<float> normal;
  const auto direction = [&] { return glm::normalize(glm::vec3(normal(random), normal(random), normal(random))); };
  const auto made = [&](std::size_t count, auto&& point) {
    std::vector<glm::vec3> points;
    while (points.size() < count) points.push_back(point());
    return cloud(points);
  };
  check_everything(made(1500, direction));
  check_everything(made(20000, [&] { return direction() * std::cbrt(0.5F + 0.1F * normal(random)); }));
  check_everything(made(1000, [&] { return direction() + glm::vec3(1e6F, -2e6F, 3e5F); }));     // 16 steps a unit
  check_everything(made(1000, [&] { return direction() * glm::vec3(1e19F, 1e38F, 1e-38F); }));  // subnormal, too
  check_everything(made(6000, [&] { return direction() * glm::vec3(1, 1e-6F, 1); }));
  check_everything(made(6000, [&] { return direction() * glm::vec3(1, 1e-6F, 1e-5F); }));
  check_everything(made(6000, [&] {  // a slab across all axes, no thicker than rounding
    const glm::vec3 p = direction();
    return glm::vec3(p.x, p.y, p.x + p.y + 1e-7F * p.z);
  }));
  check_everything(
      made(5000, [&] { return glm::vec3(1, 2, 3) + std::exp(-std::abs(10 * normal(random))) * direction(); }));
  // Corners of a cube that are near each other, far from another one: the middle is near the surface.
  check_everything(made(5000, [&] { return random() % 1000 == 0 ? direction() : glm::vec3(5) + 1e-5F * direction(); }));
}

TEST(ConvexHull, OfCurves) {
  std::vector<glm::vec3> moment;
  for (int i = 0; i < 400; ++i) {
    const float t = static_cast<float>(i) / 400;
    moment.emplace_back(t, t * t, t * t * t);
  }
  check_everything(cloud(moment));
  std::vector<glm::vec3> circles;  // around each other: every point of one is joined to many of the other
  for (int i = 0; i < 300; ++i) {
    const float angle = static_cast<float>(i) * 0.01F;
    circles.emplace_back(std::cos(angle), std::sin(angle), 0);
    circles.emplace_back(0, std::cos(angle) + 1, std::sin(angle));
  }
  check_everything(cloud(circles));
  std::vector<glm::vec3> cone;
  for (int i = 0; i < 1000; ++i) {
    const float angle = static_cast<float>(i) * 2 * std::numbers::pi_v<float> / 1000;
    cone.emplace_back(std::cos(angle), std::sin(angle), 0);
    cone.emplace_back(1e-3F * std::cos(angle), 1e-3F * std::sin(angle), 5 - 1e-4F * static_cast<float>(i));
  }
  check_everything(cloud(cone));
}

TEST(ConvexHull, OfWhatIsFlat) {
  EXPECT_EQ(convex_hull(Mesh()).vertex_count(), 0U);

  Mesh points = cloud({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}});
  Mesh hull = convex_hull(points);
  EXPECT_EQ(hull.vertex_count(), 1U);
  EXPECT_EQ(hull.face_count() + hull.lines.size(), 0U);

  hull = convex_hull(cloud({{1, 1, 1}, {3, 3, 3}, {2, 2, 2}, {3, 3, 3}, {1, 1, 1}}));
  EXPECT_EQ(vertices_of(hull), (Places{{1, 1, 1}, {3, 3, 3}}));
  EXPECT_EQ(hull.lines, (Array<std::uint32_t>{0, 1}));

  // In planes across no axis or one, with points in the middle and on sides.
  for (const glm::vec2 slope : {glm::vec2(-2, -4), glm::vec2(-2, 0)}) {
    std::vector<glm::vec3> square;
    for (int i = 0; i < 25; ++i) {
      const auto u = static_cast<float>(i % 5) * (slope.y == 0 ? 0.1F : 1.0F);
      const int row = i / 5;
      const auto v = static_cast<float>(row);
      square.emplace_back(u, v, slope.y == 0 ? -2 * u : slope.x * u + slope.y * v);
    }
    hull = convex_hull(cloud(square), kPolygons);
    ASSERT_EQ(hull.face_count(), 1U);
    EXPECT_EQ(hull.vertex_count(), 4U);
    const auto corner = [&](std::size_t c) { return hull.positions[hull.corners[c]]; };
    const glm::vec3 normal = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
    const glm::vec3 size = glm::abs(normal);
    EXPECT_GT(size.x > size.y && size.x > size.z ? normal.x : size.y > size.z ? normal.y : normal.z, 0);
    const Mesh triangles = convex_hull(cloud(square));
    EXPECT_EQ(triangles.face_count(), 2U);
    EXPECT_TRUE(triangles.all_triangles());
  }

  for (const glm::vec3 across : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)}) {
    std::vector<glm::vec3> ring;
    for (int i = 0; i < 100; ++i) {
      const auto u = static_cast<float>(i % 10);
      const int row = i / 10;
      const auto v = static_cast<float>(row);
      ring.push_back(glm::vec3(across.x == 1 ? 7 : u,
                               across.y == 1   ? 7
                               : across.x == 1 ? u
                                               : v,
                               across.z == 1 ? 7 : v));
    }
    const Mesh face = convex_hull(cloud(ring), kPolygons);
    ASSERT_EQ(face.corner_count(), 4U);
    const auto at = [&](std::size_t c) { return face.positions[face.corners[c]]; };
    EXPECT_EQ(glm::cross(at(1) - at(0), at(2) - at(1)), 81.0F * across);
  }
}

TEST(ConvexHull, LeavesOutWhatIsNotFinite) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const Mesh source = cloud({{kNan, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {9, kInfinity, 9}});
  std::vector<std::string> warnings;
  azulejo::Run run;
  run.warn = [&](const std::string& text) { warnings.push_back(text); };
  const Mesh hull = convex_hull(source, {}, run);
  EXPECT_EQ(hull.vertex_count(), 4U);
  check_solid(source, hull);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("2 of 6 vertices"), std::string::npos) << warnings[0];
}

TEST(ConvexHull, KeepsVerticesInTheirOrderWithTheirAttributes) {
  Mesh source = cloud({{0, 0, 0}, {0.1F, 0.1F, 0.1F}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-0.0F, 0, 0}});
  source.name = "part";
  source.space.metres_per_unit = 0.001F;
  source.attributes.push_back({"number", Domain::Vertex, 1, Array<std::uint32_t>{0, 1, 2, 3, 4, 5, 6}});
  source.attributes.push_back({"NORMAL", Domain::Vertex, 3, Array<float>(21)});
  const Mesh hull = convex_hull(source);
  ASSERT_EQ(hull.attributes.size(), 1U);
  EXPECT_EQ(*hull.attributes[0].get<std::uint32_t>(), (Array<std::uint32_t>{0, 2, 4, 5}));
  EXPECT_EQ(hull.name, "part");
  EXPECT_EQ(hull.space, source.space);
}

TEST(ConvexHull, SameForAnyNumberOfThreads) {
  std::mt19937 random(23);
  std::uniform_real_distribution<float> number(-1, 1);
  std::vector<glm::vec3> points;
  for (int i = 0; i < 100000; ++i) points.emplace_back(number(random), number(random), number(random));
  const Mesh source = cloud(points);
  azulejo::Run one;
  one.threads = 1;
  azulejo::Run many;
  many.threads = 5;
  const Mesh a = convex_hull(source, {}, one);
  const Mesh b = convex_hull(source, {}, many);
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.corners, b.corners);
  check_solid(source, a);
}

std::vector<glm::vec2> points_of(const Drawing& drawing) {
  std::vector<glm::vec2> points;
  for (const DrawingPath& path : drawing.paths) {
    const PathView view = drawing.view(path);
    points.insert(points.end(), view.points.begin(), view.points.end());
  }
  return points;
}

TEST(ConvexHull, OfADrawingIsOnePath) {
  Drawing drawing;
  drawing.width = 30;
  DrawingStyle style;
  style.fill = Paint({1, 0, 0, 1});
  const std::uint32_t red = drawing.add_style(style);
  drawing.add_path(Path().move_to({0, 0}).line_to({4, 1}).line_to({8, 0}).line_to({8, 8}).line_to({4, 4}).close(), red);
  drawing.add_path(Path().move_to({0, 8}).line_to({0, 4}).line_to({2, 2}), drawing.add_style(DrawingStyle()));
  const Drawing hull = convex_hull(drawing);
  ASSERT_EQ(hull.paths.size(), 1U);
  EXPECT_EQ(points_of(hull), (std::vector<glm::vec2>{{0, 0}, {8, 0}, {8, 8}, {0, 8}}));
  EXPECT_EQ(hull.width, 30);
  EXPECT_EQ(hull.styles[hull.paths[0].style].fill->color, glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(points_of(convex_hull(hull)), points_of(hull));

  EXPECT_TRUE(convex_hull(Drawing()).paths.empty());
  Drawing line;
  line.add_path(Path().move_to({1, 1}).line_to({3, 3}).line_to({2, 2}), line.add_style(DrawingStyle()));
  EXPECT_EQ(points_of(convex_hull(line)), (std::vector<glm::vec2>{{1, 1}, {3, 3}}));
  EXPECT_THROW(convex_hull(drawing, DrawingHullOptions{0}), Error);
}

}  // namespace
}  // namespace azulejo
