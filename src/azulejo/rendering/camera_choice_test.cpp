#include "azulejo/rendering/camera_choice.h"

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include "azulejo/core/error.h"
#include "azulejo/rendering/rendering_testing.h"

namespace azulejo {
namespace {

constexpr int kWidth = 800;
constexpr int kHeight = 600;

struct Bounds2 {
  glm::dvec2 lower{1e300, 1e300};
  glm::dvec2 upper{-1e300, -1e300};
};

/// What points fill of the picture, −1…1 both ways.
Bounds2 filled(const View& view, const std::vector<glm::vec3>& points) {
  Bounds2 box;
  for (const glm::vec3& point : points) {
    const glm::dvec3 pixel = pixel_of(view, point);
    const glm::dvec2 ndc(2 * pixel.x / view.width - 1, 1 - 2 * pixel.y / view.height);
    box = {{std::min(box.lower.x, ndc.x), std::min(box.lower.y, ndc.y)},
           {std::max(box.upper.x, ndc.x), std::max(box.upper.y, ndc.y)}};
  }
  return box;
}

std::vector<glm::vec3> random_points(unsigned seed, int count, const glm::vec3& size, const glm::vec3& center) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  std::vector<glm::vec3> points;
  for (int i = 0; i < count; ++i)
    points.push_back(center + size * glm::vec3(normal(random), normal(random), normal(random)));
  return points;
}

/// Against the way that the camera looks.
glm::dvec3 back_of(const View& view) {
  return {view.view_from_world[0][2], view.view_from_world[1][2], view.view_from_world[2][2]};
}

glm::dvec3 eye_of(const View& view) { return glm::dvec3(glm::inverse(glm::dmat4(view.view_from_world))[3]); }

std::string refusal(const Scene& scene, const CameraOptions& options, int width = kWidth, int height = kHeight) {
  try {
    choose_camera(scene, options, width, height);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Error::Argument);
    return error.what();
  }
  return "";
}

TEST(CameraChoice, FramedPointsFillNineTenthsAndAreCentred) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    const glm::vec3 size(1 + seed % 5, 1 + seed % 3, 1 + seed % 7);
    const std::vector<glm::vec3> points = random_points(seed, 200, size, {10.0F * static_cast<float>(seed % 4), -3, 5});
    const Scene scene = scene_of_points(points, seed % 2 == 0 ? UpAxis::Y : UpAxis::Z);
    for (const auto& [width, height] : {std::pair{800, 600}, {600, 800}, {1920, 200}, {64, 1024}}) {
      for (const auto projection : {Projection::Perspective, Projection::Orthographic}) {
        CameraOptions options;
        options.azimuth_deg = 37.0F * static_cast<float>(seed);
        options.elevation_deg = -80.0F + 5.0F * static_cast<float>(seed);
        options.fov_deg = seed % 2 == 0 ? 35.0F : 90.0F;
        options.projection = projection;
        const View view = choose_camera(scene, options, width, height).view;
        const Bounds2 box = filled(view, points);
        // Half a pixel to each side.
        const double x = 1.0 / width;
        const double y = 1.0 / height;
        EXPECT_NEAR(box.lower.x, -box.upper.x, 2 * x);
        EXPECT_NEAR(box.lower.y, -box.upper.y, 2 * y);
        EXPECT_LE(box.upper.x, 0.9 + x);
        EXPECT_LE(box.upper.y, 0.9 + y);
        EXPECT_TRUE(box.upper.x > 0.9 - x || box.upper.y > 0.9 - y) << box.upper.x << " " << box.upper.y;
        for (const glm::vec3& point : points) {
          EXPECT_GT(depth_of(view, point), 0);
          EXPECT_LT(depth_of(view, point), 1);
        }
      }
    }
  }
}

