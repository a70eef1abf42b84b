#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "azulejo/core/error.h"
#include "azulejo/modelling/normals.h"
#include "azulejo/modelling/polygon_soup.h"
#include "azulejo/modelling/primitive.h"

namespace azulejo {
namespace {

glm::vec3 at(const Attribute& attribute, std::size_t element) {
  const Array<float>& values = *attribute.get<float>();
  return {values[3 * element], values[3 * element + 1], values[3 * element + 2]};
}

double volume(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto place = [&](std::size_t c) { return glm::dvec3(mesh.positions[mesh.corners[c]]); };
    const std::size_t first = mesh.face_begin(f);
    for (std::size_t c = first + 2; c < mesh.face_end(f); ++c) {
      sum += glm::dot(place(first), glm::cross(place(c - 1), place(c))) / 6;
    }
  }
  return sum;
}

TEST(WithNormals, OfASphereAreItsRadii) {
  const Mesh sphere = primitive({.kind = PrimitiveKind::IcoSphere, .subdivisions = 4});
  for (const NormalsFrom weight : {NormalsFrom::Angle, NormalsFrom::Area, NormalsFrom::Uniform}) {
    const Mesh mesh = normals(sphere, {.weight = weight});
    const Attribute& normals = *mesh.find("NORMAL");
    ASSERT_EQ(normals.domain, Domain::Vertex);
    // Edges are at most 0.09 long: faces differ from the sphere by half of that, and their mean by its square.
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
      EXPECT_LT(glm::distance(at(normals, v), mesh.positions[v]), 0.01F);
    }
  }
}

TEST(WithNormals, OfFacesAreTheirCorners) {
  const Mesh mesh = normals(primitive({.kind = PrimitiveKind::Dodecahedron}), {.weight = NormalsFrom::Face});
  const Attribute& normals = *mesh.find("NORMAL");
  ASSERT_EQ(normals.domain, Domain::Corner);
  const Array<glm::vec3> of_faces = face_normals(mesh);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    for (std::size_t c = mesh.face_begin(f); c < mesh.face_end(f); ++c) EXPECT_EQ(at(normals, c), of_faces[f]);
  }
}

TEST(WithNormals, CreasesAreInDegrees) {
  const Mesh cube = primitive({.kind = PrimitiveKind::Cube});
  EXPECT_EQ(normals(cube, {.crease_angle_deg = 91}).find("NORMAL")->domain, Domain::Vertex);
  const Mesh sharp = normals(cube, {.crease_angle_deg = 89});
  ASSERT_EQ(sharp.find("NORMAL")->domain, Domain::Corner);
  const Array<glm::vec3> of_faces = face_normals(cube);
  for (std::size_t c = 0; c < 24; ++c) EXPECT_LT(glm::distance(at(*sharp.find("NORMAL"), c), of_faces[c / 4]), 1e-6F);
  EXPECT_EQ(normals(cube, {.crease_angle_deg = 180}).find("NORMAL")->domain, Domain::Vertex);
  EXPECT_THROW(normals(cube, {.crease_angle_deg = -1}), Error);
  EXPECT_THROW(normals(cube, {.crease_angle_deg = std::numeric_limits<float>::quiet_NaN()}), Error);
}

TEST(WithNormals, ByPositionAreThoseOfTheWeldedMesh) {
  Mesh torus = primitive({.kind = PrimitiveKind::Torus, .segments = 12, .rings = 8});
  const Mesh whole = normals(torus);
  const Mesh soup = normals(polygon_soup(torus), {.by_position = true});
  ASSERT_EQ(soup.find("NORMAL")->domain, Domain::Vertex);
  for (std::size_t c = 0; c < torus.corner_count(); ++c) {
    EXPECT_LT(glm::distance(at(*soup.find("NORMAL"), c), at(*whole.find("NORMAL"), torus.corners[c])), 1e-6F);
  }
  const Mesh apart = normals(polygon_soup(torus));
  EXPECT_GT(glm::distance(at(*apart.find("NORMAL"), 0), at(*whole.find("NORMAL"), torus.corners[0])), 0.05F);
}

