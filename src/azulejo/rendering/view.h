#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "azulejo/math/rect.h"

namespace azulejo {

/// A camera made ready for a picture: where it stands and how it projects. Matrices act on column vectors.
struct View {
  glm::mat4 view_from_world{1.0F};  ///< rigid; the camera looks along −z, y up
  /// To homogeneous clip space: visible is −w ≤ x ≤ w, −w ≤ y ≤ w, 0 ≤ z ≤ w; depth is reversed, near at z = w, far at
  /// z = 0 (an infinite far plane is fine). A window other than the whole picture is part of it.
  glm::mat4 clip_from_view{1.0F};
  bool perspective = true;
  float near = 0;  ///< distance of the near plane, in units
  float far = 0;   ///< 0: infinite
  int width = 0;   ///< of the picture, pixels
  int height = 0;
  Rect viewport;  ///< the part of the picture that clip space's square fills; pixels

  glm::mat4 clip_from_world() const { return clip_from_view * view_from_world; }
};

}  // namespace azulejo
