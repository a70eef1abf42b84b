#include "azulejo/rendering/lens.h"

#include <cmath>

namespace azulejo {
namespace {

/// Clip from view, all of the picture.
glm::dmat4 projection(const Lens& lens) {
  glm::dmat4 clip(0.0);
  const double n = lens.near;
  const double f = lens.far;
  if (lens.perspective) {
    const double slope = std::tan(lens.fov_y / 2) / lens.zoom;
    clip[0][0] = 1 / (slope * lens.aspect);
    clip[1][1] = 1 / slope;
    // Depth is reversed: w at the near plane, 0 at the far one.
    clip[2][2] = lens.infinite ? 0 : n / (f - n);
    clip[3][2] = lens.infinite ? n : n * (f / (f - n));
    clip[2][3] = -1;
    return clip;
  }
  const double half = lens.height / 2 / lens.zoom;
  clip[0][0] = 1 / (half * lens.aspect);
  clip[1][1] = 1 / half;
  clip[2][2] = 1 / (f - n);
  clip[3][2] = f / (f - n);
  clip[3][3] = 1;
  return clip;
}

/// Makes the window fill the picture.
glm::dmat4 whole_from_window(const Window& window) {
  const glm::dmat3 plane = viewport_from_window(window, Window{});
  glm::dmat4 matrix(1.0);
  for (int axis = 0; axis < 2; ++axis) {
    matrix[axis][axis] = plane[axis][axis];
    matrix[3][axis] = plane[2][axis];
  }
  return matrix;
}

}  // namespace

void choose_depth_range(Lens& lens, const ScenePoints& points, const CameraBasis& basis, const Run& run) {
  const bool both = lens.near > 0 && (lens.far > lens.near || lens.infinite);
  if (both) return;
  const ScenePoints::Extent extent = points.extent(basis, {1, 1}, run);
  const double nearest = -extent.upper.z;
  const double farthest = -extent.lower.z;
  lens.infinite = lens.infinite && lens.near > 0;
  const bool far_given = lens.far > 0 && !(lens.near >= lens.far);
  if (!far_given) {
    // A little beyond the farthest point; where all is behind the camera, anything.
    lens.far = farthest > 0 ? farthest * 1.01 + 1e-3 * points.radius() : 10 * points.radius();
    lens.far = std::max(lens.far, 1.01 * lens.near);
  }
  if (!(lens.near > 0)) {
    lens.near = nearest * 0.9;
    if (lens.perspective) lens.near = std::max(lens.near, 1e-4 * lens.far);
    if (lens.near >= lens.far) lens.near = 0.5 * lens.far;
    lens.near = std::max(lens.near, 0.0);
  }
}

View view_through(const Lens& lens, const CameraBasis& basis, const glm::ivec2& size, const Rect& viewport) {
  View view;
  view.view_from_world = basis.view_from_world();
  view.clip_from_view = glm::mat4(whole_from_window(lens.window) * projection(lens));
  view.perspective = lens.perspective;
  view.near = static_cast<float>(lens.near);
  view.far = lens.infinite ? 0.0F : static_cast<float>(lens.far);
  view.width = size.x;
  view.height = size.y;
  view.viewport = viewport;
  return view;
}

}  // namespace azulejo
