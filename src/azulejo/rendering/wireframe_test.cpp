#include "azulejo/rendering/wireframe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "azulejo/core/error.h"
#include "azulejo/modelling/primitive.h"
#include "azulejo/rendering/rendering_testing.h"

namespace azulejo {
namespace {

/// Rounded to 0.01 px, and float positions in pictures of some hundred pixels.
constexpr float kNear = 0.006F;

struct Line {
  glm::vec2 a;
  glm::vec2 b;
};

std::vector<Line> lines_of(const Drawing& drawing, const DrawingPath& path) {
  std::vector<Line> lines;
  const PathView view = drawing.view(path);
  std::size_t point = 0;
  glm::vec2 at{0, 0};
  glm::vec2 start{0, 0};
  for (const PathCommand command : view.commands) {
    const glm::vec2 from = at;
    if (command == PathCommand::Close) {
      at = start;
    } else {
      at = view.points[point++];
    }
    if (command == PathCommand::Move) {
      start = at;
    } else {
      lines.push_back({from, at});
    }
  }
  return lines;
}

/// All but those of clips.
std::vector<Line> lines_of(const Drawing& drawing) {
  std::vector<Line> lines;
  for (const PlacedPath& placed : walk(drawing)) {
    const std::vector<Line> more = lines_of(drawing, drawing.paths[placed.path]);
    lines.insert(lines.end(), more.begin(), more.end());
  }
  return lines;
}

float length(const Line& line) { return std::hypot(line.b.x - line.a.x, line.b.y - line.a.y); }

Mesh cube() { return primitive({.kind = PrimitiveKind::Cube}); }

/// Eight faces a side of a square, flat.
Mesh grid() { return primitive({.kind = PrimitiveKind::Plane, .segments = 8, .rings = 8}); }

WireframeOptions seen_from(ViewDirection direction) {
  WireframeOptions options;
  options.width = 400;
  options.height = 300;
  options.camera.view = direction;
  return options;
}

bool joins(const Line& line, const glm::dvec2& a, const glm::dvec2& b) {
  const auto near = [](const glm::vec2& p, const glm::dvec2& q) {
    return std::abs(p.x - q.x) < kNear && std::abs(p.y - q.y) < kNear;
  };
  return (near(line.a, a) && near(line.b, b)) || (near(line.a, b) && near(line.b, a));
}

TEST(Wireframe, OfACubeHasItsTwelveEdgesWhereTheCameraSeesThem) {
  for (const auto projection : {Projection::Perspective, Projection::Orthographic}) {
    WireframeOptions options = seen_from(ViewDirection::Isometric);
    options.camera.projection = projection;
    const Scene scene = scene_of(cube());
    const std::vector<Line> lines = lines_of(wireframe(scene, options));
    ASSERT_EQ(lines.size(), 12U);
    const View view = choose_camera(scene, options.camera, options.width, options.height).view;
    const std::vector<glm::vec3> corners = box_corners(glm::vec3(-1), glm::vec3(1));
    for (const unsigned bit : {1U, 2U, 4U}) {
      for (unsigned corner = 0; corner < 8; ++corner) {
        if ((corner & bit) != 0) continue;
        const glm::dvec2 a(pixel_of(view, corners[corner]));
        const glm::dvec2 b(pixel_of(view, corners[corner | bit]));
        EXPECT_EQ(std::ranges::count_if(lines, [&](const Line& line) { return joins(line, a, b); }), 1);
      }
    }
  }
}

TEST(Wireframe, HasNoDiagonalsAndNoSeams) {
  // Triangles: 18 edges, of which 6 are diagonals of flat sides.
  const Scene triangles = scene_of(box_mesh({-1, -1, -1}, {1, 1, 1}));
  WireframeOptions options = seen_from(ViewDirection::Isometric);
  EXPECT_EQ(lines_of(wireframe(triangles, options)).size(), 18U);
  options.edges = WireframeEdges::Feature;
  EXPECT_EQ(lines_of(wireframe(triangles, options)).size(), 12U);
  options.edges = WireframeEdges::Border;
  EXPECT_TRUE(lines_of(wireframe(triangles, options)).empty());
  // Corners of their own for every face: the edges are there once all the same.
  Mesh soup = box_mesh({-1, -1, -1}, {1, 1, 1});
  Mesh split;
  for (std::uint32_t c = 0; c < soup.corners.size(); ++c) {
    split.positions.push_back(soup.positions[soup.corners[c]]);
    split.corners.push_back(c);
  }
  options.edges = WireframeEdges::All;
  EXPECT_EQ(lines_of(wireframe(scene_of(std::move(split)), options)).size(), 18U);
}

TEST(Wireframe, OfAPlane) {
  const Scene scene = scene_of(grid());
  WireframeOptions options = seen_from(ViewDirection::Top);
  EXPECT_EQ(lines_of(wireframe(scene, options)).size(), 2U * 8 * 9);
  options.edges = WireframeEdges::Border;
  EXPECT_EQ(lines_of(wireframe(scene, options)).size(), 32U);
  options.edges = WireframeEdges::Feature;
  EXPECT_EQ(lines_of(wireframe(scene, options)).size(), 32U);
}

/// A camera between the ends of a line: what is seen ends at the picture's edge, and all of it lies on the line that
/// the part in front makes.
TEST(Wireframe, LinesThroughTheCameraAreCut) {
  Mesh mesh;
  mesh.positions = {{0.1F, -1, -5}, {0.1F, -1, 5}, {0.1F, -1, 4}, {0.1F, -1, 5}};
  mesh.lines = {0, 1, 2, 3};  // the second is behind the camera
  WireframeOptions options;
  options.width = 400;
  options.height = 300;
  options.camera.position = glm::vec3(0, 0, 0);
  options.camera.target = glm::vec3(0, 0, -1);
  const Scene scene = scene_of(std::move(mesh));
  const std::vector<Line> lines = lines_of(wireframe(scene, options));
  ASSERT_EQ(lines.size(), 1U);
  const View view = choose_camera(scene, options.camera, 400, 300).view;
  const glm::dvec2 far(pixel_of(view, {0.1F, -1, -5}));
  EXPECT_NEAR(lines[0].a.x, far.x, kNear);
  EXPECT_NEAR(lines[0].a.y, far.y, kNear);
  EXPECT_NEAR(lines[0].b.y, 301.5, kNear);  // half the width, and a pixel, below the picture
  const glm::dvec2 d = glm::dvec2(pixel_of(view, {0.1F, -1, -4})) - far;
  EXPECT_NEAR(lines[0].b.x, far.x + d.x / d.y * (301.5 - far.y), 2 * kNear);
}

TEST(Wireframe, AViewportMovesThePictureAndClipsIt) {
  const Scene scene = scene_of(cube());
  WireframeOptions options = seen_from(ViewDirection::Isometric);
  const std::vector<Line> whole = lines_of(wireframe(scene, options));
  options.width = 1000;
  options.height = 700;
  options.camera.viewport = std::array<float, 4>{500, 200, 400, 300};
  const Drawing drawing = wireframe(scene, options);
  std::vector<Line> part = lines_of(drawing);
  ASSERT_EQ(part.size(), whole.size());
  for (std::size_t i = 0; i < part.size(); ++i) {
    EXPECT_NEAR(part[i].a.x, whole[i].a.x + 500, kNear);
    EXPECT_NEAR(part[i].b.y, whole[i].b.y + 200, kNear);
  }
  EXPECT_EQ(drawing.width, 1000);
  const auto clipped =
      std::ranges::find_if(drawing.groups, [](const DrawingGroup& group) { return group.clip.has_value(); });
  ASSERT_NE(clipped, drawing.groups.end());
  const DrawingPath& clip = drawing.paths[drawing.groups[*clipped->clip].items[0].index];
  EXPECT_EQ(bounds(drawing.view(clip)), (Box2{{500, 200}, {900, 500}}));
  // A smaller window is a larger picture, cut off: nothing is drawn far from the viewport.
  options.camera.window = {-0.2F, -0.2F, 0.2F, 0.2F};
  for (const Line& line : lines_of(wireframe(scene, options))) {
    for (const glm::vec2& at : {line.a, line.b}) {
      EXPECT_TRUE(at.x > 498 && at.x < 902 && at.y > 198 && at.y < 502) << at.x << "," << at.y;
    }
  }
}

TEST(Wireframe, NamesWhatItDraws) {
  Scene scene = scene_of(cube());
  scene.nodes[0].name = "box";
  WireframeOptions options = seen_from(ViewDirection::Front);
  Drawing drawing = wireframe(scene, options);
  ASSERT_EQ(drawing.groups.size(), 2U);
  EXPECT_EQ(drawing.groups[1].id, "box");
  ASSERT_EQ(drawing.paths.size(), 1U);
  EXPECT_EQ(drawing.paths[0].id, "edges");
  options.edge_ids = true;
  options.point_size = 5;
  drawing = wireframe(scene, options);
  ASSERT_EQ(drawing.paths.size(), 13U);
  std::set<std::string> ids;
  for (const DrawingPath& path : drawing.paths) ids.insert(path.id);
  EXPECT_EQ(ids.size(), 13U);
  EXPECT_TRUE(ids.contains("points"));
  const DrawingPath& marks = drawing.paths[12];
  EXPECT_EQ(marks.point_count, 8U);
  EXPECT_EQ(drawing.styles[marks.style].point_size, 5);
  drawing.check("wireframe");
}

TEST(Wireframe, TakesColorsFromMaterialsOnRequest) {
  Scene scene = scene_of(cube());
  Mesh mesh = cube();
  mesh.material = {0, 0, 0, 1, 1, MaterialId::kNone};
  scene.meshes[0] = std::make_shared<const Mesh>(std::move(mesh));
  scene.materials.resize(2);
  scene.materials[0].base_color = {1, 0, 0, 1};
  scene.materials[0].name = "red";
  scene.materials[1].base_color = {0, 0.2140411F, 0, 1};  // half of sRGB
  WireframeOptions options = seen_from(ViewDirection::Isometric);
  options.color = {0, 0, 1, 0.5F};
  EXPECT_EQ(wireframe(scene, options).paths.size(), 1U);
  options.material_colors = true;
  const Drawing drawing = wireframe(scene, options);
  std::map<std::string, glm::vec4> colors;
  std::size_t lines = 0;
  for (const DrawingPath& path : drawing.paths) {
    colors[path.id] = drawing.styles[path.style].stroke->color;
    lines += lines_of(drawing, path).size();
  }
  EXPECT_EQ(lines, 12U);
  EXPECT_NEAR(colors["edges:red"].r, 1, 1e-6);
  EXPECT_EQ(colors["edges:red"].g, 0);
  EXPECT_NEAR(colors["edges:1"].g, 0.5F, 1e-3F);
  EXPECT_EQ(drawing.groups[1].opacity, 0.5F);
}

/// All edges of a sphere, drawn end to end in few lines.
TEST(Wireframe, JoinsEdgesEndToEnd) {
  const Scene scene = scene_of(primitive({.kind = PrimitiveKind::IcoSphere, .subdivisions = 4}));
  WireframeOptions options = seen_from(ViewDirection::Front);
  options.camera.projection = Projection::Orthographic;
  const Drawing joined = wireframe(scene, options);
  options.edge_ids = true;
  const Drawing apart = wireframe(scene, options);
  EXPECT_EQ(apart.paths.size(), 30U * 256);
  EXPECT_GT(lines_of(joined).size(), 0.99 * 30 * 256);  // but for those that are seen from their ends
  double a = 0;
  double b = 0;
  for (const Line& line : lines_of(joined)) a += length(line);
  for (const Line& line : lines_of(apart)) b += length(line);
  EXPECT_NEAR(a, b, 1e-3 * b);
  EXPECT_LT(joined.points.size(), 1.1 * 30 * 256);
}

/// A mesh much smaller than a pixel is a dot, not nothing, and not a million of them.
TEST(Wireframe, SmallThingsAreDots) {
  Scene scene = scene_of(primitive({.kind = PrimitiveKind::IcoSphere, .subdivisions = 4}));
  WireframeOptions options = seen_from(ViewDirection::Front);
  options.camera.distance = 1e7F;
  const std::size_t lines = lines_of(wireframe(scene, options)).size();
  EXPECT_GE(lines, 1U);
  EXPECT_LT(lines, 20U);
}

TEST(Wireframe, LeavesOutWhatIsNotFinite) {
  Mesh mesh = box_mesh({-1, -1, -1}, {1, 1, 1});
  mesh.positions[0].x = std::numeric_limits<float>::quiet_NaN();
  mesh.positions[7].y = std::numeric_limits<float>::infinity();
  const Drawing drawing = wireframe(scene_of(std::move(mesh)), seen_from(ViewDirection::Isometric));
  for (const glm::vec2& point : drawing.points) EXPECT_TRUE(std::isfinite(point.x) && std::isfinite(point.y));
  EXPECT_FALSE(lines_of(drawing).empty());
  EXPECT_TRUE(lines_of(wireframe(Scene())).empty());
}

TEST(Wireframe, IsTheSameOnAnyNumberOfThreads) {
  const Scene scene = scene_of(primitive({.kind = PrimitiveKind::Teapot, .segments = 40}));
  WireframeOptions options = seen_from(ViewDirection::Isometric);
  options.edges = WireframeEdges::Feature;
  options.point_size = 2;
  const Drawing one = wireframe(scene, options, {.threads = 1});
  const Drawing many = wireframe(scene, options, {.threads = 5});
  ASSERT_EQ(one.points.size(), many.points.size());
  EXPECT_EQ(std::memcmp(one.points.data(), many.points.data(), one.points.size() * sizeof(glm::vec2)), 0);
}

TEST(Wireframe, RefusesWhatDoesNotFit) {
  const Scene scene = scene_of(grid());
  EXPECT_THROW(wireframe(scene, {.line_width = -1}), Error);
  EXPECT_THROW(wireframe(scene, {.point_size = std::numeric_limits<float>::quiet_NaN()}), Error);
  EXPECT_THROW(wireframe(scene, {.width = 0}), Error);
  azulejo::Run run;
  run.limits.memory_bytes = 1000;
  EXPECT_THROW(wireframe(scene, {}, run), Error);
}

}  // namespace
}  // namespace azulejo
