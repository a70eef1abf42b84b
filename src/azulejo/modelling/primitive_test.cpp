#include "azulejo/modelling/primitive.h"

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "azulejo/core/error.h"
#include "azulejo/modelling/closed.h"
#include "azulejo/modelling/normals.h"
#include "azulejo/modelling/scene_testing.h"
#include "azulejo/modelling/triangulate.h"

namespace azulejo {
namespace {

constexpr double kPi = std::numbers::pi;
using Kind = PrimitiveKind;

struct Measure {
  double area = 0;
  double volume = 0;
  double smallest = 1e30;  ///< triangle
};

Measure measure(const Mesh& mesh) {
  const Triangulation triangles = triangulate(mesh);
  Measure result;
  for (std::size_t t = 0; t < triangles.face.size(); ++t) {
    glm::dvec3 p[3];
    for (std::size_t i = 0; i < 3; ++i) p[i] = mesh.positions[mesh.corners[triangles.corners[3 * t + i]]];
    const double area = 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
    result.area += area;
    result.volume += glm::dot(p[0], glm::cross(p[1], p[2])) / 6;
    result.smallest = std::min(result.smallest, area);
  }
  return result;
}

struct Topology {
  long euler = 0;
  std::size_t open_edges = 0;  ///< without a partner that runs the other way
  std::size_t doubled_edges = 0;
};

Topology topology(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const std::size_t begin = mesh.face_begin(f);
    const std::size_t end = mesh.face_end(f);
    for (std::size_t c = begin; c < end; ++c) ++edges[{mesh.corners[c], mesh.corners[c + 1 == end ? begin : c + 1]}];
  }
  Topology result;
  std::size_t half = 0;
  for (const auto& [edge, count] : edges) {
    half += 1;
    if (count > 1) ++result.doubled_edges;
    if (edges.count({edge.second, edge.first}) == 0) ++result.open_edges;
  }
  const std::size_t full = (half + result.open_edges) / 2;
  result.euler =
      static_cast<long>(mesh.vertex_count()) - static_cast<long>(full) + static_cast<long>(mesh.face_count());
  return result;
}

/// Surfaces with a border, or one side: cut open.
bool is_open(Kind kind) {
  switch (kind) {
    case Kind::Plane:
    case Kind::Teapot:
    case Kind::Disk:
    case Kind::Mobius:
    case Kind::KleinBottle:
    case Kind::Helicoid:
    case Kind::Catenoid:
    case Kind::Enneper: return true;
    default: return false;
  }
}

/// Eight points of a ring that goes up and down.
std::vector<float> wavy_ring() {
  std::vector<float> points;
  for (int i = 0; i < 8; ++i) {
    const double angle = 2 * kPi * i / 8;
    for (const double x : {1.5 * std::cos(angle), i % 2 == 0 ? 0.2 : -0.2, -1.5 * std::sin(angle)}) {
      points.push_back(static_cast<float>(x));
    }
  }
  return points;
}

std::vector<PrimitiveOptions> examples() {
  std::vector<PrimitiveOptions> list;
  for (std::size_t kind = 0; kind < enum_names(Kind{}).size(); ++kind) {
    for (const bool smooth : {true, false}) list.push_back({.kind = static_cast<Kind>(kind), .smooth = smooth});
  }
  list.push_back({.kind = Kind::UvSphere, .segments = 3, .rings = 2});
  list.push_back({.kind = Kind::Torus, .segments = 3, .rings = 3});
  list.push_back({.kind = Kind::Cylinder, .segments = 3, .rings = 5});
  list.push_back({.kind = Kind::Cone, .segments = 3, .rings = 5});
  list.push_back({.kind = Kind::Plane, .segments = 3, .rings = 2});
  list.push_back({.kind = Kind::IcoSphere, .subdivisions = 0});
  list.push_back({.kind = Kind::Capsule, .segments = 3, .rings = 1});
  list.push_back({.kind = Kind::CubeSphere, .segments = 1});
  list.push_back({.kind = Kind::CubeSphere, .segments = 2});
  list.push_back({.kind = Kind::Tube, .tube_radius = 0.2F, .points = wavy_ring(), .closed = true});
  list.push_back({.kind = Kind::Tube, .segments = 3, .points = {0, 0, 0, 0, 3, 0}});
  list.push_back({.kind = Kind::TorusKnot, .around = 1, .through = 1});
  list.push_back({.kind = Kind::Teapot, .tolerance = 0.01F});
  for (const int n : {2, 3, 7, 20}) list.push_back({.kind = Kind::Teapot, .segments = n});
  return list;
}

TEST(Primitive, IsValidAndHasUnitNormalsTextureCoordinatesAndNoFacesWithoutArea) {
  for (const PrimitiveOptions& options : examples()) {
    const Mesh mesh = primitive(options);
    SCOPED_TRACE(mesh.name);
    mesh.check("primitive");
    EXPECT_GT(measure(mesh).smallest, 1e-7);
    EXPECT_EQ(topology(mesh).doubled_edges, 0U);
    const Attribute* const normal = mesh.find("NORMAL");
    ASSERT_NE(normal, nullptr);
    for (std::size_t e = 0; e < normal->size(); ++e) {
      EXPECT_NEAR(glm::length(testing::vector_at(*normal, e)), 1, 1e-5F) << e;
    }
    const Attribute* const uv = mesh.find("TEXCOORD_0");
    ASSERT_NE(uv, nullptr);
    EXPECT_EQ(uv->domain, Domain::Corner);
    for (const float each : *uv->get<float>()) {
      EXPECT_GE(each, 0);
      EXPECT_LE(each, 1);
    }
    // No normal points away from the side that its face is seen from, where the faces follow the surface.
    if (options.segments.value_or(16) == 2 || options.segments.value_or(16) == 3) continue;
    const Array<glm::vec3> faces = face_normals(mesh);
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      for (std::size_t c = mesh.face_begin(f); c < mesh.face_end(f); ++c) {
        const std::size_t e = normal->domain == Domain::Vertex ? mesh.corners[c] : c;
        EXPECT_GT(glm::dot(faces[f], testing::vector_at(*normal, e)), options.smooth ? 0.05F : 0.9999F) << f;
      }
    }
  }
}