TEST(CameraChoice, AnglesGoCounterClockwiseFromTheFront) {
  const struct {
    ViewDirection direction;
    glm::dvec3 y_up;
    glm::dvec3 z_up;
  } cases[] = {{ViewDirection::Front, {0, 0, 1}, {0, -1, 0}},
               {ViewDirection::Back, {0, 0, -1}, {0, 1, 0}},
               {ViewDirection::Right, {1, 0, 0}, {1, 0, 0}},
               {ViewDirection::Left, {-1, 0, 0}, {-1, 0, 0}},
               {ViewDirection::Top, {0, 1, 0}, {0, 0, 1}},
               {ViewDirection::Bottom, {0, -1, 0}, {0, 0, -1}},
               {ViewDirection::Isometric,
                glm::dvec3(1 / std::sqrt(3.0)),
                {1 / std::sqrt(3.0), -1 / std::sqrt(3.0), 1 / std::sqrt(3.0)}}};
  for (const UpAxis up : {UpAxis::Y, UpAxis::Z}) {
    const Scene scene = scene_of_points(box_corners({-1, -1, -1}, {1, 1, 1}), up);
    for (const auto& each : cases) {
      CameraOptions options;
      options.view = each.direction;
      const View view = choose_camera(scene, options, kWidth, kHeight).view;
      const glm::dvec3 direction = back_of(view);
      const glm::dvec3 expected = up == UpAxis::Y ? each.y_up : each.z_up;
      EXPECT_LT(glm::length(direction - expected), 1e-6) << static_cast<int>(each.direction) << " " << to_string(up);
    }
  }
}

TEST(CameraChoice, UpIsUpAndTheFrontIsAtTheBottomSeenFromAbove) {
  for (const UpAxis up : {UpAxis::Y, UpAxis::Z}) {
    const Scene scene = scene_of_points(box_corners({-1, -1, -1}, {1, 1, 1}), up);
    const glm::vec3 above = up == UpAxis::Y ? glm::vec3(0, 0.5F, 0) : glm::vec3(0, 0, 0.5F);
    const glm::vec3 before = up == UpAxis::Y ? glm::vec3(0, 0, 0.5F) : glm::vec3(0, -0.5F, 0);
    // Without perspective what is upright in the world is so in the picture.
    const View side = choose_camera(scene, {.projection = Projection::Orthographic}, kWidth, kHeight).view;
    EXPECT_LT(pixel_of(side, above).y, pixel_of(side, {0, 0, 0}).y);
    EXPECT_NEAR(pixel_of(side, above).x, pixel_of(side, {0, 0, 0}).x, 1e-3);
    CameraOptions options;
    options.view = ViewDirection::Top;
    const View top = choose_camera(scene, options, kWidth, kHeight).view;
    EXPECT_GT(pixel_of(top, before).y, pixel_of(top, {0, 0, 0}).y);
    EXPECT_GT(pixel_of(top, {0.5F, 0, 0}).x, pixel_of(top, {0, 0, 0}).x);
    // Seen from azimuth 30°, the front is turned to the left.
    EXPECT_LT(pixel_of(side, before).x, pixel_of(side, {0, 0, 0}).x);
  }
}

TEST(CameraChoice, AnotherUpTurnsTheArrangement) {
  const Scene scene = scene_of_points(box_corners({-1, -1, -1}, {1, 1, 1}));
  for (const glm::vec3 up :
       {glm::vec3(0, 0, 1), glm::vec3(1, 0, 0), glm::vec3(0, -1, 0), glm::vec3(1e-20F, 3e-20F, 0)}) {
    CameraOptions options{.projection = Projection::Orthographic};
    options.up = up;
    const View view = choose_camera(scene, options, kWidth, kHeight).view;
    const glm::vec3 above = glm::vec3(glm::normalize(glm::dvec3(up))) * 0.5F;
    EXPECT_LT(pixel_of(view, above).y, pixel_of(view, {0, 0, 0}).y - 10);
    EXPECT_NEAR(pixel_of(view, above).x, pixel_of(view, {0, 0, 0}).x, 1e-2);
  }
}

TEST(CameraChoice, APositionLooksAtTheTarget) {
  const Scene scene = scene_of_points(box_corners({4, 4, 4}, {6, 6, 6}));
  CameraOptions options;
  options.position = glm::vec3(1, 2, 20);
  const ChosenCamera center = choose_camera(scene, options, kWidth, kHeight);
  EXPECT_NEAR(pixel_of(center.view, {5, 5, 5}).x, kWidth / 2.0, 1e-2);
  EXPECT_NEAR(pixel_of(center.view, {5, 5, 5}).y, kHeight / 2.0, 1e-2);
  EXPECT_EQ(center.pose.position, *options.position);
  options.target = glm::vec3(1, 8, 20);  // straight up: along the up axis
  const View straight = choose_camera(scene, options, kWidth, kHeight).view;
  EXPECT_NEAR(pixel_of(straight, {1, 7, 20}).x, kWidth / 2.0, 1e-2);
  EXPECT_NEAR(pixel_of(straight, {1, 7, 20}).z, 5, 1e-4) << "w is the distance along the axis";
  options.fov_deg = 90;
  options.target = glm::vec3(1, 2, 0);
  const View wide = choose_camera(scene, options, kWidth, kHeight).view;
  EXPECT_NEAR(pixel_of(wide, {1, 3, 19}).y, 0, 1e-3) << "45° above the middle is the upper edge";
}

