#include "azulejo/rendering/render.h"

#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "azulejo/core/error.h"
#include "azulejo/engine/stages.h"
#include "azulejo/operations.h"
#include "azulejo/rendering/render_operation.h"
#include "azulejo/rendering/rendering_testing.h"

namespace azulejo {
namespace {

Scene box() { return scene_of(box_mesh({-1, -1, -1}, {1, 1, 1})); }

/// Rows and columns that have a pixel that isn't transparent.
Rect covered(const Image& image) {
  Rect rect;
  const auto view = image.view<std::uint8_t>();
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if (view(x, y, 3) > 0) rect = united(rect, Rect{x, y, 1, 1});
    }
  }
  return rect;
}

bool same_bytes(const Image& a, const Image& b) {
  if (a.info() != b.info()) return false;
  for (int y = 0; y < a.height(); ++y) {
    if (std::memcmp(a.any().row(y), b.any().row(y), static_cast<std::size_t>(a.info().row_bytes())) != 0) return false;
  }
  return true;
}

std::string refusal(const Scene& scene, const RenderOptions& options, Error::Kind kind = Error::Argument) {
  try {
    render(scene, options);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "";
}

TEST(Render, AFramedBoxFillsNineTenths) {
  for (const auto& [width, height] : {std::pair{300, 200}, {200, 300}}) {
    const Frame frame = render(box(), {.width = width, .height = height});
    ASSERT_EQ(frame.layers.size(), 1U);
    const Image& color = *frame.find("color");
    EXPECT_EQ(color.info().type, PixelType::U8);
    const Rect rect = covered(color);
    const double share = std::max(rect.width / (1.0 * width), rect.height / (1.0 * height));
    EXPECT_NEAR(share, 0.9, 2.5 / std::min(width, height));
    // Centred, to a pixel at each side.
    EXPECT_NEAR(rect.x, width - rect.right(), 2);
    EXPECT_NEAR(rect.y, height - rect.bottom(), 2);
  }
}

TEST(Render, DepthAndPositionAgreeWithTheCamera) {
  const Frame frame = render(
      box(), {.width = 64, .height = 48, .layers = {FrameLayer::Depth, FrameLayer::Position, FrameLayer::Color}});
  EXPECT_EQ(frame.layers[0].name, "color") << "color comes first";
  const auto depth = frame.find("depth")->view<float>();
  const auto position = frame.find("position")->view<float>();
  const Json camera = Json::parse(frame.camera.dump(), "camera");
  int seen = 0;
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      if (!std::isfinite(depth(x, y))) continue;
      ++seen;
      const double p[] = {position(x, y, 0), position(x, y, 1), position(x, y, 2), 1};
      double axes[3] = {};
      for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 4; ++c) axes[r] += camera["opencv"]["camera_from_world"][r][c].number() * p[c];
      }
      EXPECT_NEAR(axes[2], depth(x, y), 1e-4);
      // At its pixel's centre, or inside the pixel at the rim.
      EXPECT_NEAR(camera["fx"].number() * axes[0] / axes[2] + camera["cx"].number(), x + 0.5, 0.51);
      EXPECT_NEAR(camera["fy"].number() * axes[1] / axes[2] + camera["cy"].number(), y + 0.5, 0.51);
    }
  }
  EXPECT_GT(seen, 500);
}

TEST(Render, EmptyScenesGiveTheBackground) {
  for (const Scene& scene : {Scene{}.clone(), scene_of_points({}), scene_of(Mesh{})}) {
    const Frame clear = render(scene, {.width = 5, .height = 3});
    EXPECT_TRUE(covered(*clear.find("color")).empty());
    const Frame red = render(scene, {.width = 5, .height = 3, .background = {1, 0, 0, 1}});
    const auto view = red.find("color")->view<std::uint8_t>();
    EXPECT_EQ(view(4, 2, 0), 255);
    EXPECT_EQ(view(4, 2, 1), 0);
    EXPECT_EQ(view(4, 2, 3), 255);
  }
}

