#include "azulejo/rendering/camera_json.h"

#include <random>

#include <gtest/gtest.h>
#include <glm/vec4.hpp>

#include "azulejo/rendering/camera_choice.h"
#include "azulejo/rendering/rendering_testing.h"

namespace azulejo {
namespace {

glm::dmat4 matrix(const Json& rows) {
  glm::dmat4 m(0.0);
  EXPECT_EQ(rows.size(), 4U);
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 4; ++c) m[c][r] = rows[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)].number();
  }
  return m;
}

TEST(CameraJson, ProjectsAsTheMatricesDo) {
  const Scene scene = scene_of_points(box_corners({-1, -2, -3}, {3, 2, 1}));
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> number(-1, 1);
    CameraOptions options;
    options.azimuth_deg = 180 * number(random);
    options.elevation_deg = 80 * number(random);
    options.projection = seed % 2 == 0 ? Projection::Perspective : Projection::Orthographic;
    if (seed % 3 == 0) options.window = {-0.7F, -0.2F, 0.4F, 0.9F};
    if (seed % 5 == 0) options.viewport = std::array<float, 4>{20, 30, 400, 300};
    const View view = choose_camera(scene, options, 640, 480).view;
    // As someone else reads it: from the text.
    const Json json = Json::parse(camera_json(view, scene.space).dump(), "camera");
    const glm::dmat4 opencv = matrix(json["opencv"]["camera_from_world"]);
    const glm::dmat4 opengl = matrix(json["opengl"]["camera_from_world"]);
    for (int i = 0; i < 50; ++i) {
      const glm::vec3 point = 2.0F * glm::vec3(number(random), number(random), number(random));
      const glm::dvec4 p = opencv * glm::dvec4(point, 1.0);
      const double depth = view.perspective ? p.z : 1;
      const double u = json["fx"].number() * p.x / depth + json["cx"].number();
      const double v = json["fy"].number() * p.y / depth + json["cy"].number();
      const glm::dvec3 pixel = pixel_of(view, point);
      EXPECT_NEAR(u, pixel.x, 1e-3);
      EXPECT_NEAR(v, pixel.y, 1e-3);
      const glm::dvec4 q = opengl * glm::dvec4(point, 1.0);
      EXPECT_DOUBLE_EQ(q.y, -p.y);
      EXPECT_DOUBLE_EQ(q.z, -p.z);
      const glm::dvec4 back = matrix(json["opencv"]["world_from_camera"]) * p;
      EXPECT_NEAR(back.x, point.x, 1e-4);
      EXPECT_NEAR(back.y, point.y, 1e-4);
      EXPECT_NEAR(back.z, point.z, 1e-4);
    }
    EXPECT_EQ(json["projection"].text(), view.perspective ? "perspective" : "orthographic");
    EXPECT_EQ(json["width"].number(), 640);
  }
}

TEST(CameraJson, SaysWhatIsUnknownOrInfinite) {
  View view;
  view.near = 1;
  const Json json = camera_json(view, {});
  EXPECT_TRUE(json["far"].is_null());
  EXPECT_TRUE(json["metres_per_unit"].is_null());
  EXPECT_EQ(camera_json(view, {UpAxis::Z, 0.001F})["metres_per_unit"].number(), 0.001);
  EXPECT_EQ(camera_json(view, {UpAxis::Z, 0.001F})["up"].text(), "z");
}

}  // namespace
}  // namespace azulejo
