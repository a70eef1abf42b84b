#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "azulejo/math/rect.h"

namespace azulejo {

/// Steps `first` to `last` of Bresenham's line from one pixel to another, both of which |coordinates| ≤ 2²⁸. Step i is the
/// i-th pixel along the longer axis; across it the pixel whose center is nearest to the line, of two the farther from
/// the beginning.
struct CrispLine {
  std::int32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  std::int32_t first = 0, last = 0;
};

namespace crisp {

/// The line turned so that it goes right and down, and the longer way is `along`.
struct Slope {
  std::int64_t along = 0;   ///< pixels to the end, along the longer axis
  std::int64_t across = 0;  ///< along the other, at most as many
  bool steep = false;

  explicit Slope(const CrispLine& line) {
    const std::int64_t dx = std::abs(std::int64_t{line.x1} - line.x0);
    const std::int64_t dy = std::abs(std::int64_t{line.y1} - line.y0);
    steep = dy > dx;
    along = steep ? dy : dx;
    across = steep ? dx : dy;
  }
  /// How far across a step is: ⌊i · across / along + ½⌋.
  std::int64_t across_at(std::int64_t step) const { return along == 0 ? 0 : (2 * step * across + along) / (2 * along); }
  /// The first step that is so far across, which isn't beyond the end.
  std::int64_t step_at(std::int64_t far) const {
    return far <= 0 ? 0 : ((2 * far - 1) * along + 2 * across - 1) / (2 * across);
  }
};

/// Steps whose coordinate, `from` + `sign` · k, is in [begin, end): k in [low, high].
struct Reach {
  std::int64_t low, high;
  Reach(std::int64_t from, std::int64_t to, std::int64_t begin, std::int64_t end) {
    const bool forward = to >= from;
    low = forward ? begin - from : from - (end - 1);
    high = forward ? end - 1 - from : from - begin;
  }
};

}  // namespace crisp

/// Leaves the steps in a window. Exact: they are the same pixels.
/// Result  false: none are left
inline bool clip(CrispLine& line, const Rect& window) {
  const crisp::Slope slope(line);
  const crisp::Reach x(line.x0, line.x1, window.x, window.right());
  const crisp::Reach y(line.y0, line.y1, window.y, window.bottom());
  const crisp::Reach& along = slope.steep ? y : x;
  const crisp::Reach& across = slope.steep ? x : y;
  std::int64_t first = std::max<std::int64_t>(line.first, along.low);
  std::int64_t last = std::min<std::int64_t>(line.last, along.high);
  if (across.high < 0 || across.low > slope.across) return false;
  first = std::max(first, slope.step_at(across.low));
  if (across.high < slope.across) last = std::min(last, slope.step_at(across.high + 1) - 1);
  if (first > last) return false;
  line.first = static_cast<std::int32_t>(first);
  line.last = static_cast<std::int32_t>(last);
  return true;
}

/// visit(row, begin, end) for the pixels in the rows [first_row, last_row]: [begin, end) of a row.
template <class Visit>
void for_runs(const CrispLine& line, int first_row, int last_row, Visit&& visit) {
  CrispLine part = line;
  const int left = std::min(line.x0, line.x1);
  const int right = std::max(line.x0, line.x1);
  if (!clip(part, {left, first_row, right - left + 1, last_row - first_row + 1})) return;
  const crisp::Slope slope(part);
  const int step_x = part.x1 < part.x0 ? -1 : 1;
  const int step_y = part.y1 < part.y0 ? -1 : 1;
  auto far = static_cast<int>(slope.across_at(part.first));
  if (slope.steep) {
    // Twice the distance from where the next pixel across would be nearer.
    std::int64_t rest = (2 * part.first * slope.across + slope.along) - 2 * far * slope.along;
    int y = part.y0 + step_y * part.first;
    for (std::int32_t i = part.first; i <= part.last; ++i, y += step_y) {
      const int x = part.x0 + step_x * far;
      visit(y, x, x + 1);
      rest += 2 * slope.across;
      if (rest < 2 * slope.along) continue;
      rest -= 2 * slope.along;
      ++far;
    }
    return;
  }
  for (std::int64_t begin = part.first; begin <= part.last; ++far) {
    const std::int64_t next = far < slope.across ? slope.step_at(far + 1) : std::int64_t{part.last} + 1;
    const std::int64_t end = std::min<std::int64_t>(next, std::int64_t{part.last} + 1);
    const auto from = static_cast<int>(part.x0 + step_x * begin);
    const auto to = static_cast<int>(part.x0 + step_x * (end - 1));
    visit(part.y0 + step_y * far, std::min(from, to), std::max(from, to) + 1);
    begin = end;
  }
}

}  // namespace azulejo
