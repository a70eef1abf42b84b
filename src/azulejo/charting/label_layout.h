#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "azulejo/data/drawing.h"

namespace azulejo {

/// A label that wants to be beside a point.
struct WantedLabel {
  glm::vec2 point{0, 0};
  glm::vec2 size{0, 0};  ///< of its box; not positive or not finite: none
  Box2 room = {};        ///< of what is around the point: the label stands on it if it fits in here; empty: never
};

struct PlacedLabel {
  Box2 box;             ///< empty: none
  bool leader = false;  ///< so far from its point that a line must lead there
};

/// Finds places for labels so that they hide neither each other nor the points: on their point where there is room, else
/// around it, then farther
/// away with a leader; inside the page as far as that goes. Earlier labels choose first; one for which there is no room
/// stands where it hides least beside its point.
///
/// reserved   what labels keep off, too
/// clearance  between a point and its label, also kept free around every point
/// Cost       O(labels · what is near each): 10⁴ labels in well under a second
std::vector<PlacedLabel> place_labels(std::span<const WantedLabel> labels, const Box2& page, float clearance,
                                      std::span<const Box2> reserved = {});

/// The end of a leader at a box: the point of its rim that is nearest to `point`.
glm::vec2 leader_end(const Box2& box, const glm::vec2& point);

}  // namespace azulejo
