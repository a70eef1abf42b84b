#include "azulejo/rendering/polygon_mode.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "azulejo/modelling/primitive.h"
#include "azulejo/rendering/render.h"
#include "azulejo/rendering/rendering_testing.h"

namespace azulejo {
namespace {

Scene cube() { return scene_of(primitive({.kind = PrimitiveKind::Cube})); }

RenderOptions drawn_as(PolygonMode mode) {
  RenderOptions options;
  options.width = 200;
  options.height = 160;
  options.camera.view = ViewDirection::Isometric;
  options.polygon_mode = mode;
  options.antialias = 1;
  options.line_width = 3;
  options.point_size = 7;
  return options;
}

double distance(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 d = b - a;
  const double along = std::clamp(glm::dot(p - a, d) / glm::dot(d, d), 0.0, 1.0);
  return glm::length(p - a - along * d);
}

/// A pixel is drawn where its centre is within half the width of an edge's projection; near its rim and its ends,
/// which are butts, either is right.
TEST(PolygonMode, EdgesAreLinesOfTheirWidth) {
  const RenderOptions options = drawn_as(PolygonMode::Edges);
  RenderStatistics statistics;
  const Scene scene = cube();
  const Frame frame = render(scene, options, {}, &statistics);
  EXPECT_EQ(statistics.faces.faces_in, 12U);  // each edge once, no diagonals
  const View view = choose_camera(scene, options.camera, options.width, options.height).view;
  const std::vector<glm::vec3> corners = box_corners({-1, -1, -1}, {1, 1, 1});
  const auto pixels = frame.find("color")->view<std::uint8_t>();
  for (int y = 0; y < options.height; ++y) {
    for (int x = 0; x < options.width; ++x) {
      const glm::dvec2 p(x + 0.5, y + 0.5);
      double nearest = 1e9;
      for (unsigned i = 0; i < 24; ++i) {
        const unsigned corner = i / 3;
        const unsigned bit = 1U << i % 3;
        if ((corner & bit) != 0) continue;
        nearest = std::min(nearest, distance(p, glm::dvec2(pixel_of(view, corners[corner])),
                                             glm::dvec2(pixel_of(view, corners[corner | bit]))));
      }
      const bool drawn = pixels(x, y, 3) > 0;
      if (nearest > 1.6) {
        ASSERT_FALSE(drawn) << x << "," << y;
      }
      bool at_end = false;
      for (const glm::vec3& corner : corners) {
        at_end = at_end || glm::length(p - glm::dvec2(pixel_of(view, corner))) < 3;
      }
      if (nearest < 1.4 && !at_end) {
        ASSERT_TRUE(drawn) << x << "," << y;
      }
    }
  }
}

TEST(PolygonMode, VerticesAreSquares) {
  const RenderOptions options = drawn_as(PolygonMode::Vertices);
  RenderStatistics statistics;
  const Scene scene = cube();
  const Frame frame = render(scene, options, {}, &statistics);
  EXPECT_EQ(statistics.faces.faces_in, 8U);
  const View view = choose_camera(scene, options.camera, options.width, options.height).view;
  const auto pixels = frame.find("color")->view<std::uint8_t>();
  for (int y = 0; y < options.height; ++y) {
    for (int x = 0; x < options.width; ++x) {
      double nearest = 1e9;
      for (const glm::vec3& corner : box_corners({-1, -1, -1}, {1, 1, 1})) {
        const glm::dvec2 d = glm::abs(glm::dvec2(x + 0.5, y + 0.5) - glm::dvec2(pixel_of(view, corner)));
        nearest = std::min(nearest, std::max(d.x, d.y));
      }
      if (nearest > 3.6) {
        ASSERT_EQ(pixels(x, y, 3), 0) << x << "," << y;
      }
      if (nearest < 3.4) {
        ASSERT_GT(pixels(x, y, 3), 0) << x << "," << y;
      }
    }
  }
}

/// Two squares one behind the other, each of its own color: where their outlines cross the nearer one is seen.
TEST(PolygonMode, NearerEdgesHideOthers) {
  for (const bool nearer_first : {true, false}) {
    Mesh mesh;
    const float depths[2] = {nearer_first ? 1.0F : -1.0F, nearer_first ? -1.0F : 1.0F};
    for (int s = 0; s < 2; ++s) {
      const float x = depths[s] > 0 ? 0.5F : 0.0F;  // in the picture their sides cross
      for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
        mesh.corners.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
        mesh.positions.emplace_back(corner.x + x, corner.y + x, depths[s]);
      }
    }
    mesh.face_offsets = {0, 4, 8};
    Scene scene = scene_of(mesh.clone());
    mesh.material = {nearer_first ? 0U : 1U, nearer_first ? 1U : 0U};
    scene.meshes[0] = std::make_shared<const Mesh>(std::move(mesh));
    scene.materials.resize(2);
    for (Material& material : scene.materials) material.model = MaterialModel::Unlit;
    scene.materials[0].base_color = {1, 0, 0, 1};  // of the nearer
    scene.materials[1].base_color = {0, 0, 1, 1};
    RenderOptions options = drawn_as(PolygonMode::Edges);
    options.camera.view = ViewDirection::Front;
    options.camera.projection = Projection::Orthographic;
    const Frame frame = render(scene, options);
    const View view = choose_camera(scene, options.camera, options.width, options.height).view;
    const auto pixels = frame.find("color")->view<std::uint8_t>();
    const glm::dvec2 crossing(pixel_of(view, {1, -0.5F, 0}));  // right side of the far one, bottom of the near one
    const auto x = static_cast<int>(crossing.x);
    const auto y = static_cast<int>(crossing.y);
    EXPECT_EQ(pixels(x, y, 0), 255);
    EXPECT_EQ(pixels(x, y, 2), 0);
    EXPECT_EQ(pixels(x, y + 10, 0), 0);  // only the far one
    EXPECT_EQ(pixels(x, y + 10, 2), 255);
  }
}

/// On the side that is seen, edges have the colors of the faces there: same normals, same light, but for where in the
/// pixel they are met.
TEST(PolygonMode, EdgesAreLitAsFacesAre) {
  const Scene scene = scene_of(primitive({.kind = PrimitiveKind::IcoSphere, .subdivisions = 3}));
  RenderOptions options = drawn_as(PolygonMode::Filled);
  options.layers = {FrameLayer::Color, FrameLayer::Depth};
  const Frame filled = render(scene, options);
  options.polygon_mode = PolygonMode::Edges;
  options.line_width = 1;
  const Frame edges = render(scene, options);
  const auto a = filled.find("color")->view<std::uint8_t>();
  const auto b = edges.find("color")->view<std::uint8_t>();
  const auto near = filled.find("depth")->view<float>();
  const auto far = edges.find("depth")->view<float>();
  int compared = 0;
  for (int y = 60; y < 100; ++y) {
    for (int x = 80; x < 120; ++x) {
      if (b(x, y, 3) == 0 || std::abs(near(x, y) - far(x, y)) > 0.05F) continue;  // on the other side
      ++compared;
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(a(x, y, c), b(x, y, c), 24) << x << "," << y;
    }
  }
  EXPECT_GT(compared, 200);
}

}  // namespace
}  // namespace azulejo
