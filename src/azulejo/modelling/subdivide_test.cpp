#include "azulejo/modelling/subdivide.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "azulejo/core/error.h"
#include "azulejo/modelling/subdivision_testing.h"
#include "azulejo/modelling/topology.h"

namespace azulejo {
namespace {

using namespace testing;

using Edge = std::pair<std::uint32_t, std::uint32_t>;
using Edges = std::map<Edge, std::vector<std::size_t>>;  ///< and the faces along each

Edge edge_of(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

Edges edges_of(const Polygons& faces) {
  Edges edges;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (std::size_t i = 0; i < faces[f].size(); ++i) {
      edges[edge_of(faces[f][i], faces[f][(i + 1) % faces[f].size()])].push_back(f);
    }
  }
  return edges;
}

/// One level of Loop or Catmull–Clark by the definitions, as slow as may be, of a mesh whose faces at a vertex are one
/// fan.
std::vector<glm::dvec3> reference(const Mesh& mesh, bool quads, const std::set<Edge>& creases = {}) {
  const Polygons faces = faces_of(mesh);
  const Edges edges = edges_of(faces);
  std::vector<glm::dvec3> old(mesh.positions.begin(), mesh.positions.end());
  std::vector<glm::dvec3> centers;
  for (const auto& face : faces) {
    glm::dvec3 sum(0);
    for (const std::uint32_t v : face) sum += old[v];
    centers.push_back(sum / static_cast<double>(face.size()));
  }
  const auto sharp = [&](const auto& edge) { return edge.second.size() != 2 || creases.count(edge.first) != 0; };
  std::vector<glm::dvec3> middles;
  for (const auto& edge : edges) {
    const auto [a, b] = edge.first;
    glm::dvec3 sum = old[a] + old[b];
    if (sharp(edge)) {
      middles.push_back(sum / 2.0);
    } else if (quads) {
      middles.push_back((sum + centers[edge.second[0]] + centers[edge.second[1]]) / 4.0);
    } else {
      sum *= 3.0;
      for (const std::size_t f : edge.second) {
        for (const std::uint32_t v : faces[f]) sum += v == a || v == b ? glm::dvec3(0) : old[v];
      }
      middles.push_back(sum / 8.0);
    }
  }
  std::vector<glm::dvec3> result;
  for (std::uint32_t v = 0; v < old.size(); ++v) {
    glm::dvec3 neighbors(0);
    glm::dvec3 sharp_neighbors(0);
    double n = 0;
    int sharp_count = 0;
    for (const auto& edge : edges) {
      if (edge.first.first != v && edge.first.second != v) continue;
      const std::uint32_t other = edge.first.first == v ? edge.first.second : edge.first.first;
      neighbors += old[other];
      n += 1;
      if (!sharp(edge)) continue;
      sharp_neighbors += old[other];
      ++sharp_count;
    }
    glm::dvec3 around(0);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      for (const std::uint32_t each : faces[f]) around += each == v ? centers[f] : glm::dvec3(0);
    }
    if (sharp_count > 2 || n == 0) {
      result.push_back(old[v]);
    } else if (sharp_count == 2) {
      result.push_back((6.0 * old[v] + sharp_neighbors) / 8.0);
    } else if (quads) {
      // Catmull & Clark's words: mean of the faces' points, twice the mean of the edges' middles, n − 3 times the old.
      const glm::dvec3 edge_middles = (old[v] * n + neighbors) / 2.0 / n;
      result.push_back((around / n + 2.0 * edge_middles + (n - 3) * old[v]) / n);
    } else {
      const double beta = (0.625 - std::pow(0.375 + 0.25 * std::cos(2 * std::numbers::pi / n), 2)) / n;
      result.push_back((1 - n * beta) * old[v] + beta * neighbors);
    }
  }
  result.insert(result.end(), middles.begin(), middles.end());
  if (quads) result.insert(result.end(), centers.begin(), centers.end());
  return result;
}

/// Coordinates are at most 8: half a unit in the last place is 2⁻²², and a Catmull–Clark vertex weighs face points that
/// were rounded, too.
constexpr double kRounded = 1e-6;

void expect_near(const Mesh& mesh, const std::vector<glm::dvec3>& expected) {
  ASSERT_EQ(mesh.vertex_count(), expected.size());
  for (std::size_t v = 0; v < expected.size(); ++v) {
    ASSERT_LT(glm::distance(glm::dvec3(mesh.positions[v]), expected[v]), kRounded) << "vertex " << v;
  }
}

std::vector<Mesh> triangle_meshes() {
  std::vector<Mesh> list;
  for (const PrimitiveKind kind : {PrimitiveKind::Tetrahedron, PrimitiveKind::Octahedron, PrimitiveKind::IcoSphere}) {
    list.push_back(bare({.kind = kind, .subdivisions = 1}));
  }
  list.push_back(sheet(4, true));
  list.push_back(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
  // Three triangles at an edge; one that is turned round.
  list.push_back(mesh_of({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}}, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}));
  list.push_back(mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5F, 0.5F, 1}},
                         {{0, 1, 4}, {2, 1, 4}, {2, 3, 4}, {3, 0, 4}}));
  for (std::size_t i = 0; i < list.size(); ++i) scatter(list[i], 0.2F, static_cast<unsigned>(i));
  return list;
}