TEST(CameraChoice, ATargetStaysInTheMiddleAndADistanceIsKept) {
  const std::vector<glm::vec3> corners = box_corners({-1, -2, -3}, {1, 2, 3});
  const Scene scene = scene_of_points(corners);
  for (const auto projection : {Projection::Perspective, Projection::Orthographic}) {
    CameraOptions options;
    options.projection = projection;
    options.target = glm::vec3(0.5F, 1, -1);
    const ChosenCamera chosen = choose_camera(scene, options, kWidth, kHeight);
    EXPECT_NEAR(pixel_of(chosen.view, *options.target).x, kWidth / 2.0, 1e-3);
    EXPECT_NEAR(pixel_of(chosen.view, *options.target).y, kHeight / 2.0, 1e-3);
    const Bounds2 box = filled(chosen.view, corners);
    const double most = std::max({-box.lower.x, -box.lower.y, box.upper.x, box.upper.y});
    EXPECT_NEAR(most, 0.9, 1.0 / kHeight);
  }
  CameraOptions options;
  options.distance = 12.5F;
  const ChosenCamera chosen = choose_camera(scene, options, kWidth, kHeight);
  EXPECT_NEAR(glm::length(eye_of(chosen.view)), 12.5, 1e-5);
  EXPECT_NEAR(chosen.distance, 12.5, 1e-5);
}

/// Two cameras of the file, the second first in the hierarchy, the first one scaled and mirrored.
Scene scene_with_cameras() {
  Scene scene = scene_of_points(box_corners({-1, -1, -1}, {1, 1, 1}));
  scene.cameras.resize(3);
  scene.cameras[0].name = "main";
  scene.cameras[0].fov_y = 1.0F;
  scene.cameras[0].aspect = 3;
  scene.cameras[0].near = 0.5F;
  scene.cameras[1].perspective = false;
  scene.cameras[1].height = 4;
  scene.cameras[1].near = 1;
  scene.cameras[1].far = 21;
  scene.cameras[2].name = "nowhere";
  Node side;
  side.name = "side view";
  side.camera = CameraId(1);
  side.placement =
      glm::rotate(glm::mat4(1), 1.57079633F, glm::vec3(0, 1, 0)) * glm::translate(glm::mat4(1), {0, 0, 11});
  Node main;
  main.camera = CameraId(0);
  main.placement = glm::translate(glm::mat4(1), {0, 0, 10}) * glm::scale(glm::mat4(1), {-2, 3, 5});
  scene.nodes.push_back(side);
  scene.nodes.push_back(main);
  scene.roots.emplace_back(1);
  scene.roots.emplace_back(2);
  return scene;
}

TEST(CameraChoice, TheFilesFirstCameraIsTakenWithItsVerticalAngle) {
  const Scene scene = scene_with_cameras();
  const ChosenCamera chosen = choose_camera(scene, {}, kWidth, kHeight);
  EXPECT_TRUE(chosen.from_file);
  EXPECT_EQ(chosen.name, "main");
  EXPECT_EQ(chosen.view.near, 0.5F);
  EXPECT_EQ(chosen.view.far, 0.0F) << "infinite";
  EXPECT_NEAR(glm::length(eye_of(chosen.view) - glm::dvec3(0, 0, 10)), 0, 1e-5);
  const float edge = 10 * std::tan(0.5F);
  EXPECT_NEAR(pixel_of(chosen.view, {0, edge, 0}).y, 0, 1e-2);
  // Pixels are square, whatever aspect the camera was made for.
  const double per_unit_x = pixel_of(chosen.view, {1, 0, 0}).x - kWidth / 2.0;
  const double per_unit_y = kHeight / 2.0 - pixel_of(chosen.view, {0, 1, 0}).y;
  EXPECT_NEAR(per_unit_x, per_unit_y, 1e-3);
  EXPECT_NEAR(depth_of(chosen.view, {0, 0, 9.5F}), 1, 1e-6);
  EXPECT_NEAR(depth_of(chosen.view, {0, 0, -1e6F}), 0, 1e-6);
}

