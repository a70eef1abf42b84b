#include <gtest/gtest.h>

#include "azulejo/modelling/subdivide.h"
#include "azulejo/modelling/subdivision_testing.h"

namespace azulejo {
namespace {

using namespace testing;

constexpr SubdivisionScheme kSchemes[] = {SubdivisionScheme::Loop, SubdivisionScheme::CatmullClark,
                                          SubdivisionScheme::Sqrt3, SubdivisionScheme::Midpoint};

/// The positions as an attribute.
Attribute position_attribute(const Mesh& mesh, Domain domain) {
  Array<float> values;
  const auto add = [&](const glm::vec3& p) { values.insert(values.end(), {p.x, p.y, p.z}); };
  if (domain == Domain::Vertex) {
    for (const glm::vec3& p : mesh.positions) add(p);
  } else {
    for (const std::uint32_t corner : mesh.corners) add(mesh.positions[corner]);
  }
  return {"place", domain, 3, std::move(values)};
}

TEST(SubdivideAttributes, OfVerticesGoAsPositionsDo) {
  for (const SubdivisionScheme scheme : kSchemes) {
    Mesh mesh = bare({.kind = PrimitiveKind::Cube});
    scatter(mesh, 0.2F, 1);
    mesh.attributes.push_back(position_attribute(mesh, Domain::Vertex));
    mesh.morph_targets.push_back({"morph", mesh.positions, {}});
    mesh.morph_targets.push_back({"nothing", {}, mesh.positions});
    const Mesh result = subdivide(mesh, {.scheme = scheme, .levels = 3, .limit = true});
    EXPECT_EQ(*result.attributes[0].get<float>(), *position_attribute(result, Domain::Vertex).get<float>());
    EXPECT_EQ(result.morph_targets[0].positions, result.positions);
    EXPECT_TRUE(result.morph_targets[1].positions.empty());
    EXPECT_TRUE(result.morph_targets[1].normals.empty());
    EXPECT_NO_THROW(result.check("result"));
  }
}

TEST(SubdivideAttributes, OfCornersAreLinearInTheirFaces) {
  // With positions that stay on the faces they are those positions.
  for (const bool triangles : {false, true}) {
    Mesh mesh = triangles ? bare({.kind = PrimitiveKind::Icosahedron}) : bare({.kind = PrimitiveKind::Dodecahedron});
    mesh.attributes.push_back(position_attribute(mesh, Domain::Corner));
    const Mesh result = subdivide(mesh, {.scheme = SubdivisionScheme::Midpoint, .levels = 3});
    const Attribute places = position_attribute(result, Domain::Corner);
    const Array<float>& expected = *places.get<float>();
    const Array<float>& values = *result.attributes[0].get<float>();
    ASSERT_EQ(values.size(), expected.size());
    for (std::size_t i = 0; i < values.size(); ++i) ASSERT_NEAR(values[i], expected[i], 1e-6F);
    // And they don't depend on where smooth schemes take the vertices.
    const auto smooth = triangles ? SubdivisionScheme::Loop : SubdivisionScheme::CatmullClark;
    const Mesh round = subdivide(mesh, {.scheme = smooth, .levels = 3});
    EXPECT_EQ(*round.attributes[0].get<float>(), values);
  }
}

TEST(SubdivideAttributes, SeamsStayAndSqrt3RefusesThem) {
  Mesh mesh = sheet(2, true);
  Array<float> island;  // of each triangle
  Array<std::uint32_t> face_number;
  for (std::size_t c = 0; c < mesh.corner_count(); ++c) island.push_back(static_cast<float>(c / 3));
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) face_number.push_back(f);
  mesh.attributes.push_back({"island", Domain::Corner, 1, island});
  mesh.attributes.push_back(position_attribute(mesh, Domain::Corner));
  mesh.attributes.push_back({"number", Domain::Face, 1, face_number});
  mesh.material = face_number;
  for (const SubdivisionScheme scheme : kSchemes) {
    azulejo::Run run;
    std::vector<std::string> warnings;
    run.warn = [&](const std::string& text) { warnings.push_back(text); };
    const Mesh result = subdivide(mesh, {.scheme = scheme, .levels = 2}, run);
    EXPECT_EQ(result.material, *result.find("number")->get<std::uint32_t>());
    EXPECT_EQ(result.material.size(), result.face_count());
    std::vector<int> counts(mesh.face_count(), 0);
    for (const std::uint32_t f : result.material) ++counts[f];
    const int parts = scheme == SubdivisionScheme::Sqrt3 ? 9 : scheme == SubdivisionScheme::CatmullClark ? 12 : 16;
    for (const int count : counts) EXPECT_EQ(count, parts);
    if (scheme == SubdivisionScheme::Sqrt3) {
      EXPECT_EQ(result.find("island"), nullptr);
      EXPECT_EQ(result.find("place")->domain, Domain::Vertex);
      ASSERT_EQ(warnings.size(), 1U);
      EXPECT_NE(warnings[0].find("island"), std::string::npos);
      continue;
    }
    EXPECT_TRUE(warnings.empty());
    const Array<float>& values = *result.find("island")->get<float>();
    for (std::size_t f = 0; f < result.face_count(); ++f) {
      for (std::size_t c = result.face_begin(f); c < result.face_end(f); ++c) {
        ASSERT_EQ(values[c], static_cast<float>(result.material[f]));
      }
    }
  }
}

TEST(SubdivideAttributes, BytesAreRoundedOnceAndNumbersHandedOn) {
  Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  mesh.attributes.push_back({"COLOR_0", Domain::Vertex, 1, Array<std::uint8_t>{0, 1, 0}});
  mesh.attributes.push_back({"id", Domain::Vertex, 2, Array<std::uint32_t>{7, 8, 9, 10, 11, 12}});
  mesh.attributes.push_back({"corner", Domain::Corner, 1, Array<std::uint32_t>{1, 2, 3}});
  const Mesh result = subdivide(mesh, {.scheme = SubdivisionScheme::Midpoint, .levels = 2});
  // Edges in order: 0–1, 0–2, 1–2; halves of 0–1 first at the next level: 0.25 and 0.75 of a unit.
  const Array<std::uint8_t>& colors = *result.find("COLOR_0")->get<std::uint8_t>();
  EXPECT_EQ(colors[6], 0);
  EXPECT_EQ(colors[7], 1);
  const Array<std::uint32_t>& ids = *result.find("id")->get<std::uint32_t>();
  for (std::size_t v = 0; v < result.vertex_count(); ++v) EXPECT_EQ(ids[2 * v] + 1, ids[2 * v + 1]);
  EXPECT_EQ(ids[2], 9U);
  const Array<std::uint32_t>& corners = *result.find("corner")->get<std::uint32_t>();
  ASSERT_EQ(corners.size(), result.corner_count());
  for (std::size_t c = 0; c < 9; ++c) EXPECT_EQ(corners[c], 1U);  // the parts at the first corner
}

TEST(SubdivideAttributes, NormalsAreThoseOfTheNewSurface) {
  for (const SubdivisionScheme scheme : kSchemes) {
    const Mesh mesh = primitive({.kind = PrimitiveKind::IcoSphere, .subdivisions = 2});
    ASSERT_NE(mesh.find("NORMAL"), nullptr);
    const Mesh result = subdivide(mesh, {.scheme = scheme, .levels = 2});
    const Attribute* normals = result.find("NORMAL");
    ASSERT_NE(normals, nullptr);
    for (std::size_t v = 0; v < result.vertex_count(); ++v) {
      const Array<float>& n = *normals->get<float>();
      const std::size_t i = normals->domain == Domain::Vertex ? v : 0;
      if (normals->domain != Domain::Vertex) break;
      const glm::vec3 normal(n[3 * i], n[3 * i + 1], n[3 * i + 2]);
      EXPECT_NEAR(glm::length(normal), 1, 1e-5F);
      EXPECT_GT(glm::dot(normal, glm::normalize(result.positions[v])), 0.98F);
    }
  }
  // A cube with sharp edges has the normals of its sides.
  const Mesh cube = subdivide(primitive({.kind = PrimitiveKind::Cube}),
                              {.scheme = SubdivisionScheme::CatmullClark, .levels = 2, .crease_angle_deg = 45});
  EXPECT_EQ(cube.find("NORMAL")->domain, Domain::Corner);
  EXPECT_EQ(subdivide(bare({.kind = PrimitiveKind::Cube})).find("NORMAL"), nullptr);
}

TEST(SubdivideAttributes, AreTheSameForAnyNumberOfThreads) {
  for (const bool triangles : {false, true}) {
    Mesh mesh = sheet(80, triangles);
    scatter(mesh, 0.2F, 1);
    mesh.attributes.push_back(position_attribute(mesh, Domain::Vertex));
    mesh.attributes.push_back(position_attribute(mesh, Domain::Corner));
    Array<std::uint32_t> numbers(mesh.vertex_count());
    for (std::uint32_t v = 0; v < numbers.size(); ++v) numbers[v] = v;
    mesh.attributes.push_back({"number", Domain::Vertex, 1, numbers});
    for (std::uint32_t v = 100; v < 160; ++v) mesh.lines.insert(mesh.lines.end(), {v, v + 1});
    mesh.material.assign(mesh.face_count(), 3);
    for (const SubdivisionScheme scheme : kSchemes) {
      std::vector<Mesh> results;
      for (const int threads : {1, 2, 5}) {
        azulejo::Run run;
        run.threads = threads;
        results.push_back(subdivide(
            mesh, {.scheme = scheme, .levels = 2, .limit = true, .crease_angle_deg = 30, .crease_lines = true}, run));
      }
      for (const Mesh& each : results) {
        EXPECT_EQ(each.positions, results[0].positions);
        EXPECT_EQ(each.corners, results[0].corners);
        EXPECT_EQ(each.lines, results[0].lines);
        EXPECT_EQ(each.material, results[0].material);
        for (std::size_t i = 0; i < each.attributes.size(); ++i) {
          EXPECT_EQ(each.attributes[i].values, results[0].attributes[i].values);
        }
      }
    }
  }
}

}  // namespace
}  // namespace azulejo