std::vector<Mesh> polygon_meshes() {
  std::vector<Mesh> list = triangle_meshes();
  for (const PrimitiveKind kind : {PrimitiveKind::Cube, PrimitiveKind::Dodecahedron, PrimitiveKind::Cone}) {
    list.push_back(bare({.kind = kind, .segments = 7}));
    scatter(list.back(), 0.2F, 9);
  }
  list.push_back(sheet(3, false));
  return list;
}

TEST(Subdivide, IsLoops) {
  for (const Mesh& mesh : triangle_meshes()) expect_near(subdivide(mesh), reference(mesh, false));
}

TEST(Subdivide, IsCatmullsAndClarks) {
  for (const Mesh& mesh : polygon_meshes()) {
    const Mesh result = subdivide(mesh, {.scheme = SubdivisionScheme::CatmullClark});
    expect_near(result, reference(mesh, true));
    EXPECT_EQ(result.face_count(), mesh.corner_count());
  }
}

TEST(Subdivide, KeepsCreasesAlongLines) {
  for (const bool quads : {false, true}) {
    Mesh mesh = sheet(4, !quads);
    scatter(mesh, 0.3F, 5);
    mesh.lines = {11, 12, 12, 13, 13, 8, 0, 24};  // through the middle, ending inside; one that is no edge
    std::set<Edge> creases{{11, 12}, {12, 13}, {8, 13}};
    const SubdivideOptions options{.scheme = quads ? SubdivisionScheme::CatmullClark : SubdivisionScheme::Loop,
                                   .crease_lines = true};
    const Mesh result = subdivide(mesh, options);
    expect_near(result, reference(mesh, quads, creases));
    // The lines have followed, so they are creases again.
    ASSERT_EQ(result.lines.size(), 14U);
    EXPECT_EQ(result.lines[12], 0U);
    EXPECT_EQ(result.lines[13], 24U);
    creases.clear();
    for (std::size_t i = 0; i < 12; i += 2) creases.insert(edge_of(result.lines[i], result.lines[i + 1]));
    SubdivideOptions twice = options;
    twice.levels = 2;
    const std::vector<glm::dvec3> expected = reference(result, quads, creases);
    const Mesh second = subdivide(result, options);
    const Mesh direct = subdivide(mesh, twice);
    expect_near(second, expected);
    for (std::size_t c = 0; c < second.corner_count(); ++c) {
      ASSERT_LT(glm::distance(second.positions[second.corners[c]], direct.positions[direct.corners[c]]), kRounded);
    }
  }
}

