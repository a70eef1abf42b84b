#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "azulejo/modelling/plane_graph.h"
#include "azulejo/modelling/plane_sweep.h"

namespace azulejo::plane {

/// Which windings are inside.
enum class Inside : std::uint8_t {
  NonZero,       ///< of a
  EvenOdd,       ///< of a
  Union,         ///< of a or b, each by non-zero
  Intersection,  ///< of both
  Difference,    ///< of a and not of b
  Xor,           ///< of one of them
};
inline bool is_inside(Inside rule, const Winding& winding) {
  switch (rule) {
    case Inside::NonZero: return winding.a != 0;
    case Inside::EvenOdd: return (winding.a & 1) != 0;
    case Inside::Union: return winding.a != 0 || winding.b != 0;
    case Inside::Intersection: return winding.a != 0 && winding.b != 0;
    case Inside::Difference: return winding.a != 0 && winding.b == 0;
    case Inside::Xor: return (winding.a != 0) != (winding.b != 0);
  }
  return false;
}

/// A polygon that every upright line meets once: its points from left to right.
struct MonotonePiece {
  std::vector<std::uint32_t> lower;  ///< both chains have the first and the last point
  std::vector<std::uint32_t> upper;
};

/// Divides what is inside into pieces that are monotone in x, and these into triangles, in one sweep: a piece keeps the
/// chain of its points that still waits for triangles. Where edges begin inside a piece it is cut in two, towards the
/// last point before; where edges end between two pieces both wait for the next point, and are cut apart there.
///
/// Triangles turn counter-clockwise (y up) and have an area: never three points on a line.
/// Source  Garey, Johnson, Preparata, Tarjan, Triangulating a simple polygon, 1978; de Berg et al., Computational
///         geometry, 3rd ed., 3.2 and 3.3. Here both steps are one
class Triangulator {
 public:
  Triangulator(const Graph& graph, Inside rule, Array<std::uint32_t>& triangles)
      : graph_(graph), rule_(rule), triangles_(triangles) {}

  /// Called with each piece when it is complete.
  std::function<void(const MonotonePiece&)> on_piece;

  bool filled(const Winding& winding) const { return is_inside(rule_, winding); }
  /// Edges with the inside on both sides, or on none, aren't wanted here.
  bool edge(const Edge&, const Winding& below, const Winding& above) const { return filled(below) != filled(above); }
  std::uint32_t add_above(std::uint32_t gap, std::uint32_t point);
  std::uint32_t add_below(std::uint32_t gap, std::uint32_t point);
  void close(std::uint32_t gap, std::uint32_t point);
  std::pair<std::uint32_t, std::uint32_t> split(std::uint32_t gap, std::uint32_t point);
  std::uint32_t open(std::uint32_t point);
  std::uint32_t join(std::uint32_t below, std::uint32_t above, std::uint32_t point);

 private:
  enum class Chain : std::uint8_t { Lower, Upper };
  struct Piece {
    std::uint32_t top = kNone;    ///< of the stack of points that wait
    Chain chain = Chain::Lower;   ///< where they lie, but for the lowest of the stack
    std::uint32_t above = kNone;  ///< another piece in the same gap: cut apart at the next point
  };
  struct Waiting {
    std::uint32_t point = kNone;
    std::uint32_t under = kNone;
  };

  std::uint32_t begin(std::uint32_t point);
  void add(std::uint32_t piece, std::uint32_t point, Chain chain);
  void finish(std::uint32_t piece, std::uint32_t point);
  void fan(Piece& piece, std::uint32_t point);
  void push(Piece& piece, std::uint32_t point);
  void pop(Piece& piece);
  void triangle(Chain chain, std::uint32_t left, std::uint32_t right, std::uint32_t point);

  const Graph& graph_;
  Inside rule_;
  Array<std::uint32_t>& triangles_;
  Array<Piece> pieces_;
  std::vector<std::uint32_t> free_pieces_;
  Array<Waiting> waiting_;
  std::uint32_t free_waiting_ = kNone;
  std::vector<MonotonePiece> outlines_;  ///< of the pieces, if anybody looks
};

}  // namespace azulejo::plane