TEST(CameraChoice, CamerasAreFoundByNameNodeAndNumber) {
  const Scene scene = scene_with_cameras();
  for (const char* name : {"side view", "1"}) {
    CameraOptions options;
    options.camera = name;
    const ChosenCamera chosen = choose_camera(scene, options, kWidth, kHeight);
    EXPECT_FALSE(chosen.view.perspective);
    EXPECT_NEAR(pixel_of(chosen.view, {0, 2, 0}).y, 0, 1e-3) << "4 units from bottom to top";
    EXPECT_NEAR(depth_of(chosen.view, {10, 0, 0}), 1, 1e-6);
    EXPECT_NEAR(depth_of(chosen.view, {-10, 0, 0}), 0, 1e-6);
  }
  EXPECT_NE(refusal(scene, {.camera = "man"}).find("did you mean main?"), std::string::npos);
  EXPECT_NE(refusal(scene, {.camera = "nowhere"}), "");
  EXPECT_NE(refusal(scene, {.camera = "7"}), "");
  EXPECT_NE(refusal(scene_of_points({{0, 0, 0}}), {.camera = "x"}).find("no camera"), std::string::npos);
}

TEST(CameraChoice, ANamedCameraWinsOverAPlaceAndSaysSo) {
  const Scene scene = scene_with_cameras();
  CameraOptions options;
  options.position = glm::vec3(3, 4, 5);
  EXPECT_FALSE(choose_camera(scene, options, kWidth, kHeight).from_file);
  options.camera = "main";
  azulejo::Run run;
  int warnings = 0;
  run.warn = [&](const std::string&) { ++warnings; };
  EXPECT_EQ(choose_camera(scene, options, kWidth, kHeight, run).name, "main");
  EXPECT_EQ(warnings, 1);
}

TEST(CameraChoice, ZoomMagnifiesAboutTheMiddle) {
  const Scene scene = scene_of_points(box_corners({-1, -1, -1}, {1, 1, 1}));
  for (const auto projection : {Projection::Perspective, Projection::Orthographic}) {
    CameraOptions options;
    options.projection = projection;
    const View once = choose_camera(scene, options, kWidth, kHeight).view;
    options.zoom = 2.5F;
    const View zoomed = choose_camera(scene, options, kWidth, kHeight).view;
    const glm::dvec2 middle(kWidth / 2.0, kHeight / 2.0);
    for (const glm::vec3& corner : box_corners({-1, -1, -1}, {1, 1, 1})) {
      const glm::dvec2 expected = middle + 2.5 * (glm::dvec2(pixel_of(once, corner)) - middle);
      EXPECT_LT(glm::length(glm::dvec2(pixel_of(zoomed, corner)) - expected), 1e-2);
    }
  }
}

TEST(CameraChoice, AWindowFillsTheViewport) {
  const Scene scene = scene_of_points(box_corners({-1, -1, -1}, {1, 1, 1}));
  for (const auto projection : {Projection::Perspective, Projection::Orthographic}) {
    CameraOptions options;
    options.projection = projection;
    const View whole = choose_camera(scene, options, 400, 400).view;
    options.window = {-0.5F, 0, 0.25F, 0.75F};
    options.viewport = std::array<float, 4>{100, 50, 400, 400};
    const View part = choose_camera(scene, options, 600, 500).view;
    EXPECT_EQ(part.viewport, (Rect{100, 50, 400, 400}));
    for (const glm::vec3& corner : box_corners({-1, -1, -1}, {1, 1, 1})) {
      const glm::dvec3 from = pixel_of(whole, corner);
      const glm::dvec2 ndc(from.x / 200 - 1, 1 - from.y / 200);
      const glm::dvec2 inside((ndc.x + 0.5) / 0.75, ndc.y / 0.75);
      const glm::dvec3 to = pixel_of(part, corner);
      EXPECT_NEAR(to.x, 100 + 400 * inside.x, 1e-2);
      EXPECT_NEAR(to.y, 50 + 400 * (1 - inside.y), 1e-2);
    }
  }
}