/// Two viewports in one picture: each pixel is that of the one picture or of the other.
TEST(Render, DrawsOntoAPictureInTheViewportOnly) {
  const Scene scene = box();
  RenderOptions left{.width = 200, .height = 90, .background = {0, 0.5F, 0, 1}};
  left.camera.viewport = std::array<float, 4>{0, 0, 100, 90};
  const Frame first = render(scene, left);
  RenderOptions right = left;
  right.width = right.height = 1;  // the image says it
  right.background = {1, 0, 0, 1};
  right.camera.viewport = std::array<float, 4>{100, 10, 90, 60};
  right.camera.view = ViewDirection::Top;
  const Image& under = *first.find("color");
  const RenderOptions options = options_onto(under, right);
  EXPECT_EQ(options.width, 200);
  const Frame both = SceneRenderer(scene, options).draw_onto(under, options.camera);
  const Frame alone = render(scene, options);
  const auto a = under.view<std::uint8_t>();
  const auto b = alone.find("color")->view<std::uint8_t>();
  const auto result = both.find("color")->view<std::uint8_t>();
  for (int y = 0; y < 90; ++y) {
    for (int x = 0; x < 200; ++x) {
      const bool inside = x >= 100 && x < 190 && y >= 10 && y < 70;
      for (int c = 0; c < 4; ++c) ASSERT_EQ(result(x, y, c), inside ? b(x, y, c) : a(x, y, c)) << x << "," << y;
    }
  }
  right.layers = {FrameLayer::Depth};
  EXPECT_THROW(options_onto(under, right), Error);
}

struct SeenMeshes final : Stages {
  void image(const std::string&, const std::string&, const Image&) override {}
  void mesh(const std::string& step, const std::string& name, const Mesh& mesh) override {
    EXPECT_EQ(step, "render");
    positions[name] = mesh.positions;
  }
  void report(const std::string&, const std::string& name, const Json&) override { reports.insert(name); }
  std::map<std::string, Array<glm::vec3>> positions;
  std::set<std::string> reports;
};

/// Each step of the viewing transformation, from where the camera says it is to pixels.
TEST(Render, ReportsTheStagesOfTheViewingTransformation) {
  const Scene scene = box();
  RenderOptions options{.width = 120, .height = 90};
  options.camera.viewport = std::array<float, 4>{20, 10, 60, 80};
  SeenMeshes seen;
  azulejo::Run run;
  run.stages = &seen;
  render(scene, options, run);
  const View view = choose_camera(scene, options.camera, 120, 90).view;
  ASSERT_EQ(seen.positions.size(), 4U);
  EXPECT_TRUE(seen.reports.contains("matrices"));
  for (std::size_t v = 0; v < 8; ++v) {
    const glm::vec3 world = scene.meshes[0]->positions[v];
    EXPECT_EQ(seen.positions["world"][v], world);
    const glm::vec3 in_view(view.view_from_world * glm::vec4(world, 1));
    const glm::vec4 clip = view.clip_from_view * glm::vec4(in_view, 1);
    const glm::dvec3 pixel = pixel_of(view, world);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(seen.positions["view"][v][axis], in_view[axis], 1e-5);
      EXPECT_NEAR(seen.positions["ndc"][v][axis], clip[axis] / clip.w, 1e-5);
    }
    EXPECT_NEAR(seen.positions["viewport"][v].x, pixel.x, 1e-3);
    EXPECT_NEAR(seen.positions["viewport"][v].y, pixel.y, 1e-3);
    EXPECT_NEAR(seen.positions["viewport"][v].z, depth_of(view, world), 1e-5);
  }
}

TEST(Render, SaysThatThereIsNothingToSee) {
  int warnings = 0;
  azulejo::Run run;
  run.warn = [&](const std::string& line) {
    ++warnings;
    EXPECT_NE(line.find("nothing to show"), std::string::npos) << line;
  };
  const float nan = std::nanf("");
  for (const Scene& scene : {Scene{}.clone(), scene_of_points({{nan, 0, 0}}), scene_of_points({{3e38F, 0, 0}})}) {
    render(scene, {.width = 5, .height = 3}, run);
  }
  EXPECT_EQ(warnings, 3);
  render(box(), {.width = 5, .height = 3}, run);
  EXPECT_EQ(warnings, 3);
}