TEST(Primitive, IsClosedWithTheEulerNumberOfItsShape) {
  for (const PrimitiveOptions& options : examples()) {
    if (is_open(options.kind)) continue;
    const Mesh mesh = primitive(options);
    SCOPED_TRACE(mesh.name);
    const bool ring = options.kind == Kind::Torus || options.kind == Kind::TorusKnot || options.closed;
    EXPECT_EQ(topology(mesh).open_edges, 0U);
    EXPECT_EQ(topology(mesh).euler, ring ? 0 : 2);
    EXPECT_TRUE(is_closed(mesh));
    std::set<std::tuple<float, float, float>> places;
    for (const glm::vec3& each : mesh.positions) places.emplace(each.x, each.y, each.z);
    EXPECT_EQ(places.size(), mesh.vertex_count());
  }
  EXPECT_EQ(topology(primitive({.kind = Kind::Plane, .segments = 4, .rings = 3})).euler, 1);
  EXPECT_EQ(topology(primitive({.kind = Kind::Disk})).euler, 1);
  EXPECT_EQ(topology(primitive({.kind = Kind::Helicoid})).euler, 1);
  EXPECT_EQ(topology(primitive({.kind = Kind::Enneper})).euler, 1);
  EXPECT_EQ(topology(primitive({.kind = Kind::Catenoid})).euler, 0);
  // Four parts, whole in themselves: the mouth and the lid's edge are open along four patches each, both ends of handle
  // and spout along two. Body and lid are disks; the handle's lower end touches the body in one vertex.
  const Topology teapot = topology(primitive({.kind = Kind::Teapot, .segments = 5}));
  EXPECT_EQ(teapot.open_edges, 16U * 5);
  EXPECT_EQ(teapot.euler, 1 + 1 + 0 + 0 - 1);
}

