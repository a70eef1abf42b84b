#include "azulejo/modelling/winged_edge_report.h"

#include <string>

#include <gtest/gtest.h>

#include "azulejo/io/weld.h"
#include "azulejo/modelling/polygon_soup.h"
#include "azulejo/modelling/primitive.h"

namespace azulejo {
namespace {

/// n-gons, triangles, attributes of every domain, morph targets, materials.
Mesh full_mesh(PrimitiveKind kind) {
  Mesh mesh = primitive({.kind = kind});
  Array<float> of_vertex;
  Array<std::uint32_t> of_corner;
  Array<std::uint8_t> of_face;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) of_vertex.push_back(static_cast<float>(v) + 0.5F);
  for (std::uint32_t c = 0; c < mesh.corner_count(); ++c) of_corner.push_back(c);
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) of_face.push_back(static_cast<std::uint8_t>(f % 251));
  mesh.material.assign(of_face.begin(), of_face.end());
  mesh.attributes.push_back({"of_vertex", Domain::Vertex, 1, std::move(of_vertex)});
  mesh.attributes.push_back({"of_corner", Domain::Corner, 1, std::move(of_corner)});
  mesh.attributes.push_back({"of_face", Domain::Face, 1, std::move(of_face)});
  mesh.morph_targets.push_back({"twice", mesh.positions, {}});
  mesh.name = "full";
  return mesh;
}

TEST(WingedEdge, RoundTripLosesNothing) {
  for (const PrimitiveKind kind : {PrimitiveKind::Cube, PrimitiveKind::Cylinder, PrimitiveKind::Torus,
                                   PrimitiveKind::Plane, PrimitiveKind::IcoSphere, PrimitiveKind::Disk}) {
    SCOPED_TRACE(enum_names(kind)[static_cast<std::size_t>(kind)]);
    const Mesh mesh = full_mesh(kind);
    const WingedEdgeOfMesh made = winged_edge(mesh);
    EXPECT_TRUE(made.changes.none());
    const Mesh back = mesh_of(made.solid, &mesh);
    EXPECT_EQ(back.name, mesh.name);
    EXPECT_EQ(back.positions, mesh.positions);
    EXPECT_EQ(back.corners, mesh.corners);
    EXPECT_EQ(back.face_offsets, mesh.face_offsets);
    EXPECT_EQ(back.material, mesh.material);
    ASSERT_EQ(back.morph_targets.size(), 1U);
    EXPECT_EQ(back.morph_targets[0].positions, mesh.morph_targets[0].positions);
    ASSERT_EQ(back.attributes.size(), mesh.attributes.size());
    for (std::size_t a = 0; a < mesh.attributes.size(); ++a) {
      EXPECT_EQ(back.attributes[a].values, mesh.attributes[a].values) << mesh.attributes[a].name;
    }
  }
}

TEST(WingedEdge, GivesBackALargeFaceInTime) {
  // One face of as many corners as a mesh may have: steps for each corner, not for each pair.
  Mesh mesh;
  constexpr std::uint32_t kCorners = 300000;
  mesh.face_offsets = {0, kCorners};
  for (std::uint32_t v = 0; v < kCorners; ++v) {
    mesh.positions.emplace_back(static_cast<float>(v), static_cast<float>(v % 2), 0);
    mesh.corners.push_back(v);
  }
  const WingedEdgeOfMesh made = winged_edge(mesh);
  EXPECT_EQ(mesh_of(made.solid, &mesh).corners, mesh.corners);
}

TEST(PolygonSoup, WeldsBackToTheMesh) {
  for (const PrimitiveKind kind : {PrimitiveKind::Cube, PrimitiveKind::Cylinder, PrimitiveKind::Torus}) {
    const Mesh mesh = full_mesh(kind);
    const Mesh soup = polygon_soup(mesh);
    soup.check("soup");
    ASSERT_EQ(soup.vertex_count(), mesh.corner_count());
    const Welded welded = weld_exactly(soup.positions, {});
    ASSERT_EQ(welded.positions.size(), mesh.vertex_count());
    // The same but for the order of the vertices.
    for (std::size_t c = 0; c < mesh.corner_count(); ++c) {
      EXPECT_EQ(welded.positions[welded.corners[soup.corners[c]]], mesh.positions[mesh.corners[c]]);
      EXPECT_EQ((*soup.find("of_vertex")->get<float>())[c], static_cast<float>(mesh.corners[c]) + 0.5F);
      EXPECT_EQ((*soup.find("of_corner")->get<std::uint32_t>())[c], c);
    }
    EXPECT_EQ(soup.morph_targets[0].positions, soup.positions);
    EXPECT_EQ(polygon_soup_bytes(mesh), 12 * mesh.corner_count() + 4 * mesh.face_offsets.size());
  }
}

TEST(WingedEdgeReport, TellsTableRecordsAndMemory) {
  const Mesh mesh = primitive({.kind = PrimitiveKind::Tetrahedron});
  const WingedEdgeOfMesh made = winged_edge(mesh);
  const Report report = report_of(made, mesh, {});
  std::string lines;
  for (std::size_t i = 0; i < report.json["table"].size(); ++i) lines += report.json["table"][i].text() + "\n";
  EXPECT_EQ(lines, made.solid.table());
  const Json records = report.json["records"];
  ASSERT_EQ(records["edges"].size(), 6U);
  for (std::uint32_t e = 0; e < 6; ++e) {
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(records["edges"][e]["vertices"][i].number(-1), made.solid.edge(e).vertex[i]);
      EXPECT_EQ(records["edges"][e]["faces"][i].number(-1), made.solid.edge(e).face[i]);
    }
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(records["edges"][e]["wings"][i].number(-1), made.solid.edge(e).wing[i]);
    }
  }
  EXPECT_EQ(report.json["bytes_polygon_soup"].number(), 4 * 3 * 12);
  EXPECT_EQ(report.json["bytes_vertex_list"].number(), 4 * 12 + 4 * 3 * 4);
  EXPECT_EQ(report.json["bytes_winged_edge"].number(), 6 * 32 + 4 * 20 + 4 * 24);
  EXPECT_TRUE(report_of(made, mesh, {.listed = 5}).json["table"].is_null());
}

}  // namespace
}  // namespace azulejo
