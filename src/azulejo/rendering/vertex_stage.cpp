#include "azulejo/rendering/vertex_stage.h"

#include <cmath>
#include <limits>

namespace azulejo {

ScreenTransform screen_transform(const Rect& viewport) {
  const float half_width = 0.5F * static_cast<float>(viewport.width);
  const float half_height = 0.5F * static_cast<float>(viewport.height);
  return {half_width, static_cast<float>(viewport.x) + half_width, -half_height,
          static_cast<float>(viewport.y) + half_height};
}

glm::vec4 to_clip(const glm::mat4& m, const glm::vec3& p) {
  glm::vec4 clip;
  for (int row = 0; row < 4; ++row) clip[row] = ((m[0][row] * p.x + m[1][row] * p.y) + m[2][row] * p.z) + m[3][row];
  return clip;
}

ScreenVertex to_screen(const glm::vec4& clip, const ScreenTransform& transform) {
  const float inverse_w = 1.0F / clip.w;
  ScreenVertex vertex{(clip.x * inverse_w) * transform.scale_x + transform.offset_x,
                      (clip.y * inverse_w) * transform.scale_y + transform.offset_y, clip.z * inverse_w, inverse_w};
  const bool inside = clip.z >= 0 && clip.z <= clip.w && clip.w > 0 && std::fabs(vertex.x) <= kGuardBand &&
                      std::fabs(vertex.y) <= kGuardBand;
  if (!inside) vertex.x = std::numeric_limits<float>::quiet_NaN();
  return vertex;
}

}  // namespace azulejo