TEST(Primitive, SolidsHaveTheirAreasAndVolumes) {
  const double root5 = std::sqrt(5.0);
  const auto check = [](Kind kind, std::size_t vertices, std::size_t faces, double area, double volume) {
    const Mesh mesh = primitive({.kind = kind, .size = 4, .radius = 2});
    SCOPED_TRACE(mesh.name);
    EXPECT_EQ(mesh.vertex_count(), vertices);
    EXPECT_EQ(mesh.face_count(), faces);
    EXPECT_NEAR(measure(mesh).area / area, 1, 1e-6);
    EXPECT_NEAR(measure(mesh).volume / volume, 1, 1e-6);
    EXPECT_EQ(mesh.find("NORMAL")->domain, Domain::Corner);
  };
  // Edges of solids whose corners lie at radius 2.
  const double tetra = 2 * std::sqrt(8.0 / 3);
  const double octa = 2 * std::sqrt(2.0);
  const double dodeca = 2 * 4 / (std::sqrt(3.0) * (1 + root5));
  const double icosa = 2 * 4 / std::sqrt(10 + 2 * root5);
  check(Kind::Cube, 8, 6, 96, 64);
  check(Kind::Tetrahedron, 4, 4, std::sqrt(3.0) * tetra * tetra, tetra * tetra * tetra / (6 * std::sqrt(2.0)));
  check(Kind::Octahedron, 6, 8, 2 * std::sqrt(3.0) * octa * octa, std::sqrt(2.0) / 3 * octa * octa * octa);
  check(Kind::Dodecahedron, 20, 12, 3 * std::sqrt(25 + 10 * root5) * dodeca * dodeca,
        (15 + 7 * root5) / 4 * dodeca * dodeca * dodeca);
  check(Kind::Icosahedron, 12, 20, 5 * std::sqrt(3.0) * icosa * icosa, 5 * (3 + root5) / 12 * icosa * icosa * icosa);
}

TEST(Primitive, RoundBodiesConvergeToTheirs) {
  struct Body {
    PrimitiveOptions options;
    double area;
    double volume;
  };
  const double side = std::sqrt(1.5 * 1.5 + 3 * 3);
  const Body bodies[] = {
      {{.kind = Kind::UvSphere, .radius = 1.5F}, 4 * kPi * 2.25, 4 * kPi / 3 * 3.375},
      {{.kind = Kind::IcoSphere, .radius = 1.5F}, 4 * kPi * 2.25, 4 * kPi / 3 * 3.375},
      {{.kind = Kind::CubeSphere, .radius = 1.5F}, 4 * kPi * 2.25, 4 * kPi / 3 * 3.375},
      {{.kind = Kind::Capsule, .radius = 1.5F, .height = 3},
       2 * kPi * 1.5 * 3 + 4 * kPi * 2.25,
       kPi * 2.25 * 3 + 4 * kPi / 3 * 3.375},
      {{.kind = Kind::Cylinder, .radius = 1.5F, .height = 3}, 2 * kPi * 1.5 * (3 + 1.5), kPi * 2.25 * 3},
      {{.kind = Kind::Cone, .radius = 1.5F, .height = 3}, kPi * 1.5 * (1.5 + side), kPi * 2.25},
      {{.kind = Kind::Torus, .radius = 1.5F, .tube_radius = 0.5F}, 4 * kPi * kPi * 0.75, 2 * kPi * kPi * 1.5 * 0.25},
  };
  for (const Body& body : bodies) {
    double error_before = 0;
    for (int level = 0; level < 3; ++level) {
      PrimitiveOptions options = body.options;
      options.segments = 24 << level;
      options.subdivisions = 2 + level;
      const Mesh mesh = primitive(options);
      SCOPED_TRACE(mesh.name);
      const double area_error = 1 - measure(mesh).area / body.area;
      const double volume_error = 1 - measure(mesh).volume / body.volume;
      // Chords lie inside: what is missing goes with the square of their length.
      EXPECT_GT(volume_error, 0);
      if (level > 0) {
        EXPECT_NEAR(error_before / volume_error, 4, 0.15);
      }
      if (level == 2) {
        EXPECT_LT(std::abs(area_error), 6e-3);
        EXPECT_LT(volume_error, 6e-3);
      }
      error_before = volume_error;
    }
  }
}