TEST(Subdivide, KnowsTheNextLevelsConnectivity) {
  for (const SubdivisionScheme scheme :
       {SubdivisionScheme::Loop, SubdivisionScheme::CatmullClark, SubdivisionScheme::Midpoint}) {
    const bool any = scheme != SubdivisionScheme::Loop;
    for (const Mesh& mesh : any ? polygon_meshes() : triangle_meshes()) {
      Mesh stepped = mesh.clone();
      for (int i = 0; i < 3; ++i) stepped = subdivide(stepped, {.scheme = scheme});
      const Mesh direct = subdivide(mesh, {.scheme = scheme, .levels = 3});
      ASSERT_NO_THROW(direct.check("direct"));
      ASSERT_EQ(direct.vertex_count(), stepped.vertex_count());
      ASSERT_EQ(direct.corner_count(), stepped.corner_count());
      for (std::size_t c = 0; c < direct.corner_count(); ++c) {
        ASSERT_LT(glm::distance(direct.positions[direct.corners[c]], stepped.positions[stepped.corners[c]]), kRounded);
      }
    }
  }
}

TEST(Subdivide, MovesVerticesByTheWeightsOfTheirSchemes) {
  // Vertices of the octahedron, whose neighbors cancel: Loop's 1 − 4 β with β = (5/8 − 9/64) / 4, in the limit
  // 3 / (3 + 32 β); √3's 1 − 4/9, 1 / (1 + 4/3).
  const Mesh octahedron = bare({.kind = PrimitiveKind::Octahedron});
  // A corner of the cube ±1 goes to 5/9 of itself, in the limit to half.
  const Mesh cube = bare({.kind = PrimitiveKind::Cube});
  struct {
    const Mesh& mesh;
    SubdivideOptions options;
    double factor;
  } const cases[] = {{octahedron, {.scheme = SubdivisionScheme::Loop}, 33.0 / 64},
                     {octahedron, {.scheme = SubdivisionScheme::Loop, .limit = true}, 24.0 / 55},
                     {octahedron, {.scheme = SubdivisionScheme::Sqrt3}, 5.0 / 9},
                     {octahedron, {.scheme = SubdivisionScheme::Sqrt3, .limit = true}, 3.0 / 7},
                     {cube, {.scheme = SubdivisionScheme::CatmullClark}, 5.0 / 9},
                     {cube, {.scheme = SubdivisionScheme::CatmullClark, .limit = true}, 1.0 / 2}};
  for (const auto& each : cases) {
    const Mesh result = subdivide(each.mesh, each.options);
    for (std::size_t v = 0; v < each.mesh.vertex_count(); ++v) {
      const glm::dvec3 expected = each.factor * glm::dvec3(each.mesh.positions[v]);
      EXPECT_LT(glm::distance(glm::dvec3(result.positions[v]), expected), kRounded) << each.factor;
    }
  }
}

TEST(Subdivide, LimitIsWhereManyLevelsGo) {
  // The limit of a vertex doesn't depend on the level that it is taken at: f32 roundings of each level are all.
  std::vector<std::pair<Mesh, SubdivideOptions>> cases;
  const auto add = [&](Mesh mesh, SubdivisionScheme scheme) {
    SubdivideOptions options;
    options.scheme = scheme;
    options.crease_lines = true;
    cases.emplace_back(std::move(mesh), options);
  };
  for (Mesh& mesh : triangle_meshes()) add(std::move(mesh), SubdivisionScheme::Loop);
  for (Mesh& mesh : polygon_meshes()) add(std::move(mesh), SubdivisionScheme::CatmullClark);
  for (const bool quads : {false, true}) {
    Mesh creased = sheet(4, !quads);
    scatter(creased, 0.3F, 6);
    creased.lines = {12, 13, 12, 7, 7, 6};  // darts at both ends
    add(std::move(creased), quads ? SubdivisionScheme::CatmullClark : SubdivisionScheme::Loop);
  }
  for (const PrimitiveKind kind : {PrimitiveKind::Tetrahedron, PrimitiveKind::Icosahedron}) {
    add(bare({.kind = kind}), SubdivisionScheme::Sqrt3);
  }
  for (auto& [mesh, options] : cases) {
    options.limit = true;
    options.levels = 1;
    const Mesh early = subdivide(mesh, options);
    options.levels = 4;
    const Mesh late = subdivide(mesh, options);
    for (std::size_t v = 0; v < early.vertex_count(); ++v) {
      ASSERT_LT(glm::distance(early.positions[v], late.positions[v]), 4 * kRounded) << "vertex " << v;
    }
    // And endless subdivision goes there: each level takes at least a third of the way.
    options.limit = false;
    options.levels = 7;
    const Mesh near = subdivide(mesh, options);
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
      ASSERT_LT(glm::distance(near.positions[v], late.positions[v]), 0.02F) << "vertex " << v;
    }
  }
}