/// Attributes of corners and vertices, normals, tangents, morphs.
Mesh full_mesh() {
  Mesh mesh = primitive({.kind = PrimitiveKind::Cylinder, .segments = 7});
  Array<std::uint32_t> corner;
  Array<float> tangent;
  for (std::uint32_t c = 0; c < mesh.corner_count(); ++c) {
    corner.push_back(mesh.corners[c]);
    tangent.insert(tangent.end(), {1, 0, 0, c % 2 == 0 ? 1.0F : -1.0F});
  }
  mesh.attributes.push_back({"vertex_of_corner", Domain::Corner, 1, std::move(corner)});
  mesh.attributes.push_back({"TANGENT", Domain::Corner, 4, std::move(tangent)});
  mesh.morph_targets.push_back({"more", mesh.positions, mesh.positions});
  return mesh;
}

TEST(Flipped, TurnsTheInsideOut) {
  const Mesh mesh = full_mesh();
  const Mesh turned = flipped(mesh);
  turned.check("flipped");
  EXPECT_NEAR(volume(turned), -volume(mesh), 1e-6);
  const Attribute& kept = *turned.find("vertex_of_corner");
  for (std::size_t c = 0; c < turned.corner_count(); ++c) {
    EXPECT_EQ((*kept.get<std::uint32_t>())[c], turned.corners[c]) << "attributes stay with their corners";
  }
  const Array<glm::vec3> faces = face_normals(turned);
  const Attribute& normals = *turned.find("NORMAL");
  ASSERT_EQ(normals.domain, Domain::Corner);
  for (std::size_t f = 0; f < turned.face_count(); ++f) {
    for (std::size_t c = turned.face_begin(f); c < turned.face_end(f); ++c) {
      EXPECT_GT(glm::dot(at(normals, c), faces[f]), 0.5F) << "normals are those of the other side";
    }
  }
  EXPECT_EQ(turned.morph_targets[0].normals[0], -mesh.morph_targets[0].normals[0]);
}

TEST(Flipped, TwiceIsNothing) {
  const Mesh mesh = full_mesh();
  const Mesh again = flipped(flipped(mesh));
  EXPECT_EQ(again.corners, mesh.corners);
  for (std::size_t a = 0; a < mesh.attributes.size(); ++a) {
    EXPECT_EQ(again.attributes[a].values, mesh.attributes[a].values) << mesh.attributes[a].name;
  }
  EXPECT_EQ(again.morph_targets[0].normals, mesh.morph_targets[0].normals);
}

TEST(WithNormals, LeaveOutWhatBelongedToTheOldOnes) {
  const Mesh mesh = normals(full_mesh(), {.flip = true});
  mesh.check("normals");
  EXPECT_EQ(mesh.find("TANGENT"), nullptr);
  EXPECT_NE(mesh.find("TEXCOORD_0"), nullptr);
  EXPECT_NE(mesh.find("vertex_of_corner"), nullptr);
  EXPECT_TRUE(mesh.morph_targets[0].normals.empty());
  EXPECT_FALSE(mesh.morph_targets[0].positions.empty());
  EXPECT_LT(volume(mesh), 0);
}

TEST(WithNormals, OfPointsAreKept) {
  Mesh points;
  points.positions = {{1, 2, 3}, {4, 5, 6}};
  points.attributes.push_back({"NORMAL", Domain::Vertex, 3, Array<float>{0, 0, 1, 1, 0, 0}});
  const Mesh same = normals(points);
  EXPECT_EQ(same.attributes[0].values, points.attributes[0].values);
  EXPECT_EQ(at(*normals(points, {.flip = true}).find("NORMAL"), 1), glm::vec3(-1, 0, 0));
  EXPECT_TRUE(normals(Mesh()).attributes.empty());
}

}  // namespace
}  // namespace azulejo
