// The z-buffer where there is little to draw, or too much: empty and broken scenes, lines and points, limits, options.

#include <algorithm>
#include <functional>

#include <gtest/gtest.h>

#include "azulejo/core/error.h"
#include "azulejo/rendering/zbuffer_testing.h"

namespace azulejo {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Shows z = 0 from −10 to 10, a pixel a unit, (0, 0) in the middle of the picture.
View flat_view(int width = 20, int height = 20) {
  TestView wanted{.eye = {0, 0, 10}, .width = width, .height = height};
  wanted.lens.perspective = false;
  wanted.lens.height = height;
  return view_of(wanted);
}

Frame drawn(const Scene& scene, ZBufferOptions options, const View& view = flat_view()) {
  options.output = FrameOutput::Linear;
  return ZBufferRenderer(scene, options).draw(view, {});
}

/// The sum of the opacities of all pixels.
double area_of(const Frame& frame) {
  const Image& color = *frame.find("color");
  double sum = 0;
  for (int y = 0; y < color.height(); ++y) {
    for (int x = 0; x < color.width(); ++x) sum += pixel_at(frame, "color", x, y).w;
  }
  return sum;
}

std::string refusal(Error::Kind kind, const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return "";
}

TEST(ZBufferEdges, NothingButBackground) {
  const ZBufferOptions options{.background = {0.2F, 0.4F, 0.6F, 0.5F}, .exposure = 3};
  for (const Scene& scene : {Scene(), scene_of(Mesh())}) {
    for (const auto& [width, height] : {std::pair{1, 1}, {67, 1}, {33, 70}}) {
      const View view = flat_view(width, height);
      const Frame linear = drawn(scene, options, view);
      ASSERT_EQ(linear.find("color")->info().alpha, AlphaState::Premultiplied);
      const Frame display = ZBufferRenderer(scene, options).draw(view, {});
      ASSERT_EQ(display.find("color")->info().alpha, AlphaState::Straight);
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          EXPECT_LE(glm::distance(pixel_at(linear, "color", x, y), glm::dvec4(0.1, 0.2, 0.3, 0.5)), 1e-6);
          const std::uint8_t* const pixel = &display.find("color")->view<std::uint8_t>()(x, y, 0);
          // sRGB of 0.2, 0.4 and 0.6.
          EXPECT_EQ((std::array<int, 4>{pixel[0], pixel[1], pixel[2], pixel[3]}),
                    (std::array<int, 4>{124, 170, 203, 128}));
        }
      }
    }
  }
}

TEST(ZBufferEdges, HalfCoveredPixelsAreMixedWithTheBackground) {
  // The edge at x = 0.5 halves a column of pixels: two of four samples lie on either side.
  const Scene scene = scene_with(soup_of({{0.5F, -90, 0}, {90, 0, 0}, {0.5F, 90, 0}}), unlit({0.8F, 0.4F, 0.2F, 1}));
  const Frame over = drawn(scene, {.background = {0, 0.2F, 1, 1}, .exposure = 0.5F});
  EXPECT_LE(glm::distance(pixel_at(over, "color", 10, 7), glm::dvec4(0.2, 0.2, 0.55, 1)), 1e-6);
  EXPECT_LE(glm::distance(pixel_at(over, "color", 11, 7), glm::dvec4(0.4, 0.2, 0.1, 1)), 1e-6);
  EXPECT_LE(glm::distance(pixel_at(over, "color", 9, 7), glm::dvec4(0, 0.2, 1, 1)), 1e-6);
  // Without a background: half opaque, and straight alpha keeps the colour.
  const Frame alone = ZBufferRenderer(scene, {}).draw(flat_view(), {});
  const auto pixels = alone.find("color")->view<std::uint8_t>();
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixels(10, 7, c), pixels(11, 7, c), 1);
  EXPECT_EQ(pixels(10, 7, 3), 128);
  EXPECT_EQ(pixels(11, 7, 3), 255);
}

