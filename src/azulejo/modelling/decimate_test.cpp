#include "azulejo/modelling/decimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <map>
#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "azulejo/core/error.h"
#include "azulejo/io/model_io.h"
#include "azulejo/modelling/primitive.h"
#include "azulejo/modelling/topology.h"

namespace azulejo {
namespace {

Mesh made(PrimitiveKind kind, int segments = 24, int rings = 12) {
  PrimitiveOptions options;
  options.kind = kind;
  options.segments = segments;
  options.rings = rings;
  options.subdivisions = 4;
  Mesh mesh = primitive(options);
  mesh.attributes.clear();
  return mesh;
}

/// n × n squares of two triangles in the plane z = 0, from 0 to n.
Mesh grid(int n) {
  Mesh mesh;
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) mesh.positions.emplace_back(x, y, 0);
  }
  const auto at = [&](int x, int y) { return static_cast<std::uint32_t>(y * (n + 1) + x); };
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      mesh.corners.insert(mesh.corners.end(), {at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      mesh.corners.insert(mesh.corners.end(), {at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  }
  return mesh;
}

/// The cube from 0 to n, each side a grid of n × n, vertices at the edges several times (`welded`: once).
Mesh cube(int n) {
  Mesh mesh;
  const Mesh side = grid(n);
  for (int s = 0; s < 6; ++s) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::vec3& p : side.positions) {
      const float depth = s < 3 ? static_cast<float>(n) : 0.0F;
      const float u = s < 3 ? p.x : p.y;
      const float v = s < 3 ? p.y : p.x;
      mesh.positions.push_back(s % 3 == 0   ? glm::vec3(depth, u, v)
                               : s % 3 == 1 ? glm::vec3(v, depth, u)
                                            : glm::vec3(u, v, depth));
    }
    for (const std::uint32_t corner : side.corners) mesh.corners.push_back(first + corner);
  }
  return mesh;
}

double volume(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t c = 0; c < mesh.corners.size(); c += 3) {
    const glm::dvec3 a(mesh.positions[mesh.corners[c]]);
    const glm::dvec3 b(mesh.positions[mesh.corners[c + 1]]);
    const glm::dvec3 d(mesh.positions[mesh.corners[c + 2]]);
    sum += glm::dot(a, glm::cross(b, d)) / 6;
  }
  return sum;
}

Mesh random_soup(std::uint32_t seed, std::size_t vertices, std::size_t faces) {
  std::mt19937 random(seed);
  Mesh mesh;
  for (std::size_t i = 0; i < vertices; ++i) mesh.positions.emplace_back(random() % 9, random() % 9, random() % 9);
  for (std::size_t i = 0; i < 3 * faces; ++i) mesh.corners.push_back(static_cast<std::uint32_t>(random() % vertices));
  return mesh;
}

DecimateOptions to_faces(int faces) {
  DecimateOptions options;
  options.faces = faces;
  return options;
}

/// No face has a vertex twice, every vertex is used, and all is as a mesh must be.
void expect_sound(const Mesh& mesh) {
  EXPECT_NO_THROW(mesh.check("result"));
  EXPECT_TRUE(mesh.all_triangles());
  std::vector<bool> used(mesh.positions.size(), false);
  for (std::size_t c = 0; c < mesh.corners.size(); c += 3) {
    const std::uint32_t* const three = &mesh.corners[c];
    EXPECT_FALSE(three[0] == three[1] || three[1] == three[2] || three[2] == three[0]) << "face " << c / 3;
    for (int k = 0; k < 3; ++k) used[three[k]] = true;
  }
  for (const std::uint32_t vertex : mesh.lines) used[vertex] = true;
  EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
}

bool same_bytes(const Mesh& a, const Mesh& b) {
  if (a.positions.size() != b.positions.size() || a.corners != b.corners || a.material != b.material) return false;
  if (std::memcmp(a.positions.data(), b.positions.data(), a.positions.size() * sizeof(glm::vec3)) != 0) return false;
  if (a.attributes.size() != b.attributes.size()) return false;
  for (std::size_t i = 0; i < a.attributes.size(); ++i) {
    if (a.attributes[i].values != b.attributes[i].values) return false;
  }
  return true;
}