/// The albedo in the middle of a picture of the mesh from the front, and its material's number.
std::pair<glm::vec3, float> middle(Mesh mesh) {
  RenderOptions options{.width = 9, .height = 9, .layers = {FrameLayer::Albedo, FrameLayer::Material}};
  options.camera.view = ViewDirection::Front;
  options.point_size = 9;
  const Frame frame = render(scene_of(std::move(mesh)), options);
  const auto albedo = frame.find("albedo")->view<float>();
  return {{albedo(4, 4, 0), albedo(4, 4, 1), albedo(4, 4, 2)}, frame.find("material_id")->view<float>()(4, 4)};
}

TEST(Render, WithoutAMaterialColorsAreAsTheyAreAndTheRestIsGray) {
  Mesh point;
  point.positions = {{0, 0, 0}};
  const auto colored = [](Mesh mesh) {
    Array<float> colors;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) colors.insert(colors.end(), {1.0F, 0.5F, 0.25F});
    mesh.attributes.push_back({"COLOR_0", Domain::Vertex, 3, std::move(colors)});
    return mesh;
  };
  const Mesh cube = box_mesh({-1, -1, -1}, {1, 1, 1});
  EXPECT_EQ(middle(cube.clone()), std::pair(glm::vec3(0.6F), 1.0F));
  const glm::vec3 gray = middle(point.clone()).first;
  EXPECT_TRUE(gray.x > 0.05F && gray.x < 0.5F) << gray.x << ": seen neither before white nor before black";
  for (const Mesh& mesh : {cube.clone(), point.clone()}) {
    const auto [color, material] = middle(colored(mesh.clone()));
    EXPECT_NEAR(color.x, 1, 1e-6);
    EXPECT_NEAR(color.y, 0.5, 1e-6);
    EXPECT_NEAR(color.z, 0.25, 1e-6);
    EXPECT_EQ(material, 1);
  }
}

TEST(Render, PointsWithNormalsAreLit) {
  RenderOptions options{.width = 9, .height = 9, .point_size = 9};
  options.camera.view = ViewDirection::Front;
  options.lighting.lights = LightChoice::Headlight;
  options.lighting.ambient = 0.0F;
  const auto brightness = [&](const glm::vec3& normal) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}};
    mesh.attributes.push_back({"NORMAL", Domain::Vertex, 3, Array<float>{normal.x, normal.y, normal.z}});
    return int{render(scene_of(std::move(mesh)), options).find("color")->view<std::uint8_t>()(4, 4, 0)};
  };
  EXPECT_GT(brightness({0, 0, 1}), brightness({0.8F, 0, 0.6F}) + 20);
}

TEST(Render, ExposureIsInStops) {
  RenderOptions options{.width = 40, .height = 40, .antialias = 1, .output = FrameOutput::Display16};
  options.camera.view = ViewDirection::Front;
  options.lighting.lights = LightChoice::Headlight;
  options.exposure = -2;
  const Scene scene = box();
  const auto decode = [](std::uint16_t value) { return std::pow((value / 65535.0 + 0.055) / 1.055, 2.4); };
  const Frame dark = render(scene, options);
  options.exposure = -1;
  const Frame bright = render(scene, options);
  const double ratio = decode(bright.find("color")->view<std::uint16_t>()(20, 20, 0)) /
                       decode(dark.find("color")->view<std::uint16_t>()(20, 20, 0));
  EXPECT_NEAR(ratio, 2, 0.01);
}

TEST(Render, APreparedSceneGivesTheSamePictures) {
  const Scene scene = box();
  const RenderOptions options{.width = 50, .height = 40};
  const SceneRenderer renderer(scene, options);
  for (const float azimuth : {0.0F, 100.0F}) {
    RenderOptions each = options;
    each.camera.azimuth_deg = azimuth;
    EXPECT_TRUE(same_bytes(*render(scene, each).find("color"), *renderer.draw(each.camera).find("color")));
    EXPECT_TRUE(same_bytes(*render(scene, each, {.threads = 1}).find("color"),
                           *render(scene, each, {.threads = 7}).find("color")));
  }
}