TEST(Primitive, NormalsAreTheSurfaces) {
  for (const Kind kind : {Kind::UvSphere, Kind::IcoSphere}) {
    const Mesh mesh = primitive({.kind = kind, .radius = 3});
    ASSERT_EQ(mesh.find("NORMAL")->domain, Domain::Vertex);
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
      EXPECT_LT(glm::distance(testing::vector_at(*mesh.find("NORMAL"), v), mesh.positions[v] / 3.0F), 1e-6F);
    }
  }
  const Mesh torus = primitive({.kind = Kind::Torus, .radius = 2, .tube_radius = 0.5F});
  ASSERT_EQ(torus.find("NORMAL")->domain, Domain::Vertex);
  for (std::size_t v = 0; v < torus.vertex_count(); ++v) {
    const glm::vec3 p = torus.positions[v];
    const glm::vec3 ring = 2.0F * glm::normalize(glm::vec3(p.x, 0, p.z));
    EXPECT_LT(glm::distance(testing::vector_at(*torus.find("NORMAL"), v), (p - ring) * 2.0F), 1e-5F);
  }
  const Mesh cylinder = primitive({.kind = Kind::Cylinder});
  ASSERT_EQ(cylinder.find("NORMAL")->domain, Domain::Corner);
  const Mesh cone = primitive({.kind = Kind::Cone});
  for (std::size_t c = 0; c + 48 < cone.corner_count(); ++c) {  // the bottom comes last
    EXPECT_NEAR(testing::vector_at(*cone.find("NORMAL"), c).y, 1 / std::sqrt(5.0F), 1e-6F);
  }
}

TEST(Primitive, TexturesStandUprightSeenFromOutside) {
  // Where u grows to the right and v down, u × v turns clockwise: the signed area of a face on the texture is negative.
  for (const PrimitiveOptions& options : examples()) {
    if (options.kind == Kind::Teapot) continue;  // its patches run as they are
    const Mesh mesh = primitive(options);
    SCOPED_TRACE(mesh.name);
    const Array<float>& uv = *mesh.find("TEXCOORD_0")->get<float>();
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      double area = 0;
      for (std::size_t c = mesh.face_begin(f); c < mesh.face_end(f); ++c) {
        const std::size_t d = c + 1 == mesh.face_end(f) ? mesh.face_begin(f) : c + 1;
        area += static_cast<double>(uv[2 * c]) * uv[2 * d + 1] - static_cast<double>(uv[2 * d]) * uv[2 * c + 1];
      }
      EXPECT_LT(area, 0) << f;
    }
  }
}

TEST(Primitive, TheTeapotIsNewells) {
  const Mesh mesh = primitive({.kind = Kind::Teapot, .size = 6.434001F, .segments = 16});
  const Box3 box = bounds(mesh);
  EXPECT_NEAR(box.size().x, 6.434, 2e-3);
  EXPECT_NEAR(box.size().y, 3.15, 1e-5);
  EXPECT_NEAR(box.size().z, 4, 1e-3);
  EXPECT_NEAR(box.center().x, 0, 2e-3);
  EXPECT_NEAR(box.center().y, 0, 1e-5);
  // On the rim, the profile's cubic by hand: control points 1.4, 1.3375, 1.4375, 1.5 out and 2.4, 2.53125, 2.53125, 2.4
  // up; in its middle 1/8 (1.4 + 3·1.3375 + 3·1.4375 + 1.5) = 1.403125 out and 2.4984375 up.
  float nearest = 1;
  for (const glm::vec3& p : mesh.positions) {
    nearest = std::min(nearest, glm::distance(p, glm::vec3(1.403125F - 0.2170005F, 2.4984375F - 1.575F, 0)));
  }
  EXPECT_LT(nearest, 1e-5F);
  // At the poles of knob and bottom the normals are the axis.
  int poles = 0;
  const Attribute& normal = *mesh.find("NORMAL");
  for (std::size_t c = 0; c < mesh.corner_count(); ++c) {
    const glm::vec3 p = mesh.positions[mesh.corners[c]];
    if (std::abs(p.x + 0.2170005F) > 1e-6F || p.z != 0) continue;
    const std::size_t e = normal.domain == Domain::Vertex ? mesh.corners[c] : c;
    EXPECT_NEAR(testing::vector_at(normal, e).y, p.y > 0 ? 1 : -1, 1e-5F);
    ++poles;
  }
  EXPECT_EQ(poles, 2 * 4 * 16);
}