// A cube's sides are flat: everything but its corners can go, and nothing moves.
TEST(Decimate, SubdividedCubeIsTwelveTriangles) {
  DecimateOptions options;
  options.error = 1e-5F;
  const Decimation done = decimate(cube(8), options);
  EXPECT_EQ(done.faces_before, 768U);
  ASSERT_EQ(done.faces_after, 12U);
  EXPECT_EQ(done.vertices_after, 8U);
  EXPECT_LT(done.error, 1e-7);  // of doubles over planes whose coefficients are exact
  EXPECT_EQ(done.stopped, DecimateStop::Error);
  for (const glm::vec3& p : done.mesh.positions) {
    for (int k = 0; k < 3; ++k) EXPECT_TRUE(p[k] == 0 || p[k] == 8) << p[k];
  }
  EXPECT_NEAR(volume(done.mesh), 512, 1e-9);
}

TEST(Decimate, PlaneKeepsOutlineAndSides) {
  const Decimation done = decimate(grid(16), to_faces(2));
  EXPECT_EQ(done.faces_after, 2U);
  double area = 0;
  for (std::size_t c = 0; c < done.mesh.corners.size(); c += 3) {
    const glm::vec3 a = done.mesh.positions[done.mesh.corners[c]];
    const glm::vec3 b = done.mesh.positions[done.mesh.corners[c + 1]];
    const glm::vec3 d = done.mesh.positions[done.mesh.corners[c + 2]];
    EXPECT_GT(glm::cross(b - a, d - a).z, 0);
    area += 0.5 * static_cast<double>(glm::cross(b - a, d - a).z);
  }
  EXPECT_DOUBLE_EQ(area, 256);
}

TEST(Decimate, NoFaceOfAPlaneTurnsOver) {
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    Mesh mesh = grid(20);
    std::mt19937 random(seed);
    for (glm::vec3& p : mesh.positions) {
      if (p.x > 0 && p.x < 20 && p.y > 0 && p.y < 20) {
        p.x += static_cast<float>(random() % 64) / 160 - 0.2F;
        p.y += static_cast<float>(random() % 64) / 160 - 0.2F;
      }
    }
    for (const int faces : {600, 200, 50, 10}) {
      const Mesh result = decimate(mesh, to_faces(faces)).mesh;
      for (std::size_t c = 0; c < result.corners.size(); c += 3) {
        const glm::vec3 a = result.positions[result.corners[c]];
        const glm::vec3 b = result.positions[result.corners[c + 1]];
        const glm::vec3 d = result.positions[result.corners[c + 2]];
        EXPECT_GT(glm::cross(b - a, d - a).z, 0) << "seed " << seed << ", faces " << faces;
      }
    }
  }
}

TEST(Decimate, ReachesItsTarget) {
  const Mesh sphere = made(PrimitiveKind::IcoSphere);
  for (const int faces : {4000, 1000, 101, 20, 4}) {
    const Decimation done = decimate(sphere, to_faces(faces));
    EXPECT_LE(done.faces_after, static_cast<std::size_t>(faces));
    EXPECT_GE(done.faces_after + 1, static_cast<std::size_t>(faces));
    EXPECT_EQ(done.stopped, DecimateStop::Faces);
    expect_sound(done.mesh);
  }
  DecimateOptions ratio;
  ratio.ratio = 0.25F;
  EXPECT_EQ(decimate(sphere, ratio).faces_after, sphere.face_count() / 4);
  EXPECT_EQ(decimate(sphere).faces_after, sphere.face_count() / 2);
  // Of two targets the one that is reached first.
  ratio.faces = 2000;
  EXPECT_EQ(decimate(sphere, ratio).faces_after, 2000U);
}

TEST(Decimate, ErrorRisesAsFacesFall) {
  const Mesh torus = made(PrimitiveKind::Torus, 64, 32);
  double before = 0;
  for (const int faces : {4000, 3000, 2000, 1000, 500, 200, 50}) {
    const double error = decimate(torus, to_faces(faces)).error;
    EXPECT_GE(error, before);
    before = error;
  }
  std::size_t faces_before = torus.triangle_count();
  for (const float error : {1e-5F, 1e-4F, 1e-3F, 1e-2F}) {
    DecimateOptions options;
    options.error = error;
    const Decimation done = decimate(torus, options);
    EXPECT_LE(done.error, static_cast<double>(error));
    EXPECT_EQ(done.stopped, DecimateStop::Error);
    EXPECT_LE(done.faces_after, faces_before);
    faces_before = done.faces_after;
  }
}

// Of F equal triangles with corners on a sphere the volume is 4π/3 (1 − 5.8/F): that of 500 is 0.0116 too small, of the
// source's 5120 0.0011. Placed at will, vertices do better.
TEST(Decimate, VolumeOfASphereIsAboutKept) {
  const Mesh sphere = made(PrimitiveKind::IcoSphere);
  const Mesh result = decimate(sphere, to_faces(500)).mesh;
  EXPECT_NEAR(volume(result) / volume(sphere), 1, 0.0105);
  for (const glm::vec3& p : result.positions) EXPECT_NEAR(glm::length(p), 1, 0.01);
}