TEST(Subdivide, LimitOfSqrt3BesideBordersAfterAnEvenLevel) {
  Mesh mesh = sheet(4, true);
  scatter(mesh, 0.3F, 7);
  const Mesh early = subdivide(mesh, {.scheme = SubdivisionScheme::Sqrt3, .levels = 2, .limit = true});
  const Mesh late = subdivide(mesh, {.scheme = SubdivisionScheme::Sqrt3, .levels = 6, .limit = true});
  for (std::size_t v = 0; v < early.vertex_count(); ++v) {
    ASSERT_LT(glm::distance(early.positions[v], late.positions[v]), 4 * kRounded) << "vertex " << v;
  }
}

TEST(Subdivide, CountsAreThoseOfTheSchemes) {
  for (const PrimitiveKind kind : {PrimitiveKind::Cube, PrimitiveKind::Icosahedron, PrimitiveKind::Torus,
                                   PrimitiveKind::Dodecahedron, PrimitiveKind::Plane, PrimitiveKind::Mobius}) {
    const Mesh mesh = bare({.kind = kind, .segments = 5});
    for (const auto scheme : {SubdivisionScheme::Loop, SubdivisionScheme::CatmullClark, SubdivisionScheme::Sqrt3,
                              SubdivisionScheme::Midpoint}) {
      const bool quads =
          scheme == SubdivisionScheme::CatmullClark || (scheme == SubdivisionScheme::Midpoint && !mesh.all_triangles());
      Topology before = topology(mesh);
      if (!quads) {  // n − 3 diagonals in each face
        before.edges += mesh.triangle_count() - mesh.face_count();
        before.faces = mesh.triangle_count();
      }
      for (int levels = 1; levels <= 4; ++levels) {
        const Topology after = topology(subdivide(mesh, {.scheme = scheme, .levels = levels}));
        const std::size_t borders =
            before.edges * 2 - (quads && levels == 1 ? mesh.corner_count() : (quads ? 4 : 3) * before.faces);
        std::size_t vertices = before.vertices + before.edges + (quads ? before.faces : 0);
        std::size_t faces = quads && levels == 1 ? mesh.corner_count() : 4 * before.faces;
        if (scheme == SubdivisionScheme::Sqrt3) {
          vertices = before.vertices + before.faces + (levels % 2 == 0 ? borders : 0);
          faces = 3 * before.faces;
        }
        EXPECT_EQ(after.vertices, vertices);
        EXPECT_EQ(after.faces, faces);
        EXPECT_EQ(after.euler(), before.euler());
        EXPECT_EQ(after.genus(), topology(mesh).genus());
        EXPECT_EQ(after.euler_poincare(), topology(mesh).euler_poincare());
        EXPECT_EQ(after.manifold(), true);
        before = after;
      }
    }
  }
}

TEST(Subdivide, APlaneStaysOne) {
  for (const auto scheme : {SubdivisionScheme::Loop, SubdivisionScheme::CatmullClark, SubdivisionScheme::Sqrt3,
                            SubdivisionScheme::Midpoint}) {
    for (const bool limit : {false, true}) {
      Mesh mesh = sheet(8, scheme != SubdivisionScheme::CatmullClark);
      for (glm::vec3& each : mesh.positions) each.z = 0.5F * each.x - 0.25F * each.y;
      const Mesh result = subdivide(mesh, {.scheme = scheme, .levels = 2, .limit = limit});
      for (const glm::vec3& each : result.positions) {
        EXPECT_NEAR(each.z, 0.5F * each.x - 0.25F * each.y, 2 * kRounded);
      }
      // Regular weights keep linear functions: inner vertices stay.
      for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        const glm::vec3 p = mesh.positions[v];
        if (std::min(p.x, p.y) < 3 || std::max(p.x, p.y) > 5) continue;
        EXPECT_LT(glm::distance(result.positions[v], p), 2 * kRounded);
      }
    }
  }
}