TEST(ZBufferEdges, VerticesThatAreNotFiniteDrawNothing) {
  for (const float bad : {kNan, kInfinity, -kInfinity}) {
    for (int corner = 0; corner < 3; ++corner) {
      for (int axis = 0; axis < 3; ++axis) {
        Mesh mesh = soup_of({{-5, -5, 0}, {5, -5, 0}, {0, 5, 0}, {-5, -5, -1}, {5, -5, -1}, {0, 5, -1}});
        const double sound = area_of(drawn(scene_of(soup_of({{-5, -5, -1}, {5, -5, -1}, {0, 5, -1}})), {}));
        mesh.positions[static_cast<std::size_t>(corner)][axis] = bad;
        ZBufferStatistics statistics;
        const Scene scene = scene_of(std::move(mesh));
        const Frame frame =
            ZBufferRenderer(scene, {.output = FrameOutput::Linear}).draw(flat_view(), {}, {}, &statistics);
        EXPECT_EQ(statistics.faces_empty, 1U) << bad;
        EXPECT_EQ(statistics.faces_drawn, 1U) << bad;
        EXPECT_DOUBLE_EQ(area_of(frame), sound);
      }
    }
  }
}

TEST(ZBufferEdges, ALightOrViewThatIsNotFiniteStillEnds) {
  const Scene scene = scene_of(soup_of({{-5, -5, 0}, {5, -5, 0}, {0, 5, 0}}));
  View view = flat_view();
  view.view_from_world[3][0] = kNan;
  EXPECT_EQ(area_of(drawn(scene, {}, view)), 0);
  Lighting lighting;
  lighting.lights = {ShadingLight{.direction = {kNan, 0, 0}}};
  const Frame frame = ZBufferRenderer(scene, {}).draw(flat_view(), lighting);
  EXPECT_EQ(frame.find("color")->view<std::uint8_t>()(10, 10, 3), 255);
}

TEST(ZBufferEdges, DegenerateTrianglesDrawNothing) {
  const std::vector<std::vector<glm::vec3>> shapes = {
      {{1, 1, 0}, {1, 1, 0}, {1, 1, 0}},                               // a point
      {{-5, -5, 0}, {5, 5, 0}, {5, 5, 0}},                             // twice the same
      {{-5, -5, 0}, {0, 0, 0}, {5, 5, 0}},                             // on a line
      {{-5, 0.2F, 0}, {5, 0.2F, 0}, {0, 0.2001F, 0}},                  // thinner than a subpixel
      {{0.1F, 0.1F, 0}, {0.2F, 0.1F, 0}, {0.1F, 0.2F, 0}},             // between all samples
      {{-1e5F, -1e5F, 0}, {1e5F, 1e5F, 0}, {2e5F, 2e5F, 0}},           // clipped, on a line
      {{-900000, 900000, 0}, {-800000, 900000, 0}, {-9e5F, 9e5F, 0}},  // far away
  };
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    for (const int antialias : {1, 16}) {
      if (i == 4 && antialias == 16) continue;  // there one of 16 samples may see it
      ZBufferStatistics statistics;
      const ZBufferOptions options{.antialias = antialias, .output = FrameOutput::Linear};
      const Frame frame = ZBufferRenderer(scene_of(soup_of(shapes[i])), options).draw(flat_view(), {}, {}, &statistics);
      EXPECT_EQ(area_of(frame), 0) << i;
      EXPECT_EQ(statistics.faces_in, 1U);
      EXPECT_EQ(statistics.faces_empty + statistics.faces_outside, 1U) << i;
      EXPECT_EQ(statistics.fragments_tested, 0U) << i;
    }
  }
}

