#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>

#include "azulejo/data/array.h"

namespace azulejo {

/// Outlines made of straight lines, in pixels of the picture: (0, 0) is its upper left corner.
///
/// Contour i is points[starts[i]] … points[starts[i + 1] − 1], the last one ends where the points do; filling closes
/// every contour. A point that is not finite is left out by what fills it: the outline goes on at the next one.
struct FlatPath {
  Array<glm::vec2> points;
  Array<std::uint32_t> starts;  ///< one a contour
  Array<std::uint8_t> closed;   ///< one a contour: 1 where a line goes from its last point to its first
  /// One a contour: 1 where it doesn't meet itself. Its windings are 0 and 1 (or −1), so a pixel that no other contour
  /// passes is covered by what its edges sum up to.
  Array<std::uint8_t> once;

  std::size_t contour_count() const { return starts.size(); }
  std::span<const glm::vec2> contour(std::size_t index) const {
    const std::size_t end = index + 1 < starts.size() ? starts[index + 1] : points.size();
    return {points.data() + starts[index], end - starts[index]};
  }
  /// Begins a contour: what is added to `points` from now on.
  void begin() {
    starts.push_back(static_cast<std::uint32_t>(points.size()));
    closed.push_back(0);
    once.push_back(0);
  }
  void clear() {
    points.clear();
    starts.clear();
    closed.clear();
    once.clear();
  }
};

}  // namespace azulejo