TEST(Subdivide, BordersDependOnBordersOnly) {
  // 1 6 1 ÷ 8 on the old vertices, means between them; √3 after two levels 4 19 4 ÷ 27 and 10 16 1 ÷ 27.
  for (const auto scheme : {SubdivisionScheme::Loop, SubdivisionScheme::CatmullClark, SubdivisionScheme::Sqrt3}) {
    Mesh mesh = sheet(4, scheme != SubdivisionScheme::CatmullClark);
    const SubdivideOptions options{.scheme = scheme, .levels = 2};
    const Mesh flat = subdivide(mesh, options);
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
      const glm::vec3 p = mesh.positions[v];
      if (std::min(p.x, p.y) > 0 && std::max(p.x, p.y) < 4) mesh.positions[v] += glm::vec3(0.3F, 0.1F, 5);
    }
    const Mesh bumpy = subdivide(mesh, options);
    std::set<std::uint32_t> border;
    for (const auto& [edge, faces] : edges_of(faces_of(bumpy))) {
      if (faces.size() == 1) border.insert({edge.first, edge.second});
    }
    EXPECT_EQ(border.size(), scheme == SubdivisionScheme::Sqrt3 ? 48U : 64U);
    for (const std::uint32_t v : border) EXPECT_EQ(bumpy.positions[v], flat.positions[v]);
    const glm::vec3 corner = flat.positions[0];
    if (scheme == SubdivisionScheme::Sqrt3) {
      EXPECT_NEAR(corner.x, 4.0F / 27, kRounded);
      EXPECT_NEAR(flat.positions[2].x, 2, kRounded);
    } else {
      // (1/8, 1/8), then 6/8 of it and 1/8 of the middles (1/2, 0), (0, 1/2).
      EXPECT_NEAR(corner.x, 0.75F / 8 + 0.5F / 8, kRounded);
    }
    SubdivideOptions kept = options;
    kept.keep_corners = true;
    const Mesh square = subdivide(mesh, kept);
    // In the lower left and the upper right two triangles meet the corner, of quads one.
    const std::size_t lone = scheme == SubdivisionScheme::CatmullClark ? 0 : 4;
    EXPECT_EQ(square.positions[lone], mesh.positions[lone]);
  }
}

TEST(Subdivide, KeepsSharpEdgesByAngle) {
  const Mesh cube = bare({.kind = PrimitiveKind::Cube});
  for (const auto scheme : {SubdivisionScheme::Loop, SubdivisionScheme::CatmullClark, SubdivisionScheme::Sqrt3}) {
    const Mesh kept = subdivide(cube, {.scheme = scheme, .levels = 4, .crease_angle_deg = 89});
    EXPECT_NEAR(volume_of(kept), 8, 1e-5);
    EXPECT_NEAR(area_of(kept), 24, 1e-5);
    const Mesh round = subdivide(cube, {.scheme = scheme, .levels = 4, .crease_angle_deg = 91});
    EXPECT_LT(volume_of(round), 6);
  }
  // The rims of a cylinder stay circles of B-splines, at their heights; its lids stay flat.
  const Mesh cylinder = bare({.kind = PrimitiveKind::Cylinder, .segments = 12});
  const Mesh kept =
      subdivide(cylinder, {.scheme = SubdivisionScheme::CatmullClark, .levels = 3, .crease_angle_deg = 60});
  float top = 0;
  for (std::size_t v = 0; v < kept.vertex_count(); ++v) top = std::max(top, kept.positions[v].y);
  EXPECT_EQ(top, 1);
  EXPECT_GT(volume_of(kept), 0.9 * volume_of(cylinder));
}