TEST(ZBufferEdges, AFaceOfFewCornersAndEmptyOnes) {
  Mesh mesh = soup_of({{-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}, {0, 0, 0}});
  mesh.corners = {0, 1, 0, 1, 2, 3, 4};
  mesh.face_offsets = {0, 0, 2, 6, 7};
  const Frame frame = drawn(scene_of(std::move(mesh)), {.layers = {"color", "face_id"}});
  EXPECT_EQ(area_of(frame), 100);
  EXPECT_EQ(pixel_at(frame, "face_id", 9, 9).x, 3) << "the face's number, not the triangle's";
}

TEST(ZBufferEdges, PointsAreSquaresOfTheirSize) {
  for (const float size : {1.0F, 3.0F, 6.0F}) {
    Mesh mesh;
    mesh.positions = {{0.5F, 0.5F, 0}, {-5.5F, -4.5F, 0}, {kNan, 0, 0}, {0, 0, 50}};
    mesh.attributes.push_back(attribute_of("COLOR_0", std::vector<glm::vec3>(4, {0.3F, 0.6F, 0.9F})));
    ZBufferStatistics statistics;
    const ZBufferOptions options{.antialias = 16, .output = FrameOutput::Linear, .point_size = size};
    const Frame points = ZBufferRenderer(scene_of(std::move(mesh)), options).draw(flat_view(), {}, {}, &statistics);
    EXPECT_NEAR(area_of(points), 2 * size * size, 1e-4);
    EXPECT_LE(glm::distance(pixel_at(points, "color", 10, 9), glm::dvec4(0.3, 0.6, 0.9, 1)), 1e-6) << "unlit";
    EXPECT_EQ(statistics.faces_in, 4U);
    EXPECT_EQ(statistics.faces_drawn, 2U);
    EXPECT_EQ(statistics.faces_empty, 1U);
    EXPECT_EQ(statistics.faces_outside, 1U);
  }
}

TEST(ZBufferEdges, LinesAreStripsOfTheirWidth) {
  Mesh mesh;
  mesh.positions = {{-6, 0.5F, 0}, {6, 0.5F, 0}, {3.5F, -8, 0}, {3.5F, -2, 0}, {1, 1, 0}, {kNan, 1, 0}};
  mesh.lines = {0, 1, 2, 3, 4, 4, 4, 5};
  ZBufferStatistics statistics;
  const ZBufferOptions options{.antialias = 16, .output = FrameOutput::Linear, .line_width = 2};
  const Frame frame = ZBufferRenderer(scene_of(mesh.clone()), options).draw(flat_view(), {}, {}, &statistics);
  EXPECT_NEAR(area_of(frame), 12 * 2 + 6 * 2, 1e-4);
  EXPECT_EQ(statistics.faces_drawn, 2U);
  EXPECT_EQ(statistics.faces_empty, 2U);
  // Hidden behind a face, seen in front of one.
  for (const float z : {-1.0F, 1.0F}) {
    Mesh both = mesh.clone();
    both.positions.insert(both.positions.end(), {{-90, -90, z}, {90, -90, z}, {0, 90, z}});
    both.corners = {6, 7, 8};
    const Frame with_face = drawn(scene_with(std::move(both), unlit({0.5F, 0, 0, 1})), {.line_width = 2});
    EXPECT_EQ(pixel_at(with_face, "color", 10, 9).z > 0, z < 0) << "no blue but the line's";
  }
}

/// Nearly all of it is behind the camera or beyond the guard band.
TEST(ZBufferEdges, LinesAreClipped) {
  Mesh mesh;
  mesh.positions = {{0, 0, 50}, {0, 0, -50}, {-1e7F, -2.5F, 0}, {1e7F, -2.5F, 0}};
  mesh.lines = {2, 3, 0, 1};
  const ZBufferOptions options{.antialias = 4, .line_width = 1};
  const Frame frame = drawn(scene_of(std::move(mesh)), options);
  EXPECT_NEAR(area_of(frame), 20, 0.5);
}

