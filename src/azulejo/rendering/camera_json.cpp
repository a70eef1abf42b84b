#include "azulejo/rendering/camera_json.h"

#include <glm/gtc/matrix_inverse.hpp>
#include <glm/matrix.hpp>

namespace azulejo {
namespace {

Json rows(const glm::dmat4& matrix) {
  Json list = Json::array();
  for (int row = 0; row < 4; ++row) {
    Json line = Json::array();
    for (int column = 0; column < 4; ++column) line.push(matrix[column][row]);
    list.push(line);
  }
  return list;
}

/// Rigid: the turn's inverse is its transpose.
glm::dmat4 inverse_of_rigid(const glm::dmat4& matrix) {
  const glm::dmat3 turn = glm::transpose(glm::dmat3(matrix));
  glm::dmat4 inverse(turn);
  inverse[3] = glm::dvec4(-(turn * glm::dvec3(matrix[3])), 1.0);
  return inverse;
}

Json extrinsics(const char* axes, const glm::dmat4& camera_from_world) {
  return Json::object()
      .set("axes", axes)
      .set("camera_from_world", rows(camera_from_world))
      .set("world_from_camera", rows(inverse_of_rigid(camera_from_world)));
}

}  // namespace

Json camera_json(const View& view, const Space& space) {
  const glm::dmat4 clip(view.clip_from_view);
  const glm::dmat4 opengl(view.view_from_world);
  glm::dmat4 flip(1.0);
  flip[1][1] = flip[2][2] = -1;
  // Of a perspective matrix the third column moves the centre, of an orthographic one the fourth.
  const double shift_x = view.perspective ? -clip[2][0] : clip[3][0];
  const double shift_y = view.perspective ? -clip[2][1] : clip[3][1];
  const double half_width = view.viewport.width / 2.0;
  const double half_height = view.viewport.height / 2.0;

  Json viewport = Json::array();
  for (const int number : {view.viewport.x, view.viewport.y, view.viewport.width, view.viewport.height})
    viewport.push(number);
  Json json = Json::object();
  json.set("projection", view.perspective ? "perspective" : "orthographic");
  json.set("width", view.width).set("height", view.height).set("viewport", viewport);
  json.set("fx", half_width * clip[0][0]).set("fy", half_height * clip[1][1]);
  json.set("cx", view.viewport.x + half_width * (1 + shift_x));
  json.set("cy", view.viewport.y + half_height * (1 - shift_y));
  json.set("pixel_centers", "the first pixel is at the top left, its centre at (0.5, 0.5)");
  json.set("near", view.near).set("far", view.far > 0 ? Json(view.far) : Json());
  json.set("depth", "distance along the view axis, in units");
  json.set("metres_per_unit", space.metres_per_unit > 0 ? Json(space.metres_per_unit) : Json());
  json.set("up", to_string(space.up));
  json.set("opengl", extrinsics("x right, y up, -z forward", opengl));
  json.set("opencv", extrinsics("x right, y down, z forward", flip * opengl));
  return json;
}

}  // namespace azulejo
