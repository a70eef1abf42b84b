#include "azulejo/modelling/topology_marks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include "azulejo/modelling/primitive.h"
#include "azulejo/modelling/sight.h"

namespace azulejo {
namespace {

/// A cube without one of its six faces.
Mesh open_cube(std::size_t left_out) {
  Mesh mesh = primitive({.kind = PrimitiveKind::Cube});
  Mesh open;
  open.positions = mesh.positions;
  open.face_offsets = {0};
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    if (f == left_out) continue;
    for (std::size_t c = mesh.face_begin(f); c < mesh.face_end(f); ++c) open.corners.push_back(mesh.corners[c]);
    open.face_offsets.push_back(static_cast<std::uint32_t>(open.corners.size()));
  }
  return open;
}

MarkedScene marked(Mesh mesh, std::size_t at_most = 1000) {
  const Topology found = topology(mesh);
  return mark_faults(scene_of(std::move(mesh)), {&found, 1}, at_most);
}

const Node* find(const Scene& scene, const std::string& name, bool camera) {
  const auto found = std::find_if(scene.nodes.begin(), scene.nodes.end(), [&](const Node& node) {
    return node.name == name && static_cast<bool>(node.camera) == camera;
  });
  return found != scene.nodes.end() ? &*found : nullptr;
}

glm::vec3 eye_of(const Scene& scene, const std::string& camera) {
  return glm::vec3(parent_from_node(*find(scene, camera, true))[3]);
}

/// Whether a camera has a place in its picture.
bool in_picture(const Scene& scene, const std::string& name, const glm::vec3& place) {
  const Node& node = *find(scene, name, true);
  const Camera& camera = scene.cameras[node.camera.index];
  const glm::vec4 seen = glm::inverse(parent_from_node(node)) * glm::vec4(place, 1);
  const float slope = std::tan(0.5F * camera.fov_y);
  return seen.z < 0 && std::abs(seen.y) <= slope * -seen.z && std::abs(seen.x) <= slope * camera.aspect * -seen.z;
}

constexpr auto kBorder = static_cast<std::size_t>(MeshFaultKind::BorderEdge);

TEST(TopologyMarks, TheCameraLooksIntoTheOpenFace) {
  for (std::size_t face = 0; face < 6; ++face) {
    const Mesh cube = open_cube(face);
    const Topology found = topology(cube);
    ASSERT_EQ(found.count(MeshFaultKind::BorderEdge), 4U);
    glm::vec3 out(0);
    for (const MeshFault& each : found.of(MeshFaultKind::BorderEdge).listed) out += each.place;
    const MarkedScene result = mark_faults(scene_of(cube.clone()), {&found, 1}, 1000);
    result.scene.check("marks");
    EXPECT_EQ(result.marks[kBorder], 4U);
    EXPECT_EQ(result.hidden[kBorder], 0U) << face;
    EXPECT_GT(glm::dot(eye_of(result.scene, "faults"), out), 0.0F) << face << ": from the side that is open";
    EXPECT_EQ(result.scene.materials[0].base_color.a, 1.0F) << "all is seen: nothing need be seen through";
    for (const glm::vec3& each : cube.positions) EXPECT_TRUE(in_picture(result.scene, "faults", each));
    const Mesh& tubes = *result.scene.meshes[find(result.scene, "border_edges", false)->mesh.index];
    EXPECT_EQ(tubes.positions.size() % 4, 0U);
    for (const glm::vec3& each : tubes.positions) {
      const float nearest =
          std::min({std::abs(std::abs(each.x) - 1), std::abs(std::abs(each.y) - 1), std::abs(std::abs(each.z) - 1)});
      EXPECT_LT(nearest, 0.02F) << "tubes are on edges";
    }
  }
}

TEST(TopologyMarks, WhatIsInsideIsSeenThroughTheSurface) {
  // Two tetrahedra that touch in a point, in the middle of a closed sphere.
  Mesh mesh = primitive({.kind = PrimitiveKind::IcoSphere, .radius = 10});
  mesh.attributes.clear();
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const float s : {1.0F, -1.0F}) {
    for (int axis = 0; axis < 3; ++axis) {
      glm::vec3 p(0);
      p[axis] = s;
      mesh.positions.push_back(p);
    }
  }
  mesh.positions.emplace_back(0, 0, 0);
  for (const std::uint32_t side : {0U, 3U}) {
    const std::uint32_t a = first + side;
    for (const std::uint32_t v : {first + 6, a + 1, a, first + 6, a, a + 2, a, a + 1, a + 2, first + 6, a + 2, a + 1}) {
      mesh.corners.push_back(v);
    }
  }
  const MarkedScene result = marked(std::move(mesh));
  constexpr auto kSingular = static_cast<std::size_t>(MeshFaultKind::SingularVertex);
  EXPECT_EQ(result.marks[kSingular], 1U);
  EXPECT_EQ(result.hidden[kSingular], 1U);
  EXPECT_LT(result.scene.materials[0].base_color.a, 1.0F);
  EXPECT_EQ(result.scene.materials[0].alpha_mode, AlphaMode::Blend);
  EXPECT_TRUE(in_picture(result.scene, "singular_vertices", {0, 0, 0}));
  EXPECT_LT(glm::length(eye_of(result.scene, "singular_vertices")), glm::length(eye_of(result.scene, "faults")));
}