TEST(Decimate, KeepsTopology) {
  for (const PrimitiveKind kind : {PrimitiveKind::Torus, PrimitiveKind::TorusKnot, PrimitiveKind::IcoSphere,
                                   PrimitiveKind::Mobius, PrimitiveKind::Helicoid, PrimitiveKind::Catenoid}) {
    const Mesh mesh = made(kind, 48, 16);
    const Topology before = topology(mesh, {.by_position = true});
    for (const int faces : {400, 60, 1}) {
      const Decimation done = decimate(mesh, to_faces(faces));
      expect_sound(done.mesh);
      const Topology after = topology(done.mesh);
      EXPECT_EQ(after.euler(), before.euler()) << static_cast<int>(kind) << ", faces " << faces;
      EXPECT_EQ(after.holes.size(), before.holes.size());
      EXPECT_EQ(after.shells.size(), before.shells.size());
      EXPECT_EQ(after.manifold(), before.manifold());
      EXPECT_EQ(after.oriented(), before.oriented());
    }
  }
}

TEST(Decimate, TopologyMayGo) {
  const Mesh torus = made(PrimitiveKind::Torus, 24, 12);
  EXPECT_GT(decimate(torus, to_faces(0)).faces_after, 12U);
  DecimateOptions options = to_faces(0);
  options.keep_topology = false;
  const Decimation done = decimate(torus, options);
  EXPECT_LT(done.faces_after, 12U);
  expect_sound(done.mesh);
}

TEST(Decimate, LockedBordersStay) {
  Mesh mesh = made(PrimitiveKind::Helicoid, 32, 16);
  DecimateOptions options = to_faces(1);
  options.lock_borders = true;
  const auto border = [](const Mesh& of) {
    double length = 0;
    std::size_t edges = 0;
    for (const MeshHole& hole : topology(of).holes) {
      length += hole.length;
      edges += hole.edges;
    }
    return std::pair(length, edges);
  };
  const auto [length, edges] = border(mesh);
  const auto [length_after, edges_after] = border(decimate(mesh, options).mesh);
  EXPECT_EQ(edges_after, edges);
  EXPECT_NEAR(length_after, length, 1e-5 * length);
}

/// A sphere with texture coordinates that meet in a seam: vertices at one place twice.
Mesh textured_sphere() {
  PrimitiveOptions options;
  options.kind = PrimitiveKind::UvSphere;
  options.segments = 48;
  options.rings = 24;
  return primitive(options);
}

TEST(Decimate, SeamsStayClosed) {
  const Mesh mesh = textured_sphere();
  ASSERT_NE(mesh.find("TEXCOORD_0"), nullptr);
  const Topology before = topology(mesh, {.by_position = true});
  ASSERT_TRUE(before.closed());
  const Decimation done = decimate(mesh, to_faces(400));
  EXPECT_LE(done.faces_after, 400U);
  expect_sound(done.mesh);
  EXPECT_TRUE(topology(done.mesh, {.by_position = true}).closed());
}

// Texture coordinates that are linear in space are so afterwards, too.
TEST(Decimate, LinearAttributesStayLinear) {
  Mesh mesh = grid(16);
  Array<float> values;
  for (const glm::vec3& p : mesh.positions) values.insert(values.end(), {p.x / 16, 1 - p.y / 32});
  mesh.attributes.push_back({"TEXCOORD_0", Domain::Vertex, 2, std::move(values)});
  const Decimation done = decimate(mesh, to_faces(20));
  EXPECT_LE(done.faces_after, 20U);
  const Array<float>& uv = *done.mesh.find("TEXCOORD_0")->get<float>();
  for (std::size_t v = 0; v < done.mesh.positions.size(); ++v) {
    EXPECT_NEAR(uv[2 * v], done.mesh.positions[v].x / 16, 1e-6);
    EXPECT_NEAR(uv[2 * v + 1], 1 - done.mesh.positions[v].y / 32, 1e-6);
  }
}

