#pragma once

#include <cstddef>
#include <glm/vec2.hpp>

#include "azulejo/data/array.h"
#include "azulejo/data/drawing.h"
#include "azulejo/modelling/flat_path.h"

namespace azulejo {

/// A piece of a line. Normals are as long as the line's half width and point to the left of its direction (to the right
/// as seen where y points down); those of a straight piece are equal.
struct StrokePiece {
  glm::vec2 from;
  glm::vec2 to;
  glm::vec2 from_normal;
  glm::vec2 to_normal;
  /// Square of how much of each side the inner side of a join may take away: so that joins at both ends leave something.
  float spare = 0;
};

/// How a piece hangs on the one before it.
enum class StrokeJoint {
  Styled,  ///< by the join of the style
  Round,   ///< inside of a curve, where it turns sharply
  Smooth,  ///< not at all: the normals are equal
};

/// How a run of pieces begins or ends.
enum class StrokeEnd {
  Cap,   ///< by the cap of the style
  Seam,  ///< straight across: what continues it has the same edge in the other direction
};

/// How an outline looks, in the units of the pieces.
struct StrokeShape {
  float radius = 0.5F;
  LineCap cap = LineCap::Butt;
  LineJoin join = LineJoin::Miter;
  float miter_limit = 4;
  float tolerance = 0.1F;
};

/// Memory for outlines, kept from path to path.
struct StrokeScratch {
  Array<glm::vec2> left;
  Array<glm::vec2> right;
};

/// Turns runs of pieces into outlines: quads along pieces, with wedges at joins and with caps. All of them turn the same
/// way, whatever the run does: filled by the non-zero rule they are its union.
///
/// Where a join takes away less than 2/5 of both pieces' inner sides, they don't overlap. Where it would be more they do,
/// inside of the join. Outlines are marked as `summed`, and cut where they become long.
class StrokePen {
 public:
  StrokePen(const StrokeShape& shape, StrokeScratch& scratch, FlatPath& result);

  bool empty() const { return empty_; }
  /// Begins a run with a piece.
  void begin(StrokeEnd start, const StrokePiece& piece);
  void add(const StrokePiece& piece, StrokeJoint joint);
  /// Ends the run.
  void finish(StrokeEnd end);

 private:
  void reserve();
  void left(const glm::vec2& point) { left_[left_size_++] = point; }
  void right(const glm::vec2& point) { right_[right_size_++] = point; }
  void put(bool on_left, const glm::vec2& point) { on_left ? left(point) : right(point); }
  void across(const glm::vec2& point, const glm::vec2& normal);
  void cut();
  void end_outline();
  void join(const StrokePiece& before, const StrokePiece& after, StrokeJoint joint);
  void join_outside(bool on_left, const glm::vec2& corner, const glm::vec2& before, const glm::vec2& after,
                    LineJoin how);
  void arc(bool on_left, const glm::vec2& center, glm::vec2 from, const glm::vec2& to);
  void put_piece(const StrokePiece& piece);
  void cross_sides(const StrokePiece& piece, bool on_left);
  void cap(StrokeEnd end, const glm::vec2& point, const glm::vec2& normal);

  StrokeShape shape_;
  Array<glm::vec2>& left_;
  Array<glm::vec2>& right_;
  FlatPath& result_;
  std::size_t left_size_ = 0;
  std::size_t right_size_ = 0;
  StrokePiece first_;
  StrokePiece last_;
  StrokeEnd start_ = StrokeEnd::Cap;  ///< of the outline
  bool empty_ = true;
  float square_ = 0;              ///< of the radius
  float miter_limit_square_ = 0;  ///< of what is a miter
  float round_limit_square_ = 0;  ///< of a miter that is within the tolerance of an arc
  float bevel_limit_square_ = 0;  ///< … of a bevel
  glm::vec2 step_{1, 0};          ///< cosine and sine of the angle between points of an arc
  std::size_t arc_points_ = 0;    ///< at most
};

}  // namespace azulejo