TEST(Primitive, SurfacesHaveTheirAreas) {
  const auto area = [](const PrimitiveOptions& options) { return measure(primitive(options)).area; };
  const double r = 1.5;
  EXPECT_NEAR(area({.kind = Kind::Disk, .radius = 1.5F, .segments = 1000}) / (kPi * r * r), 1, 1e-5);
  const double c = 3 / (4 * kPi);  // rise a radian of two turns
  EXPECT_NEAR(area({.kind = Kind::Helicoid, .radius = 1.5F, .height = 3, .segments = 400, .rings = 200, .turns = 2}) /
                  (4 * kPi * (r * std::hypot(r, c) + c * c * std::asinh(r / c))),
              1, 1e-3);
  EXPECT_NEAR(area({.kind = Kind::Catenoid, .height = 3, .tube_radius = 0.75F, .segments = 400, .rings = 400}) /
                  (kPi * 0.75 * (3 + 0.75 * std::sinh(3 / 0.75))),
              1, 1e-3);
  // (1 + u² + v²)² over the square, 532/45; size 10/3 leaves it as it is.
  EXPECT_NEAR(area({.kind = Kind::Enneper, .size = 10.0F / 3, .segments = 300, .rings = 300}) / (532.0 / 45), 1, 1e-3);
  // Of a strip |S_u × S_v| by Simpson's rule.
  double strip = 0;
  constexpr int kSteps = 400;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      const double u = 2 * kPi * i / kSteps;
      const double t = 0.4 * (2.0 * j / kSteps - 1);
      const double weight = j == 0 || j == kSteps ? 1 : j % 2 == 1 ? 4 : 2;
      strip += weight * std::hypot(1 + t * std::cos(u / 2), t / 2);
    }
  }
  strip *= 2 * kPi / kSteps * (0.8 / kSteps) / 3;
  EXPECT_NEAR(area({.kind = Kind::Mobius, .segments = 400, .rings = 100}) / strip, 1, 1e-3);
}

TEST(Primitive, TubesHaveTheVolumeOfTheirLength) {
  // Pappus: π a² L, whatever the curve; a polygon of n corners is n/2π · sin(2π/n) of its circle.
  constexpr int kCorners = 200;
  const double polygon = kCorners / (2 * kPi) * std::sin(2 * kPi / kCorners);
  double length = 0;
  const auto knot = [](double share) {
    const double reach = 1 + 0.5 * std::cos(2 * kPi * 5 * share);
    return glm::dvec3(reach * std::cos(2 * kPi * 3 * share), 0.5 * std::sin(2 * kPi * 5 * share),
                      -reach * std::sin(2 * kPi * 3 * share));
  };
  for (int i = 0; i < 20000; ++i) length += glm::distance(knot(i / 20000.0), knot((i + 1) / 20000.0));
  const Mesh mesh = primitive(
      {.kind = Kind::TorusKnot, .tube_radius = 0.1F, .segments = kCorners, .rings = 2000, .around = 3, .through = 5});
  EXPECT_NEAR(measure(mesh).volume / (polygon * kPi * 0.01 * length), 1, 1e-4);
  EXPECT_NEAR(measure(mesh).area / (2 * kPi * 0.1 * length), 1, 1e-3);
  const Mesh rod =
      primitive({.kind = Kind::Tube, .tube_radius = 0.5F, .segments = kCorners, .points = {1, 0, 0, 1, 2, 0, 1, 3, 0}});
  EXPECT_NEAR(measure(rod).volume / (polygon * kPi * 0.25 * 3), 1, 1e-5);
  const Box3 box = bounds(rod);
  EXPECT_LT(glm::distance(box.center(), glm::vec3(1, 1.5F, 0)), 1e-3F);
}

