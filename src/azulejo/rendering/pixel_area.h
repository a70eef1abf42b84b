#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "azulejo/core/export.h"
#include "azulejo/data/array.h"
#include "azulejo/data/drawing.h"

namespace azulejo {

/// A line of an outline within a pixel of 2^kEdgeBits units a side, from top to bottom.
struct PixelEdge {
  std::int32_t xa, ya, xb, yb;
  std::int32_t sign;  ///< 1: the outline goes down here, −1: up; what is right of it has that much more winding
  /// Level lines bound no area; they only say where an outline came in from the left.
  bool level() const { return ya == yb; }
};

/// Finds the part of a pixel that is inside of outlines, however many of them pass it.
///
/// Where no two of up to 10 edges meet but at their ends, and no winding number beside 0 and one other, or none 0, occurs,
/// the signed area is the result: most pixels of outlines that don't cross themselves.
///
/// Else the pixel is cut into strips at all ends of edges. In a strip, edges stand side by side, and the areas between them
/// count by their own winding numbers: exact in double precision, as long as none cross each other. A strip where they do
/// is cut again: at the crossings if it has up to 4 edges, else into strips of at most 1/32 pixel, which costs each
/// crossing 1/256 at most.
///
/// More than 10 edges are first looked at along 16 level lines: where no winding number beside 0 and one other, or none 0, is
/// met, the signed area is the result. Of more than 64 edges only the strips of 1/64 pixel are looked at otherwise, with the
/// edges where they pass the middle of each.
class AZULEJO_EXPORT PixelArea {
 public:
  /// signed_area  of all that is inside of the pixel by windings: their sum over its area, in units of 2⁻¹⁶. The
  ///              windings at its left side follow from it.
  /// Result       0–1. Cost O(edges · strips).
  float inside(std::span<const PixelEdge> edges, std::int32_t signed_area, FillRule rule);

 private:
  struct Crossing {
    double middle, top, bottom;
    std::int32_t sign;
  };
  /// An edge that isn't level, in pixels.
  struct Line {
    double top, bottom, x, slope;
    std::int32_t sign;
  };
  double area_of(std::span<const Line> lines, double top, double bottom, FillRule rule, bool may_cut);
  double cut(std::span<const Line> lines, double top, double bottom, FillRule rule);
  double exact_area(FillRule rule);
  int winding_at(double y) const;
  bool is_simple(std::span<const PixelEdge> edges, FillRule rule) const;
  bool looks_simple(std::span<const PixelEdge> edges, FillRule rule);

  struct Entry {
    double y;
    int change;
  };
  int first_winding_ = 0;
  Array<Entry> entries_;
  Array<double> levels_;
  Array<Crossing> crossings_;
  Array<Line> edges_;
  Array<Line> passing_;
  static constexpr int kLines = 16;
  struct LineCrossing {
    float x;
    std::int32_t sign;
  };
  std::array<Array<LineCrossing>, kLines> lines_;
};

}  // namespace azulejo