TEST(TopologyMarks, FacesAreTintedInTheirColor) {
  Mesh mesh = primitive({.kind = PrimitiveKind::Tetrahedron});
  mesh.attributes.clear();
  mesh.face_offsets.clear();
  for (int i = 0; i < 3; ++i) mesh.corners.push_back(std::uint32_t{mesh.corners[static_cast<std::size_t>(i)]});
  const MarkedScene result = marked(std::move(mesh));
  const Mesh& painted = *result.scene.meshes[0];
  ASSERT_EQ(painted.material.size(), 5U);
  EXPECT_EQ(painted.material[1], 0U);
  EXPECT_EQ(result.scene.materials[painted.material[4]].name, "duplicate_faces");
}

TEST(TopologyMarks, AreBoundedAndLeaveOutWhatCanNotBeDrawn) {
  EXPECT_EQ(marked(open_cube(0), 3).marks[kBorder], 3U);
  EXPECT_EQ(marked(open_cube(0), 0).scene.cameras.size(), 1U);
  Mesh bad = open_cube(0);
  bad.positions[0].x = std::numeric_limits<float>::quiet_NaN();
  bad.positions[1].y = std::numeric_limits<float>::infinity();
  bad.positions[2].z = 3e38F;
  const MarkedScene result = marked(std::move(bad));
  result.scene.check("marks");
  for (const auto& mesh : result.scene.meshes) {
    if (mesh == result.scene.meshes[0]) continue;
    for (const glm::vec3& each : mesh->positions) EXPECT_TRUE(std::isfinite(each.x + each.y + each.z));
  }
  const MarkedScene empty = marked(Mesh());
  empty.scene.check("marks");
  EXPECT_EQ(empty.scene.cameras.size(), 1U);
}

TEST(TopologyMarks, AreWhereTheNodesPutTheMesh) {
  Scene scene = scene_of(open_cube(2));
  scene.nodes[0].placement = Placement{.translation = {100, 0, 0}};
  Node hidden = scene.nodes[0];
  hidden.visible = false;
  scene.roots.emplace_back(scene.nodes.size());
  scene.nodes.push_back(hidden);
  Node other = scene.nodes[0];
  other.placement = Placement{.translation = {0, 50, 0}};
  scene.roots.emplace_back(scene.nodes.size());
  scene.nodes.push_back(other);
  const Topology found = topology(*scene.meshes[0]);
  const MarkedScene result = mark_faults(scene, {&found, 1}, 1000);
  EXPECT_EQ(result.marks[kBorder], 8U) << "of both that are visible";
  const Mesh& tubes = *result.scene.meshes[find(result.scene, "border_edges", false)->mesh.index];
  const Box3 box = bounds(tubes);
  EXPECT_NEAR(box.upper.x, 101, 1);
  EXPECT_NEAR(box.upper.y, 51, 1);
  EXPECT_TRUE(in_picture(result.scene, "faults", {100, 0, 0}));
  EXPECT_TRUE(in_picture(result.scene, "faults", {0, 50, 0}));
}

TEST(TopologyMarks, AreTheSameForAnyNumberOfThreads) {
  Mesh mesh = primitive({.kind = PrimitiveKind::Teapot});
  const Topology found = topology(mesh);
  const Scene scene = scene_of(std::move(mesh));
  azulejo::Run one;
  one.threads = 1;
  azulejo::Run many;
  many.threads = 7;
  const MarkedScene a = mark_faults(scene, {&found, 1}, 1000, one);
  const MarkedScene b = mark_faults(scene, {&found, 1}, 1000, many);
  EXPECT_EQ(a.hidden, b.hidden);
  ASSERT_EQ(a.scene.nodes.size(), b.scene.nodes.size());
  for (std::size_t n = 0; n < a.scene.nodes.size(); ++n) {
    EXPECT_EQ(parent_from_node(a.scene.nodes[n]), parent_from_node(b.scene.nodes[n]));
  }
}

TEST(Sight, SeesWhatNothingIsBefore) {
  const SightAxes axes = sight_axes({0, 0, 1}, {0, 1, 0});
  Sight sight({0, 0, 0}, 2, axes);
  const auto cell = [&](float x, float y, float z) { return sight.cell({x, y, z}); };
  sight.cover(cell(-1, -1, 0), cell(1, -1, 0), cell(0, 1, 0));
  EXPECT_TRUE(sight.sees(cell(0, 0, 0.5F), false));
  EXPECT_FALSE(sight.sees(cell(0, 0, -0.5F), false));
  EXPECT_TRUE(sight.sees(cell(0, 0, 0), false)) << "what is on it";
  EXPECT_FALSE(sight.sees(cell(0, 0, 0.5F), true));
  EXPECT_TRUE(sight.sees(cell(0, 0, -0.5F), true));
  EXPECT_TRUE(sight.sees(cell(-0.9F, 0.9F, -1), false)) << "beside it";
}

TEST(Sight, DirectionsAreUnitAndDifferent) {
  const std::vector<glm::dvec3> directions = sight_directions({0, -1, 0}, {0, 0, 1});
  ASSERT_EQ(directions.size(), 27U);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    EXPECT_NEAR(glm::length(directions[i]), 1, 1e-12);
    for (std::size_t j = 0; j < i; ++j) EXPECT_LT(glm::dot(directions[i], directions[j]), 0.99);
    if (i % 2 == 1) {
      EXPECT_EQ(directions[i], -directions[i + 1]);
    }
    const SightAxes axes = sight_axes(directions[i], {0, 0, 1});
    EXPECT_NEAR(glm::dot(glm::cross(axes.right, axes.up), axes.to_eye), 1, 1e-12);
    EXPECT_NEAR(glm::length(axes.right), 1, 1e-12);
    EXPECT_NEAR(glm::dot(axes.right, axes.to_eye), 0, 1e-12);
  }
  EXPECT_NEAR(directions[0].z, 0.34202014332566873, 1e-12);
}

}  // namespace
}  // namespace azulejo