TEST(Primitive, NormalsAreAcrossTheFinestFaces) {
  const PrimitiveOptions fine[] = {
      {.kind = Kind::Capsule, .segments = 300},
      {.kind = Kind::CubeSphere, .segments = 100},
      {.kind = Kind::Tube, .tube_radius = 0.2F, .segments = 200, .rings = 100},
      {.kind = Kind::Tube, .tube_radius = 0.2F, .segments = 200, .rings = 100, .points = wavy_ring(), .closed = true},
      {.kind = Kind::TorusKnot, .tube_radius = 0.2F, .segments = 200, .rings = 1000},
      {.kind = Kind::Mobius, .segments = 400, .rings = 100},
      {.kind = Kind::KleinBottle, .segments = 1000, .rings = 300},
      {.kind = Kind::Helicoid, .segments = 200, .rings = 200},
      {.kind = Kind::Catenoid, .segments = 300, .rings = 300},
      {.kind = Kind::Enneper, .segments = 200, .rings = 200}};
  for (const PrimitiveOptions& options : fine) {
    const Mesh mesh = primitive(options);
    SCOPED_TRACE(mesh.name);
    const Attribute& normal = *mesh.find("NORMAL");
    const Array<glm::vec3> faces = face_normals(mesh);
    float least = 1;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      if (mesh.face_end(f) - mesh.face_begin(f) > 4) continue;  // the tube's ends
      for (std::size_t c = mesh.face_begin(f); c < mesh.face_end(f); ++c) {
        const std::size_t e = normal.domain == Domain::Vertex ? mesh.corners[c] : c;
        least = std::min(least, glm::dot(faces[f], testing::vector_at(normal, e)));
      }
    }
    EXPECT_GT(least, 0.999F);  // within 2.6°
  }
}

TEST(Primitive, SurfacesOfOneSideMeetThemselvesTurned) {
  const EdgeCounts strip = count_edges(primitive({.kind = Kind::Mobius, .segments = 20, .rings = 4}));
  EXPECT_EQ(strip.turned, 4U);
  EXPECT_EQ(strip.border, 2U * 20);  // one border, around twice
  const EdgeCounts bottle = count_edges(primitive({.kind = Kind::KleinBottle, .segments = 20, .rings = 8}));
  EXPECT_EQ(bottle.turned, 8U);
  EXPECT_EQ(bottle.border + bottle.crowded, 0U);
  const Box3 box = bounds(primitive({.kind = Kind::KleinBottle, .size = 4, .segments = 500, .rings = 200}));
  EXPECT_NEAR(box.size().y, 4, 1e-3);
  EXPECT_LT(glm::length(box.center()), 1e-3F);
}