/// A window twice as wide as high in a square viewport, by each policy.
TEST(CameraChoice, AWindowOfAnotherShapeKeepsItsShapeOrIsStretchedWithAWarning) {
  const Scene scene = scene_of_points(box_corners({-1, -1, -1}, {1, 1, 1}));
  CameraOptions options;
  const View whole = choose_camera(scene, options, 400, 400).view;
  options.window = {-1, -0.5F, 1, 0.5F};
  options.viewport = std::array<float, 4>{100, 50, 400, 400};
  const auto at = [&](AspectPolicy aspect, const glm::dvec2& scale, std::string* warning) {
    options.aspect = aspect;
    azulejo::Run run;
    run.warn = [&](const std::string& text) { *warning += text; };
    const View part = choose_camera(scene, options, 600, 500, run).view;
    for (const glm::vec3& corner : box_corners({-1, -1, -1}, {1, 1, 1})) {
      const glm::dvec2 expected = glm::dvec2(300, 250) + scale * (glm::dvec2(pixel_of(whole, corner)) - 200.0);
      EXPECT_NEAR(pixel_of(part, corner).x, expected.x, 1e-2);
      EXPECT_NEAR(pixel_of(part, corner).y, expected.y, 1e-2);
    }
    return part.viewport;
  };
  std::string warning;
  EXPECT_EQ(at(AspectPolicy::Fit, {1, 1}, &warning), (Rect{100, 150, 400, 200}));
  EXPECT_EQ(at(AspectPolicy::Fill, {2, 2}, &warning), (Rect{100, 50, 400, 400}));
  EXPECT_EQ(warning, "");
  EXPECT_EQ(at(AspectPolicy::Stretch, {1, 2}, &warning), (Rect{100, 50, 400, 400}));
  EXPECT_NE(warning.find("0.5 times"), std::string::npos) << warning;
}

bool is_sound(const View& view) {
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) {
      if (!std::isfinite(view.view_from_world[c][r]) || !std::isfinite(view.clip_from_view[c][r])) return false;
    }
  }
  return view.near >= 0 && view.far > view.near && view.clip_from_view[0][0] > 0 && view.clip_from_view[1][1] > 0;
}

TEST(CameraChoice, AnySceneGivesASoundView) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  std::vector<Scene> scenes;
  scenes.emplace_back();
  scenes.push_back(scene_of_points({}));
  scenes.push_back(scene_of_points({{0, 0, 0}}));
  scenes.push_back(scene_of_points({{1, 2, 3}}));
  scenes.push_back(scene_of_points({{nan, 0, 0}, {0, infinity, 0}, {3e38F, 0, 0}}));
  scenes.push_back(scene_of_points({{0, 0, 0}, {1, 0, 0}}));
  scenes.push_back(scene_of_points({{0, 0, -5}, {0, 0, 5}}));
  scenes.push_back(scene_of_points(box_corners({-1, 0, -1}, {1, 0, 1})));
  scenes.push_back(scene_of_points(box_corners({1e6F, 1e6F, 1e6F}, {1e6F + 1, 1e6F + 1, 1e6F + 1})));
  for (const float size : {1e-20F, 1e-10F, 1e-5F, 1e5F, 1e10F, 1e20F}) {
    scenes.push_back(scene_of_points(box_corners(glm::vec3(-size), glm::vec3(size))));
  }
  Scene singular = scene_of_points(box_corners({-1, -1, -1}, {1, 1, 1}));
  singular.nodes[0].placement = glm::mat4(0.0F);
  scenes.push_back(std::move(singular));
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    for (const auto projection : {Projection::Perspective, Projection::Orthographic}) {
      for (const auto view :
           {ViewDirection::Front, ViewDirection::Right, ViewDirection::Top, ViewDirection::Isometric}) {
        CameraOptions options;
        options.view = view;
        options.projection = projection;
        EXPECT_TRUE(is_sound(choose_camera(scenes[s], options, kWidth, kHeight).view)) << s;
        options = {.projection = projection};
        const Box3 box = bounds(scenes[s]);
        options.position = box.empty() || box.upper.x > 1e30F ? glm::vec3(0) : box.center();
        EXPECT_TRUE(is_sound(choose_camera(scenes[s], options, 1, 1).view)) << s << " from its middle";
      }
    }
  }
}