TEST(Subdivide, MidpointKeepsVolumeAndArea) {
  std::vector<Mesh> meshes;
  for (const PrimitiveKind kind : {PrimitiveKind::Cube, PrimitiveKind::Dodecahedron, PrimitiveKind::IcoSphere,
                                   PrimitiveKind::Cylinder, PrimitiveKind::Cone}) {
    meshes.push_back(bare({.kind = kind, .segments = 9}));
  }
  // A prism over the letter U: the mean of its corners lies outside.
  std::vector<glm::vec3> corners;
  const float plan[][2] = {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 0.5F}, {1, 0.5F}, {1, 3}, {0, 3}};
  for (const float z : {0.0F, 1.0F}) {
    for (const auto& p : plan) corners.emplace_back(p[0], p[1], z);
  }
  Polygons faces{{7, 6, 5, 4, 3, 2, 1, 0}, {8, 9, 10, 11, 12, 13, 14, 15}};
  for (std::uint32_t i = 0; i < 8; ++i) faces.push_back({i, (i + 1) % 8, (i + 1) % 8 + 8, i + 8});
  meshes.push_back(mesh_of(corners, faces));
  for (const Mesh& mesh : meshes) {
    const Mesh fine = subdivide(mesh, {.scheme = SubdivisionScheme::Midpoint, .levels = 3});
    EXPECT_NEAR(volume_of(fine), volume_of(mesh), 1e-6 * std::abs(volume_of(mesh)));
    EXPECT_NEAR(area_of(fine), area_of(mesh), 1e-6 * area_of(mesh));
    EXPECT_TRUE(topology(fine).printable());
    EXPECT_EQ(fine.all_triangles(), mesh.all_triangles());
  }
  EXPECT_NEAR(area_of(meshes.back()), 2 * 6.5 + 17, 1e-5) << "the plan itself";
}

TEST(Subdivide, PartsThatAVertexJoinsStayJoined) {
  // Two tetrahedra with a common tip.
  const Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
                            {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {0, 4, 5}, {0, 6, 4}, {0, 5, 6}, {4, 6, 5}});
  for (const auto scheme : {SubdivisionScheme::Loop, SubdivisionScheme::CatmullClark, SubdivisionScheme::Sqrt3}) {
    const Mesh result = subdivide(mesh, {.scheme = scheme, .levels = 3, .limit = true});
    EXPECT_EQ(result.positions[0], glm::vec3(0));
    EXPECT_EQ(topology(result).count(MeshFaultKind::SingularVertex), 1U);
  }
}

TEST(Subdivide, DoesntDependOnTheOrderOfFaces) {
  std::mt19937 random(11);
  for (const auto scheme : {SubdivisionScheme::Loop, SubdivisionScheme::CatmullClark, SubdivisionScheme::Sqrt3,
                            SubdivisionScheme::Midpoint}) {
    Mesh mesh = bare({.kind = PrimitiveKind::IcoSphere, .subdivisions = 2});
    scatter(mesh, 0.1F, 3);
    Polygons faces = faces_of(mesh);
    std::shuffle(faces.begin(), faces.end(), random);
    for (auto& face : faces) std::rotate(face.begin(), face.begin() + random() % 3, face.end());
    const auto sorted = [&](const Mesh& of) {
      const Mesh fine = subdivide(of, {.scheme = scheme, .levels = 2});
      std::vector<std::array<int, 3>> grid;
      for (const glm::vec3& p : fine.positions) {
        std::array<int, 3> cell{};
        for (int i = 0; i < 3; ++i) cell[static_cast<std::size_t>(i)] = static_cast<int>(std::lround(p[i] * 1e4F));
        grid.push_back(cell);
      }
      std::sort(grid.begin(), grid.end());
      return grid;
    };
    const auto a = sorted(mesh);
    const auto b = sorted(mesh_of({mesh.positions.begin(), mesh.positions.end()}, faces));
    ASSERT_EQ(a.size(), b.size());
    // A last bit may put a coordinate into the next cell: few are.
    std::size_t apart = 0;
    for (std::size_t i = 0; i < a.size(); ++i) apart += a[i] != b[i] ? 1 : 0;
    EXPECT_LT(apart, a.size() / 50);
  }
}