TEST(ZBufferEdges, SizesAndLimits) {
  const Scene scene = scene_of(soup_of({{-5, -5, 0}, {5, -5, 0}, {0, 5, 0}}));
  const ZBufferRenderer renderer(scene);
  for (const auto& [width, height] : {std::pair{0, 5}, {5, 0}, {-1, 5}, {65537, 5}, {5, 65537}}) {
    View view = flat_view();
    view.width = width;
    view.height = height;
    const std::string message = refusal(Error::Argument, [&] { renderer.draw(view, {}); });
    EXPECT_NE(message.find(std::to_string(width)), std::string::npos) << message;
  }
  // 16 GB of pixels are refused before anything is allocated.
  View huge = flat_view();
  huge.width = huge.height = 65536;
  huge.viewport = {0, 0, 65536, 65536};
  refusal(Error::Resource, [&] { renderer.draw(huge, {}); });
  azulejo::Run small;
  small.limits.memory_bytes = 1000;
  refusal(Error::Resource, [&] { renderer.draw(flat_view(), {}, small); });
  azulejo::Run few;
  few.limits.pixels = 399;
  refusal(Error::Resource, [&] { renderer.draw(flat_view(), {}, few); });
  few.limits.pixels = 400;
  renderer.draw(flat_view(), {}, few);
  // One row of the widest picture.
  const View wide = flat_view(65536, 1);
  EXPECT_GT(area_of(drawn(scene, {.antialias = 1}, wide)), 0);
}

TEST(ZBufferEdges, ManyInstancesDontPassTheMemoryLimit) {
  Scene scene = scene_of(sphere_mesh(20));
  for (int i = 0; i < 100; ++i) {
    scene.nodes.push_back(scene.nodes[0]);
    scene.roots.emplace_back(scene.nodes.size() - 1);
  }
  azulejo::Run run;
  run.limits.memory_bytes = 100000;
  refusal(Error::Resource, [&] { ZBufferRenderer(scene).draw(flat_view(), {}, run); });
}

TEST(ZBufferEdges, OptionsOutOfRangeAreRefused) {
  const Scene scene = scene_of(soup_of({{-5, -5, 0}, {5, -5, 0}, {0, 5, 0}}));
  const auto refused = [&](const ZBufferOptions& options, const char* named) {
    const std::string message =
        refusal(Error::Argument, [&] { ZBufferRenderer(scene, options).draw(flat_view(), {}); });
    EXPECT_NE(message.find(named), std::string::npos) << message;
  };
  for (const int antialias : {0, 2, 3, -1, 32}) refused({.antialias = antialias}, "antialias");
  refused({.layers = {}}, "layers");
  refused({.layers = {"color", "colour"}}, "colour");
  refused({.layers = {"depth", "depth"}}, "twice");
  refused({.crease_angle = -1}, "crease");
  refused({.crease_angle = kNan}, "crease");
  for (const float bad : {-1.0F, kNan, kInfinity, 1e6F}) {
    refused({.line_width = bad}, "line_width");
    refused({.point_size = bad}, "point_size");
  }
  ZBufferOptions programmed;
  programmed.program.varyings = 17;
  refused(programmed, "varyings");
}

TEST(ZBufferEdges, CancellingEnds) {
  const Scene scene = scene_of(sphere_mesh(30));
  const CancelToken token;
  token.cancel();
  azulejo::Run run;
  run.cancel = &token;
  refusal(Error::Cancelled, [&] { ZBufferRenderer(scene).draw(flat_view(), {}, run); });
}

TEST(ZBufferEdges, AFrameIsDrawnIntoAgain) {
  const Scene scene = scene_of(soup_of({{-5, -5, 0}, {5, -5, 0}, {0, 5, 0}}));
  const ZBufferRenderer renderer(scene);
  const Frame once = renderer.draw(flat_view(), {});
  View moved = flat_view();
  moved.view_from_world[3][0] += 3;
  Frame twice = renderer.draw(moved, {});
  EXPECT_FALSE(same_pixels(once, twice));
  renderer.draw_into(twice, flat_view(), {});
  EXPECT_TRUE(same_pixels(once, twice));
}

}  // namespace
}  // namespace azulejo
