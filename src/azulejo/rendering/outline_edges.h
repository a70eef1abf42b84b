#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>

#include "azulejo/core/export.h"
#include "azulejo/data/array.h"
#include "azulejo/math/rect.h"

namespace azulejo {

/// Bits behind the point of an edge's coordinates: 1/16384 of a pixel.
inline constexpr int kEdgeBits = 14;
inline constexpr std::int32_t kEdgeOne = 1 << kEdgeBits;

/// A line of an outline within the picture, in the direction in which it is drawn.
struct OutlineEdge {
  std::int32_t x0, y0, x1, y1;
  /// The same for neighbors that go the same way up or down. 1 to 2³¹ − 1.
  std::uint32_t chain;
};

/// Gathers the edges of outlines: clips them to a picture and rounds them to the grid of edges.
///
/// What is above or below the picture or right of it is dropped; what is left of it moves to its left side, where its
/// windings count. Points that are not finite are left out. All others may be of any size.
class AZULEJO_EXPORT EdgeGatherer {
 public:
  /// width, height  of the picture, at most 65536
  EdgeGatherer(int width, int height, Array<OutlineEdge>& edges, std::uint32_t first_chain = 1)
      : width_(width), height_(height), edges_(edges), chain_(first_chain) {}

  /// A whole outline, closed.
  void add_contour(std::span<const glm::vec2> points);
  /// A part of one: lines from each point to the next. Those that go on in another call get another chain there.
  void add_lines(std::span<const glm::vec2> points);
  /// Whether something was dropped that is right of the picture.
  bool reaches_right() const { return reaches_right_; }

 private:
  void add_line(const glm::vec2& from, const glm::vec2& to);
  void add_clipped(double x0, double y0, double x1, double y1);
  void add_edge(double x0, double y0, double x1, double y1);
  void turn(bool down);

  double width_;
  double height_;
  Array<OutlineEdge>& edges_;
  std::uint32_t chain_;
  int direction_ = 0;  ///< of the chain: 1 down, −1 up, 0 not known
  bool reaches_right_ = false;
};

/// Whether edges that make one closed outline turn the same way all along, and once around: no pixel has more than one
/// winding number beside 0 then. Cost O(edges).
AZULEJO_EXPORT bool is_convex(std::span<const OutlineEdge> edges);

/// The pixels that edges touch; those that end at the right or lower side of the picture may touch one beyond.
AZULEJO_EXPORT Rect pixels_of(std::span<const OutlineEdge> edges);

}  // namespace azulejo