// A plane in two colors with a step between them, along corners: the step stays where it is, which the weight decides.
TEST(Decimate, AttributesCount) {
  Mesh mesh = grid(16);
  Array<float> values;
  for (const glm::vec3& p : mesh.positions) {
    const float dark = p.x < 7.5F ? 0.0F : 1.0F;
    values.insert(values.end(), {dark, dark, dark});
  }
  mesh.attributes.push_back({"COLOR_0", Domain::Vertex, 3, std::move(values)});
  const auto left = [&](float weight) {
    DecimateOptions options;
    options.error = 1e-4F;
    options.attribute_weight = weight;
    return decimate(mesh, options);
  };
  EXPECT_EQ(left(0).faces_after, 2U);
  const Decimation kept = left(0.1F);
  EXPECT_GE(kept.faces_after, 6U);
  EXPECT_LE(kept.faces_after, 80U);
  const Array<float>& colors = *kept.mesh.find("COLOR_0")->get<float>();
  for (std::size_t v = 0; v < kept.mesh.positions.size(); ++v) {
    const float x = kept.mesh.positions[v].x;
    if (x <= 7 || x >= 8) {
      EXPECT_NEAR(colors[3 * v], x < 7.5F ? 0 : 1, 0.02) << x;
    }
  }
}

TEST(Decimate, CornerAttributesAndMaterialsStay) {
  Mesh mesh = grid(16);
  Array<float> values;
  for (std::size_t c = 0; c < mesh.corners.size(); ++c) {
    const std::size_t face = c / 3;
    const bool right = face / 2 % 16 >= 8;
    const glm::vec3 p = mesh.positions[mesh.corners[c]];
    values.insert(values.end(), {right ? p.x - 8 : p.x, p.y});
    if (c % 3 == 0) mesh.material.push_back(face / 2 / 16 >= 5 ? 1 : 0);
  }
  mesh.attributes.push_back({"TEXCOORD_0", Domain::Corner, 2, std::move(values)});
  const Decimation done = decimate(mesh, to_faces(40));
  EXPECT_LE(done.faces_after, 40U);
  expect_sound(done.mesh);
  const Mesh& result = done.mesh;
  ASSERT_EQ(result.material.size(), result.face_count());
  const Array<float>& uv = *result.find("TEXCOORD_0")->get<float>();
  std::array<double, 2> areas{};
  for (std::size_t f = 0; f < result.face_count(); ++f) {
    std::array<glm::vec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = result.positions[result.corners[3 * f + k]];
    const glm::vec3 middle = (p[0] + p[1] + p[2]) / 3.0F;
    EXPECT_EQ(result.material[f], middle.y >= 5 ? 1U : 0U);
    areas[result.material[f]] += 0.5 * static_cast<double>(glm::cross(p[1] - p[0], p[2] - p[0]).z);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(uv[2 * (3 * f + k)], middle.x >= 8 ? p[k].x - 8 : p[k].x, 1e-4);
      EXPECT_NEAR(uv[2 * (3 * f + k) + 1], p[k].y, 1e-4);
    }
  }
  EXPECT_NEAR(areas[0], 80, 1e-4);
  EXPECT_NEAR(areas[1], 176, 1e-4);
}

TEST(Decimate, FlatNormalsAreFaceNormals) {
  Mesh mesh = made(PrimitiveKind::IcoSphere);
  Array<float> values;
  for (std::size_t c = 0; c < mesh.corners.size(); ++c) {
    const std::size_t f = c / 3 * 3;
    const glm::vec3 a = mesh.positions[mesh.corners[f]];
    const glm::vec3 n =
        glm::normalize(glm::cross(mesh.positions[mesh.corners[f + 1]] - a, mesh.positions[mesh.corners[f + 2]] - a));
    values.insert(values.end(), {n.x, n.y, n.z});
  }
  mesh.attributes.push_back({"NORMAL", Domain::Corner, 3, std::move(values)});
  const Decimation done = decimate(mesh, to_faces(300));
  EXPECT_EQ(done.faces_after, 300U);
  const Attribute* normals = done.mesh.find("NORMAL");
  ASSERT_NE(normals, nullptr);
  const Array<float>& n = *normals->get<float>();
  for (std::size_t c = 0; c < done.mesh.corners.size(); ++c) {
    const glm::vec3 p = done.mesh.positions[done.mesh.corners[c]];
    EXPECT_GT(glm::dot(p, glm::vec3(n[3 * c], n[3 * c + 1], n[3 * c + 2])), 0.5F);
  }
}

TEST(Decimate, SameBytesForAnyNumberOfThreads) {
  const Mesh plain = made(PrimitiveKind::TorusKnot, 200, 24);
  const Mesh textured = textured_sphere();
  for (const Mesh* mesh : {&plain, &textured}) {
    for (const bool keep : {true, false}) {
      DecimateOptions options;
      options.ratio = 0.1F;
      options.keep_topology = keep;
      azulejo::Run run;
      run.threads = 1;
      const Decimation one = decimate(*mesh, options, run);
      for (const int threads : {2, 7}) {
        run.threads = threads;
        const Decimation many = decimate(*mesh, options, run);
        EXPECT_TRUE(same_bytes(many.mesh, one.mesh)) << threads;
        EXPECT_EQ(many.error, one.error);
      }
    }
  }
}

