#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "azulejo/rendering/outline_edges.h"

namespace azulejo {

/// Where an edge passes a pixel: from (xa, ya) down to (xb, yb), in units of the grid, x from the pixel's left side.
struct EdgePiece {
  int row;
  std::int32_t column;
  std::int32_t xa, ya, xb, yb;
};

/// Goes down an edge row by row, from pixel to pixel. What it gives depends on the edge only, not on which rows are
/// asked for, and is the same for the same line drawn upward.
class EdgeWalk {
 public:
  explicit EdgeWalk(const OutlineEdge& edge) {
    const bool down = edge.y1 >= edge.y0;
    sign_ = down ? 1 : -1;
    top_x_ = down ? edge.x0 : edge.x1;
    top_y_ = down ? edge.y0 : edge.y1;
    bottom_x_ = down ? edge.x1 : edge.x0;
    bottom_y_ = down ? edge.y1 : edge.y0;
  }

  /// 1: it was drawn downward, −1: upward.
  std::int32_t sign() const { return sign_; }
  std::int32_t top() const { return top_y_; }
  std::int32_t bottom() const { return bottom_y_; }
  bool level() const { return top_y_ == bottom_y_; }

  /// visit(piece) for all pixels in the rows [first, last]. Not for level edges.
  template <class Visit>
  void pieces(int first, int last, Visit&& visit) const {
    const int row = std::max(top_y_ >> kEdgeBits, first);
    const int end = std::min((bottom_y_ - 1) >> kEdgeBits, last);
    if (row > end) return;
    if (top_y_ >> kEdgeBits == (bottom_y_ - 1) >> kEdgeBits) {
      // Most edges of fine curves are within one pixel.
      const std::int32_t column = top_x_ >> kEdgeBits;
      if (bottom_x_ >> kEdgeBits == column) {
        const std::int32_t left = column << kEdgeBits;
        return visit(EdgePiece{row, column, top_x_ - left, top_y_, bottom_x_ - left, bottom_y_});
      }
      return row_pieces(row, top_x_, top_y_, bottom_x_, bottom_y_, visit);
    }
    std::int32_t y = std::max(top_y_, row << kEdgeBits);
    const double slope = static_cast<double>(bottom_x_ - top_x_) / static_cast<double>(bottom_y_ - top_y_);
    const auto x_at = [&](std::int32_t level) {
      return level == top_y_      ? top_x_
             : level == bottom_y_ ? bottom_x_
                                  : top_x_ + rounded(static_cast<double>(level - top_y_) * slope);
    };
    std::int32_t x = x_at(y);
    for (int each = row; each <= end; ++each) {
      const std::int32_t next_y = std::min((each + 1) << kEdgeBits, bottom_y_);
      const std::int32_t next_x = x_at(next_y);
      row_pieces(each, x, y, next_x, next_y, visit);
      x = next_x;
      y = next_y;
    }
  }

  /// The same for level edges, from where they begin.
  template <class Visit>
  void level_pieces(int first, int last, Visit&& visit) const {
    const int row = top_y_ >> kEdgeBits;
    if (row < first || row > last) return;
    const bool rightward = bottom_x_ > top_x_;
    std::int32_t x = top_x_;
    const std::int32_t end = bottom_x_ >> kEdgeBits;
    for (std::int32_t column = x >> kEdgeBits;; column += rightward ? 1 : -1) {
      const std::int32_t left = column << kEdgeBits;
      const std::int32_t next = column == end ? bottom_x_ : left + (rightward ? kEdgeOne : 0);
      visit(EdgePiece{row, column, x - left, top_y_, next - left, top_y_});
      if (column == end) return;
      x = next;
    }
  }

  /// visit(row, x) where it passes the middle of a row in [first, last].
  template <class Visit>
  void middles(int first, int last, Visit&& visit) const {
    constexpr std::int32_t kHalf = kEdgeOne / 2;
    const int row = std::max((top_y_ + kHalf - 1) >> kEdgeBits, first);
    const int end = std::min((bottom_y_ - kHalf - 1) >> kEdgeBits, last);
    if (row > end) return;
    const double slope = static_cast<double>(bottom_x_ - top_x_) / static_cast<double>(bottom_y_ - top_y_);
    for (int each = row; each <= end; ++each) {
      const std::int32_t down = (each << kEdgeBits) + kHalf - top_y_;
      visit(each, top_x_ + rounded(static_cast<double>(down) * slope));
    }
  }

 private:
  static std::int32_t rounded(double value) { return static_cast<std::int32_t>(std::floor(value + 0.5)); }

  template <class Visit>
  void row_pieces(int row, std::int32_t xa, std::int32_t ya, std::int32_t xb, std::int32_t yb, Visit& visit) const {
    const std::int32_t last = xb >> kEdgeBits;
    std::int32_t column = xa >> kEdgeBits;
    if (column == last) {
      const std::int32_t left = column << kEdgeBits;
      return visit(EdgePiece{row, column, xa - left, ya, xb - left, yb});
    }
    const double slope = static_cast<double>(bottom_y_ - top_y_) / static_cast<double>(bottom_x_ - top_x_);
    const auto y_at = [&](std::int32_t x, std::int32_t least) {
      return std::clamp(top_y_ + rounded(static_cast<double>(x - top_x_) * slope), least, yb);
    };
    const bool rightward = xb > xa;
    while (column != last) {
      const std::int32_t left = column << kEdgeBits;
      const std::int32_t side = rightward ? kEdgeOne : 0;
      const std::int32_t next_y = y_at(left + side, ya);
      visit(EdgePiece{row, column, xa - left, ya, side, next_y});
      xa = left + side;
      ya = next_y;
      column += rightward ? 1 : -1;
    }
    const std::int32_t left = column << kEdgeBits;
    visit(EdgePiece{row, column, xa - left, ya, xb - left, yb});
  }

  std::int32_t sign_;
  std::int32_t top_x_, top_y_, bottom_x_, bottom_y_;
};

}  // namespace azulejo