TEST(CameraChoice, ACameraInsideSeesFromNearToTheEnd) {
  const Scene scene = scene_of_points(box_corners({-5, -5, -5}, {5, 5, 5}));
  CameraOptions options;
  options.position = glm::vec3(0, 0, 0);
  options.target = glm::vec3(0, 0, -1);
  const View view = choose_camera(scene, options, kWidth, kHeight).view;
  EXPECT_GT(view.near, 0);
  EXPECT_LT(view.near, 1e-3);
  EXPECT_GT(view.far, 5);
  options.target = glm::vec3(0, 0, -1);
  options.position = glm::vec3(0, 0, -100);  // all behind
  EXPECT_TRUE(is_sound(choose_camera(scene, options, kWidth, kHeight).view));
}

TEST(CameraChoice, RefusesWhatMakesNoPicture) {
  const Scene scene = scene_of_points(box_corners({-1, -1, -1}, {1, 1, 1}));
  CameraOptions same;
  same.position = same.target = glm::vec3(1, 1, 1);
  EXPECT_NE(refusal(scene, same), "");
  EXPECT_EQ(refusal(scene, {.window = {0, 0, 0, 1}}), "window: 0,0,0,1, expected x0,y0,x1,y1 with x0 < x1 and y0 < y1");
  EXPECT_NE(refusal(scene, {.viewport = std::array<float, 4>{0, 0, 801, 600}}), "");
  EXPECT_NE(refusal(scene, {.viewport = std::array<float, 4>{0, 0, 10.5F, 10}}), "");
  EXPECT_NE(refusal(scene, {.viewport = std::array<float, 4>{0, 0, 0, 10}}), "");
  EXPECT_NE(refusal(scene, {.fov_deg = 180.0F}), "");
  EXPECT_NE(refusal(scene, {.zoom = 0}), "");
  EXPECT_NE(refusal(scene, {.distance = -1.0F}), "");
  EXPECT_EQ(refusal(scene, {.up = glm::vec3(0)}), "up: 0,0,0, expected a direction");
  EXPECT_NE(refusal(scene, {}, 0, 600), "");
  CameraOptions far;
  far.position = glm::vec3(1e31F, 0, 0);
  EXPECT_NE(refusal(scene, far), "");
  CameraOptions nowhere;
  nowhere.target = glm::vec3(std::numeric_limits<float>::quiet_NaN(), 0, 0);
  EXPECT_NE(refusal(scene, nowhere), "");
}

TEST(CameraChoice, ATurntableSeesAllOfItAllTheWayFromOneDistance) {
  const std::vector<glm::vec3> corners = box_corners({-1, -1, -4}, {2, 3, 4});
  for (const auto projection : {Projection::Perspective, Projection::Orthographic}) {
    const Scene scene = scene_of_points(corners);
    CameraOptions options;
    options.projection = projection;
    options.elevation_deg = 15;
    const std::vector<Orbit> orbits = turntable(scene, options, 12, kWidth, kHeight);
    ASSERT_EQ(orbits.size(), 12U);
    double most = 0;
    for (const Orbit& orbit : orbits) {
      EXPECT_EQ(orbit.distance, orbits[0].distance);
      EXPECT_EQ(orbit.elevation_deg, 15);
      CameraOptions frame = options;
      frame.azimuth_deg = orbit.azimuth_deg;
      frame.target = orbit.target;
      frame.distance = orbit.distance;
      const Bounds2 box = filled(choose_camera(scene, frame, kWidth, kHeight).view, corners);
      most = std::max({most, -box.lower.x, -box.lower.y, box.upper.x, box.upper.y});
    }
    EXPECT_NEAR(most, 0.9, 1.0 / kHeight);
    EXPECT_FLOAT_EQ(orbits[3].azimuth_deg - orbits[0].azimuth_deg, 90);
  }
}

TEST(CameraChoice, ManyThreadsChooseTheSame) {
  const Scene scene = scene_of_points(random_points(5, 100000, {1, 2, 3}, {0, 0, 0}));
  const View one = choose_camera(scene, {}, kWidth, kHeight, {.threads = 1}).view;
  for (const int threads : {2, 7}) {
    const View many = choose_camera(scene, {}, kWidth, kHeight, {.threads = threads}).view;
    EXPECT_EQ(one.view_from_world, many.view_from_world);
    EXPECT_EQ(one.clip_from_view, many.clip_from_view);
  }
}

}  // namespace
}  // namespace azulejo
