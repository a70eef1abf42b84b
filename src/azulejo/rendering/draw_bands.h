#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "azulejo/rendering/draw_outlines.h"

namespace azulejo {

/// Which steps touch which rows of the picture, `rows` of them in a band.
struct DrawBands {
  int rows = 0;
  int count = 0;
  std::vector<Rect> regions;         ///< of each step: pixels that it can change; of a layer, all that it holds
  std::vector<std::size_t> starts;   ///< of each band in `lists`, and of what would be the next
  std::vector<std::uint32_t> lists;  ///< steps in order
  std::size_t depth = 0;             ///< layers at once, at most

  std::span<const std::uint32_t> steps_of(int band) const {
    const auto b = static_cast<std::size_t>(band);
    return {lists.data() + starts[b], starts[b + 1] - starts[b]};
  }
};

DrawBands draw_bands(const DrawSteps& steps, const DrawOutlines& outlines, const DrawFrame& frame, int rows);

}  // namespace azulejo