TEST(Render, TellsWhatHappened) {
  RenderStatistics statistics;
  render(box(), {.width = 50, .height = 40}, {}, &statistics);
  EXPECT_EQ(statistics.faces.faces_in, 12U);
  EXPECT_EQ(statistics.lights, LightChoice::Default);
  EXPECT_EQ(statistics.exposure, 1);
}

/// A box that moves from the origin to (10, 0, 0) in two seconds.
Scene moving_box() {
  Scene scene = box();
  scene.nodes[0].placement = Placement{};
  Animation animation;
  animation.name = "slide";
  AnimationChannel channel;
  channel.node = NodeId(0);
  channel.times = {0, 2};
  channel.values = {0, 0, 0, 10, 0, 0};
  animation.channels.push_back(std::move(channel));
  scene.animations.push_back(std::move(animation));
  return scene;
}

TEST(Render, TimeMovesTheScene) {
  const Scene scene = moving_box();
  EXPECT_EQ(animation_duration(scene, ""), 2);
  EXPECT_EQ(animation_duration(scene, "slide"), 2);
  EXPECT_EQ(animation_duration(box(), ""), 0);
  RenderOptions options{.width = 32, .height = 32, .antialias = 1, .layers = {FrameLayer::Position}};
  options.camera.view = ViewDirection::Front;
  options.time_s = 1;
  EXPECT_NEAR(render(scene, options).find("position")->view<float>()(16, 16, 0), 5, 0.1);
  options.time_s.reset();
  EXPECT_NEAR(render(scene, options).find("position")->view<float>()(16, 16, 0), 0, 0.1);
  options.animation = "slid";
  EXPECT_NE(refusal(scene, options).find("did you mean slide?"), std::string::npos);
  EXPECT_NE(refusal(box(), options).find("the scene has none"), std::string::npos);
}

TEST(Render, RefusesPicturesThatDontFit) {
  EXPECT_NE(refusal(box(), {.width = 0}), "");
  EXPECT_NE(refusal(box(), {.height = 65537}), "");
  EXPECT_NE(refusal(box(), {.antialias = 3}), "");
  EXPECT_NE(refusal(box(), {.layers = {}}), "");
  EXPECT_NE(refusal(box(), {.width = 65536, .height = 65536}, Error::Resource), "");
  azulejo::Run run;
  run.limits.pixels = 100;
  EXPECT_THROW(render(box(), {.width = 11, .height = 10}, run), Error);
}

TEST(Render, TheOperationHasAllOfIt) {
  const Operation* const operation = find_operation("render");
  ASSERT_NE(operation, nullptr);
  std::set<std::string> names;
  for (const Field& each : operation->fields) EXPECT_TRUE(names.insert(each.name).second) << each.name << " twice";
  const std::shared_ptr<void> options = operation->make_options();
  EXPECT_NO_THROW(operation->check(options.get()));
  const std::pair<const char*, const char*> arguments[] = {{"width", "40"},         {"height", "30"},
                                                           {"azimuth_deg", "10"},   {"lights", "headlight"},
                                                           {"background", "white"}, {"layers", "color,object_id"}};
  for (const auto& [name, text] : arguments) {
    const Field* const field = operation->find_field(name);
    ASSERT_NE(field, nullptr) << name;
    field->parse(options.get(), text);
  }
  const auto& parsed = *static_cast<const RenderOptions*>(options.get());
  EXPECT_EQ(parsed.camera.azimuth_deg, 10.0F);
  EXPECT_EQ(parsed.lighting.lights, LightChoice::Headlight);
  const Value scene(box());
  const std::vector<Value> values = invoke(*operation, options.get(), {&scene, 1}, {});
  ASSERT_EQ(values.size(), operation->outputs.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string& name = operation->outputs[i].name;
    const bool layer = i >= 3;
    EXPECT_EQ(values[i].empty(), layer && name != "color" && name != "object_id") << name;
    if (!values[i].empty()) {
      EXPECT_EQ(values[i].kind(), operation->outputs[i].kind) << name;
    }
  }
  EXPECT_EQ(values[2].report()->json["faces_in"].number(), 12);
  EXPECT_THROW(operation->find_field("width")->parse(options.get(), "0"), Error);
}

}  // namespace
}  // namespace azulejo