TEST(Subdivide, TakesAnySoup) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const bool triangles = seed % 2 == 0;
    Mesh mesh = soup(seed, triangles);
    for (std::uint32_t i = 0; i + 1 < mesh.vertex_count(); ++i) mesh.lines.insert(mesh.lines.end(), {i, i + 1});
    for (const auto scheme : {SubdivisionScheme::Loop, SubdivisionScheme::CatmullClark, SubdivisionScheme::Sqrt3,
                              SubdivisionScheme::Midpoint}) {
      SubdivideOptions options{.scheme = scheme, .levels = 3, .limit = true};
      if (seed % 3 == 1) options.crease_angle_deg = 30;
      options.crease_lines = seed % 5 == 1;
      options.keep_corners = seed % 7 == 1;
      const Mesh result = subdivide(mesh, options);
      ASSERT_NO_THROW(result.check("result"));
      // Weights are positive and sum to 1: nothing leaves the box, and every number is one.
      for (const glm::vec3& p : result.positions) {
        for (int i = 0; i < 3; ++i) ASSERT_LE(std::abs(p[i]), 1.00001F);
      }
      // Each level has twice as many border edges.
      if (scheme == SubdivisionScheme::Sqrt3) continue;
      const std::size_t before = topology(subdivide(mesh, {.scheme = scheme})).count(MeshFaultKind::BorderEdge);
      EXPECT_EQ(topology(result).count(MeshFaultKind::BorderEdge), 4 * before);
    }
  }
}

TEST(Subdivide, KeepsWhatHasNoFaces) {
  Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {7, 8, 9}}, {{0, 1, 2}});
  mesh.lines = {0, 3, 1, 2};
  const Mesh result = subdivide(mesh);
  EXPECT_EQ(result.positions[3], glm::vec3(7, 8, 9));
  EXPECT_EQ(result.lines.size(), 6U);
  const Mesh cloud = mesh_of({{1, 2, 3}, {4, 5, 6}}, {});
  for (const auto scheme : {SubdivisionScheme::Loop, SubdivisionScheme::CatmullClark, SubdivisionScheme::Sqrt3,
                            SubdivisionScheme::Midpoint}) {
    EXPECT_EQ(subdivide(cloud, {.scheme = scheme, .levels = 5, .limit = true}).positions, cloud.positions);
    EXPECT_EQ(subdivide(Mesh(), {.scheme = scheme, .levels = 5}).vertex_count(), 0U);
  }
}

TEST(Subdivide, NanSpreadsOneRingOfFacesALevel) {
  Mesh mesh = sheet(8, true);
  mesh.positions[40].z = std::numeric_limits<float>::quiet_NaN();  // (4, 4)
  const Mesh result = subdivide(mesh, {.levels = 2});
  for (const glm::vec3& p : result.positions) {
    if (std::isfinite(p.z)) continue;
    EXPECT_LE(std::max(std::abs(p.x - 4), std::abs(p.y - 4)), 1.5F);
  }
}

TEST(Subdivide, RefusesWhatDoesntFit) {
  const Mesh mesh = bare({.kind = PrimitiveKind::IcoSphere, .subdivisions = 4});
  EXPECT_THROW(subdivide(mesh, {.levels = 0}), Error);
  EXPECT_THROW(subdivide(mesh, {.levels = 17}), Error);
  EXPECT_THROW(subdivide(mesh, {.crease_angle_deg = -1}), Error);
  try {
    azulejo::Run run;
    run.limits.memory_bytes = std::int64_t{1} << 62;
    subdivide(mesh, {.levels = 16}, run);  // 6.6 · 10¹³ corners
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Error::Resource);
  }
  azulejo::Run run;
  run.limits.memory_bytes = 1 << 20;
  EXPECT_THROW(subdivide(mesh, {.levels = 2}, run), Error);
  EXPECT_NO_THROW(subdivide(mesh, {.levels = 2}));
}

}  // namespace
}  // namespace azulejo
