#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>

#include "azulejo/data/array.h"

namespace azulejo {

/// Outlines made of straight lines. What is drawn is in pixels of the picture: (0, 0) is its upper left corner.
///
/// Contour i is points[starts[i]] … points[starts[i + 1] − 1], the last one ends where the points do; filling closes
/// every contour. A point that is not finite is left out by what fills it: the outline goes on at the next one.
struct FlatPath {
  Array<glm::vec2> points;
  Array<std::uint32_t> starts;  ///< one a contour
  Array<std::uint8_t> closed;   ///< one a contour: 1 where a line goes from its last point to its first
  /// One a contour: 1 where it turns the same way all over, as all such contours of a path do: windings only grow where
  /// they overlap. What they cover of a pixel may be taken as the sum of what each does, up to 1.
  Array<std::uint8_t> summed;

  std::size_t contour_count() const { return starts.size(); }
  std::span<const glm::vec2> contour(std::size_t index) const {
    const std::size_t end = index + 1 < starts.size() ? starts[index + 1] : points.size();
    return {points.data() + starts[index], end - starts[index]};
  }
  /// Begins a contour: what is added to `points` from now on.
  void begin() {
    starts.push_back(static_cast<std::uint32_t>(points.size()));
    closed.push_back(0);
    summed.push_back(0);
  }
  void clear() {
    points.clear();
    starts.clear();
    closed.clear();
    summed.clear();
  }
};

}  // namespace azulejo