TEST(Primitive, TheTeapotIsWithinItsTolerance) {
  for (const float tolerance : {0.05F, 0.01F, 0.002F}) {
    const Mesh coarse = primitive({.kind = Kind::Teapot, .tolerance = tolerance});
    const auto n =
        static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(coarse.corner_count()) / 4 / 32)));
    constexpr std::size_t kFiner = 4;
    const Mesh fine = primitive({.kind = Kind::Teapot, .segments = static_cast<int>(kFiner * n)});
    const Attribute& uv = *fine.find("TEXCOORD_0");
    // Faces at poles have three corners: their texture coordinates tell where all are.
    std::map<std::tuple<std::size_t, long, long>, glm::vec3> places;
    const auto scan = [&](const Mesh& mesh, std::size_t steps, auto take) {
      const Array<float>& at = *mesh.find("TEXCOORD_0")->get<float>();
      const std::size_t faces = mesh.face_count() / 32;
      for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        for (std::size_t c = mesh.face_begin(f); c < mesh.face_end(f); ++c) {
          take(f / faces, std::lround(at[2 * c] * static_cast<double>(steps)),
               std::lround(at[2 * c + 1] * static_cast<double>(steps)), mesh.positions[mesh.corners[c]]);
        }
      }
    };
    ASSERT_EQ(uv.domain, Domain::Corner);
    scan(coarse, n, [&](std::size_t patch, long i, long j, const glm::vec3& p) { places[{patch, i, j}] = p; });
    double error = 0;
    const auto steps = static_cast<long>(kFiner);
    scan(fine, kFiner * n, [&](std::size_t patch, long i, long j, const glm::vec3& p) {
      const long a = std::min(i / steps, static_cast<long>(n) - 1);
      const long b = std::min(j / steps, static_cast<long>(n) - 1);
      const double s = static_cast<double>(i - a * steps) / static_cast<double>(steps);
      const double t = static_cast<double>(j - b * steps) / static_cast<double>(steps);
      const auto corner = [&](long k, long l) {
        const auto found = places.find({patch, a + k, b + l});
        return found == places.end() ? glm::dvec3(NAN) : glm::dvec3(found->second);  // left out at a pole
      };
      const glm::dvec3 first = corner(0, 0);
      const glm::dvec3 across = corner(1, 1) - first;
      const glm::dvec3 flat = s > t ? first + (s - t) * (corner(1, 0) - first) + t * across
                                    : first + (t - s) * (corner(0, 1) - first) + s * across;
      const double apart = glm::distance(flat, glm::dvec3(p));
      if (!std::isnan(apart)) error = std::max(error, apart);
    });
    EXPECT_LE(error, tolerance);
    EXPECT_GT(error, 0.1 * tolerance);  // the bound is not idle
  }
}

TEST(Primitive, RefusesWhatCantBe) {
  EXPECT_THROW(primitive({.kind = Kind::TorusKnot, .around = 2, .through = 4}), Error);
  EXPECT_THROW(primitive({.kind = Kind::Tube, .points = {0, 0, 0}}), Error);
  EXPECT_THROW(primitive({.kind = Kind::Tube, .points = {0, 0, 0, 1}}), Error);
  EXPECT_THROW(primitive({.kind = Kind::Tube, .points = {0, 0, 0, 0, 0, 0}}), Error);
  EXPECT_THROW(primitive({.kind = Kind::Tube, .points = {0, 0, 0, 1, 0, 0}, .closed = true}), Error);
  EXPECT_THROW(primitive({.kind = Kind::Catenoid, .height = 17}), Error);
  EXPECT_THROW(primitive({.kind = Kind::Teapot, .segments = 3, .tolerance = 0.1F}), Error);
  EXPECT_THROW(primitive({.kind = Kind::Teapot, .tolerance = 1e-9F}), Error);

  EXPECT_THROW(primitive({.radius = 0}), Error);
  EXPECT_THROW(primitive({.size = std::numeric_limits<float>::quiet_NaN()}), Error);
  EXPECT_THROW(primitive({.kind = Kind::Cylinder, .segments = 2}), Error);
  EXPECT_THROW(primitive({.kind = Kind::UvSphere, .rings = 1}), Error);
  EXPECT_THROW(primitive({.kind = Kind::Torus, .tube_radius = 1}), Error);
  EXPECT_THROW(primitive({.kind = Kind::IcoSphere, .subdivisions = 11}), Error);
  azulejo::Run run;
  run.limits.memory_bytes = 1 << 20;
  EXPECT_THROW(primitive({.kind = Kind::Plane, .segments = 4096, .rings = 4096}, run), Error);
}

}  // namespace
}  // namespace azulejo
