#include "azulejo/rendering/stroke_pen.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>

namespace azulejo {
namespace {

float cross(const glm::vec2& a, const glm::vec2& b) { return a.x * b.y - a.y * b.x; }

/// Along a piece, as long as its normal.
glm::vec2 direction_of(const glm::vec2& normal) { return {normal.y, -normal.x}; }

}  // namespace

StrokePen::StrokePen(const StrokeShape& shape, StrokeScratch& scratch, FlatPath& result)
    : shape_(shape), left_(scratch.left), right_(scratch.right), result_(result) {
  const float radius = shape.radius;
  square_ = radius * radius;
  const float limit = shape.miter_limit * radius;
  miter_limit_square_ = limit * limit;
  // Half of the tolerance is the curve's.
  const float within = 0.5F * shape.tolerance;
  round_limit_square_ = (radius + within) * (radius + within);
  bevel_limit_square_ = (radius + within / 8) * (radius + within / 8);
  // An arc of angle a leaves its chord by radius · (1 − cos(a / 2)); eight chords are a half circle at least.
  constexpr float kCoarsest = 0.0192147F;
  constexpr float kFinest = 1e-7F;
  const float rise = std::clamp(within / radius, kFinest, kCoarsest);
  const float cosine_of_half = 1 - rise;
  const float sine_of_half = std::sqrt(rise * (2 - rise));
  step_ = {cosine_of_half * cosine_of_half - sine_of_half * sine_of_half, 2 * sine_of_half * cosine_of_half};
  arc_points_ = static_cast<std::size_t>(3.2F / (2 * sine_of_half)) + 2;
}

/// For what a piece, and the end behind it, can put on one side.
void StrokePen::reserve() {
  const std::size_t wanted = std::max(left_size_, right_size_) + 2 * arc_points_ + 16;
  if (left_.size() >= wanted && right_.size() >= wanted) return;
  left_.resize(2 * wanted);
  right_.resize(2 * wanted);
}

void StrokePen::add(const StrokePiece& piece, StrokeJoint joint) {
  reserve();
  if (empty_) {
    first_ = piece;
    empty_ = false;
  } else if (joint == StrokeJoint::Smooth) {
    left(piece.from + piece.from_normal);
    right(piece.from - piece.from_normal);
  } else {
    join(last_, piece, joint);
  }
  if (piece.from_normal != piece.to_normal) sides(piece);
  last_ = piece;
}

/// Where a curve's radius is below half the width its inner side runs backwards, and the quad crosses itself at a point
/// on both normals: the two triangles are gone around by way of the middle line, so that both turn like everything else.
void StrokePen::sides(const StrokePiece& piece) {
  const glm::vec2 along = piece.to - piece.from;
  const glm::vec2 change = piece.to_normal - piece.from_normal;
  const float length_square = glm::dot(along, along);
  const float growth = glm::dot(change, along);
  if (std::abs(growth) <= length_square) return;
  const bool on_left = growth < 0;
  const float sign = on_left ? 1.0F : -1.0F;
  const glm::vec2 from = piece.from + sign * piece.from_normal;
  const glm::vec2 to = piece.to + sign * piece.to_normal;
  const float share = cross(along, piece.to_normal) / cross(piece.from_normal, piece.to_normal);
  const glm::vec2 crossing = piece.from + std::clamp(share, -1.0F, 1.0F) * piece.from_normal;
  for (const glm::vec2& each : {from, piece.from, crossing, to, from, crossing, piece.to}) put(on_left, each);
}

void StrokePen::join(const StrokePiece& before, const StrokePiece& after, StrokeJoint joint) {
  const glm::vec2 corner = after.from;
  const glm::vec2& n = before.to_normal;
  const glm::vec2& m = after.from_normal;
  const bool left_is_inner = cross(n, m) > 0;
  const float outer = left_is_inner ? -1.0F : 1.0F;
  // The miter's tip is at the corner plus this, or minus this inside: its product with both normals is the radius².
  const float reach = square_ + glm::dot(n, m);
  const bool turns_back = !(reach > 1e-6F * square_);
  const float scale = turns_back ? 0 : square_ / reach;
  const glm::vec2 miter = (n + m) * scale;
  const float miter_square = turns_back ? std::numeric_limits<float>::infinity() : 2 * square_ * scale;
  if (miter_square - square_ <= std::min(before.spare, after.spare)) {
    put(left_is_inner, corner - outer * miter);
  } else {
    for (const glm::vec2& each : {corner - outer * n, corner, corner - outer * m}) put(left_is_inner, each);
  }
  join_outside(!left_is_inner, corner, outer * n, outer * m, outer * miter, miter_square,
               joint == StrokeJoint::Round ? LineJoin::Round : shape_.join);
}

void StrokePen::join_outside(bool on_left, const glm::vec2& corner, const glm::vec2& before, const glm::vec2& after,
                             const glm::vec2& miter, float miter_square, LineJoin how) {
  const float limit = how == LineJoin::Round   ? round_limit_square_
                      : how == LineJoin::Bevel ? bevel_limit_square_
                                               : std::max(bevel_limit_square_, miter_limit_square_);
  if (miter_square <= limit) {
    put(on_left, corner + miter);
  } else if (how == LineJoin::Round) {
    arc(on_left, corner, before, after);
  } else {
    put(on_left, corner + before);
    put(on_left, corner + after);
  }
}

/// Both ends and what is between them, the shorter way; a half circle goes around the end of a piece.
void StrokePen::arc(bool on_left, const glm::vec2& center, glm::vec2 from, const glm::vec2& to) {
  put(on_left, center + from);
  // An outer left side turns right.
  const float sine = on_left ? -step_.y : step_.y;
  const float sense = on_left ? -1.0F : 1.0F;
  const float close = 0.25F * step_.y * square_;
  for (std::size_t i = 0; i < arc_points_; ++i) {
    from = {step_.x * from.x - sine * from.y, sine * from.x + step_.x * from.y};
    if (sense * cross(from, to) <= close && glm::dot(from, to) > 0) break;
    put(on_left, center + from);
  }
  put(on_left, center + to);
}

/// From the side of the normal around the end to the other, on the left chain.
void StrokePen::cap(StrokeEnd end, const glm::vec2& point, const glm::vec2& normal) {
  const LineCap how = end == StrokeEnd::Seam ? LineCap::Butt : shape_.cap;
  if (how == LineCap::Round) return arc(true, point, normal, -normal);
  const glm::vec2 out = how == LineCap::Square ? direction_of(normal) : glm::vec2(0);
  left(point + normal + out);
  left(point - normal + out);
}

void StrokePen::emit(const Array<glm::vec2>& chain, std::size_t size, bool reversed) {
  const glm::vec2* const first = chain.data();
  if (reversed) {
    result_.points.insert(result_.points.end(), std::make_reverse_iterator(first + size),
                          std::make_reverse_iterator(first));
  } else {
    result_.points.insert(result_.points.end(), first, first + size);
  }
}

void StrokePen::finish(StrokeEnd start, StrokeEnd end) {
  reserve();
  result_.begin();
  result_.closed.back() = 1;
  cap(end, last_.to, last_.to_normal);
  emit(left_, left_size_, false);
  emit(right_, right_size_, true);
  left_size_ = 0;
  cap(start, first_.from, -first_.from_normal);
  emit(left_, left_size_, false);
  left_size_ = right_size_ = 0;
  empty_ = true;
}

void StrokePen::finish_loop() {
  reserve();
  join(last_, first_, StrokeJoint::Styled);
  result_.begin();
  result_.closed.back() = 1;
  emit(left_, left_size_, false);
  result_.begin();
  result_.closed.back() = 1;
  emit(right_, right_size_, true);
  left_size_ = right_size_ = 0;
  empty_ = true;
}

}  // namespace azulejo