TEST(Decimate, SoupComesOutSound) {
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    const Mesh mesh = random_soup(seed, 20 + 10 * seed, 60 * seed);
    for (const bool keep : {true, false}) {
      DecimateOptions options = to_faces(0);
      options.keep_topology = keep;
      SCOPED_TRACE(seed);
      expect_sound(decimate(mesh, options).mesh);
    }
  }
}

TEST(Decimate, EdgesOfThreeFacesStay) {
  // Three grids that meet along the y axis.
  Mesh mesh;
  const Mesh sheet = grid(8);
  for (int s = 0; s < 3; ++s) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::vec3& p : sheet.positions) {
      mesh.positions.push_back(s == 0 ? p : s == 1 ? glm::vec3(-p.x, p.y, 0) : glm::vec3(0, p.y, p.x));
    }
    for (const std::uint32_t corner : sheet.corners) mesh.corners.push_back(first + corner);
  }
  const Decimation done = decimate(mesh, to_faces(0));
  expect_sound(done.mesh);
  const Topology after = topology(done.mesh, {.by_position = true});
  EXPECT_EQ(after.count(MeshFaultKind::SingularEdge), 8U);
  EXPECT_LT(done.faces_after, 60U);
}

TEST(Decimate, TakesWhatIsNoSurface) {
  EXPECT_EQ(decimate(Mesh()).mesh.vertex_count(), 0U);
  Mesh points;
  points.positions = {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(decimate(points).mesh.vertex_count(), 3U);
  points.lines = {0, 1};
  EXPECT_EQ(decimate(points).mesh.lines.size(), 2U);
  points.positions[2] = {0, 1, 0};
  points.corners = {0, 1, 2};
  const Decimation one = decimate(points, to_faces(0));
  EXPECT_EQ(one.faces_after, 1U);
  EXPECT_EQ(one.stopped, DecimateStop::Nothing);
  EXPECT_EQ(one.mesh.lines.size(), 2U);
  points.corners = {0, 0, 1, 2, 2, 2};
  const Decimation none = decimate(points, to_faces(0));
  EXPECT_EQ(none.faces_after, 0U);
  EXPECT_EQ(none.mesh.vertex_count(), 2U);  // of the line

  Mesh infinite = grid(4);
  infinite.positions[12] = {std::numeric_limits<float>::quiet_NaN(), 0, 0};
  infinite.positions[7] = {0, std::numeric_limits<float>::infinity(), 0};
  expect_sound(decimate(infinite, to_faces(0)).mesh);

  Mesh polygon;
  polygon.positions = {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 2, 0}};
  polygon.corners = {0, 1, 2, 3, 4};
  polygon.face_offsets = {0, 5};
  EXPECT_EQ(decimate(polygon, to_faces(3)).faces_after, 3U);
}

TEST(Decimate, HugeAndTinyCoordinatesAreTheSame) {
  const Mesh sphere = made(PrimitiveKind::IcoSphere);
  const std::size_t faces = 400;
  for (const float size : {1e-30F, 1e30F}) {
    Mesh scaled = sphere.clone();
    for (glm::vec3& p : scaled.positions) p *= size;
    const Decimation done = decimate(scaled, to_faces(static_cast<int>(faces)));
    EXPECT_EQ(done.faces_after, faces);
    for (const glm::vec3& p : done.mesh.positions) {
      EXPECT_NEAR(glm::length(glm::dvec3(p)) / static_cast<double>(size), 1, 0.02);
    }
  }
}

TEST(Decimate, RefusesWhatIsOutOfRange) {
  DecimateOptions options;
  options.ratio = 1.5F;
  EXPECT_THROW(decimate(grid(2), options), Error);
  options.ratio = 0.5F;
  options.border_weight = -1;
  EXPECT_THROW(decimate(grid(2), options), Error);
}

TEST(Decimate, Report) {
  const Report report = report_of(decimate(grid(8), to_faces(10)));
  EXPECT_EQ(report.json["faces_before"].number(), 128);
  EXPECT_LE(report.json["faces_after"].number(), 10);
  EXPECT_EQ(report.json["stopped_by"].text(), "faces");
}

}  // namespace
}  // namespace azulejo
