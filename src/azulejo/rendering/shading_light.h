#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "azulejo/data/scene.h"

namespace azulejo {

/// A light as renderers use it, in world space.
struct ShadingLight {
  LightKind kind = LightKind::Directional;
  glm::vec3 position{0, 0, 0};
  glm::vec3 direction{0, 0, -1};  ///< unit, the way that the light travels along its axis
  glm::vec3 color{1, 1,
                  1};   ///< linear: what a white surface that faces it sends back, at distance 1 for point and spot
  float range = 0;      ///< units; 0: unbounded
  float cos_inner = 1;  ///< of spots
  float cos_outer = 0;
};

/// All that lights a scene. Light from everywhere is `sky` from above and `ground` from below, blended between:
/// what reaches a surface of normal N is mix(ground, sky, (N·up + 1)/2).
struct Lighting {
  std::vector<ShadingLight> lights;
  glm::vec3 sky{0, 0, 0};
  glm::vec3 ground{0, 0, 0};
  glm::vec3 up{0, 1, 0};
};

}  // namespace azulejo
