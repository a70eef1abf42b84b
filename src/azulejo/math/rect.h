#pragma once

#include <algorithm>
#include <cstdint>

namespace azulejo {

/// A rectangle of pixels: columns [x, x + width), rows [y, y + height). Empty if a size is not positive.
struct Rect {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;

  constexpr int right() const { return x + width; }
  constexpr int bottom() const { return y + height; }
  constexpr bool empty() const { return width <= 0 || height <= 0; }
  constexpr std::int64_t area() const { return empty() ? 0 : std::int64_t{width} * height; }
  constexpr bool contains(const Rect& other) const {
    return other.empty() || (other.x >= x && other.y >= y && other.right() <= right() && other.bottom() <= bottom());
  }
  friend constexpr bool operator==(const Rect&, const Rect&) = default;
};

/// The rectangle that reaches from (left, top) to before (right, bottom).
constexpr Rect rect_between(int left, int top, int right, int bottom) {
  return {left, top, right - left, bottom - top};
}

constexpr Rect grown(const Rect& rect, int columns, int rows) {
  return {rect.x - columns, rect.y - rows, rect.width + 2 * columns, rect.height + 2 * rows};
}

/// What both have in common; an empty rectangle if that is nothing.
constexpr Rect intersection(const Rect& a, const Rect& b) {
  const Rect both = rect_between(std::max(a.x, b.x), std::max(a.y, b.y), std::min(a.right(), b.right()),
                                 std::min(a.bottom(), b.bottom()));
  return both.empty() ? Rect{} : both;
}

/// The smallest rectangle that holds both.
constexpr Rect united(const Rect& a, const Rect& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return rect_between(std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.right(), b.right()),
                      std::max(a.bottom(), b.bottom()));
}

}  // namespace azulejo
