#pragma once

#include <glm/mat3x2.hpp>
#include <glm/vec2.hpp>
#include <numbers>

#include "azulejo/math/sine.h"

namespace azulejo {

/// Of a group that is turned counter-clockwise as seen, about its origin, which is at `place`. Quarters are exact.
/// angle  radians, |angle| up to 10⁶
inline glm::mat3x2 turned(float angle, const glm::vec2& place) {
  const SineCosine turn = sine_cosine_of_turns(angle / (2 * std::numbers::pi_v<float>));
  return {turn.cosine, -turn.sine, turn.sine, turn.cosine, place.x, place.y};
}

}  // namespace azulejo
