#include "azulejo/rendering/stroke_pen.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>

namespace azulejo {
namespace {

float cross(const glm::vec2& a, const glm::vec2& b) { return a.x * b.y - a.y * b.x; }

/// By what part of a piece's length one side is longer, the other shorter than the middle.
float growth_of(const StrokePiece& piece) {
  if (piece.from_normal == piece.to_normal) return 0;
  const glm::vec2 along = piece.to - piece.from;
  return std::abs(glm::dot(piece.to_normal - piece.from_normal, along)) / glm::dot(along, along);
}
/// Beyond that a piece has an outline for itself.
constexpr float kMostGrowth = 0.8F;

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
  const std::size_t wanted = std::max(left_size_, right_size_) + 2 * arc_points_ + 32;
  if (left_.size() >= wanted && right_.size() >= wanted) return;
  left_.resize(2 * wanted);
  right_.resize(2 * wanted);
}

void StrokePen::across(const glm::vec2& point, const glm::vec2& normal) {
  left(point + normal);
  right(point - normal);
}

void StrokePen::begin_outline(const glm::vec2& normal) {
  left_size_ = right_size_ = 0;
  beginning_ = normal;
  once_ = true;
}

void StrokePen::begin(StrokeEnd start, const StrokePiece& piece) {
  reserve();
  start_ = start;
  first_ = piece;
  empty_ = false;
  begin_outline(piece.from_normal);
  across(piece.from, piece.from_normal);
  put_piece(piece);
}

/// Whether the outline has no place for a piece.
bool StrokePen::ends_before(const StrokePiece& piece) const {
  constexpr float kMostTurn = 0.7071F;
  constexpr std::size_t kLongest = 1024;
  return !(glm::dot(beginning_, piece.to_normal) >= kMostTurn * square_) || left_size_ >= kLongest ||
         growth_of(last_) > kMostGrowth || growth_of(piece) > kMostGrowth;
}

void StrokePen::add(const StrokePiece& piece, StrokeJoint joint) {
  reserve();
  if (joint == StrokeJoint::Smooth) {
    across(piece.from, piece.from_normal);
    if (ends_before(piece)) {
      end_outline();
      begin_outline(piece.from_normal);
      across(piece.from, piece.from_normal);
    }
  } else {
    join(last_, piece, joint);
  }
  put_piece(piece);
}

void StrokePen::put_piece(const StrokePiece& piece) {
  last_ = piece;
  if (growth_of(piece) <= 1) return;
  cross_sides(piece, glm::dot(piece.to_normal - piece.from_normal, piece.to - piece.from) < 0);
}

/// Where a curve's radius is below half the width its inner side runs backwards, and the quad crosses itself at a point
/// on both normals: the two triangles are gone around by way of the middle line, so that both turn like everything else.
void StrokePen::cross_sides(const StrokePiece& piece, bool on_left) {
  const float sign = on_left ? 1.0F : -1.0F;
  const glm::vec2 from = piece.from + sign * piece.from_normal;
  const glm::vec2 to = piece.to + sign * piece.to_normal;
  const float share = cross(piece.to - piece.from, piece.to_normal) / cross(piece.from_normal, piece.to_normal);
  const glm::vec2 crossing = piece.from + std::clamp(share, -1.0F, 1.0F) * piece.from_normal;
  for (const glm::vec2& each : {from, piece.from, crossing, to, from, crossing, piece.to}) put(on_left, each);
  once_ = false;
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
  const glm::vec2 miter = outer * scale * (n + m);
  const float miter_square = turns_back ? std::numeric_limits<float>::infinity() : 2 * square_ * scale;
  const LineJoin how = joint == StrokeJoint::Round ? LineJoin::Round : shape_.join;
  const float limit = how == LineJoin::Round   ? round_limit_square_
                      : how == LineJoin::Bevel ? bevel_limit_square_
                                               : std::max(bevel_limit_square_, miter_limit_square_);
  const bool fits = miter_square - square_ <= std::min(before.spare, after.spare);
  const bool flat = fits && miter_square <= limit;
  const bool ends = !flat || ends_before(after);
  if (miter_square <= limit) {
    put(!left_is_inner, corner + miter);
  } else {
    join_outside(!left_is_inner, corner, outer * n, outer * m, how);
  }
  if (fits) {
    put(left_is_inner, corner - miter);
  } else {
    put(left_is_inner, corner - outer * n);
    put(left_is_inner, corner);
  }
  if (!ends) return;
  const glm::vec2 last_outside = left_is_inner ? right_[right_size_ - 1] : left_[left_size_ - 1];
  end_outline();
  begin_outline(m);
  put(!left_is_inner, last_outside);
  if (fits) return put(left_is_inner, corner - miter);
  put(left_is_inner, corner);
  put(left_is_inner, corner - outer * m);
}

/// What isn't a miter.
void StrokePen::join_outside(bool on_left, const glm::vec2& corner, const glm::vec2& before, const glm::vec2& after,
                             LineJoin how) {
  if (how == LineJoin::Round) return arc(on_left, corner, before, after);
  put(on_left, corner + before);
  put(on_left, corner + after);
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

/// Left forward, right backward, and the cap of the beginning between them.
void StrokePen::end_outline() {
  result_.begin();
  result_.closed.back() = 1;
  result_.once.back() = once_ ? 1 : 0;
  result_.points.insert(result_.points.end(), left_.data(), left_.data() + left_size_);
  const auto last = std::make_reverse_iterator(right_.data() + right_size_);
  result_.points.insert(result_.points.end(), last, std::make_reverse_iterator(right_.data()));
  if (start_ == StrokeEnd::Cap && shape_.cap != LineCap::Butt) {
    left_size_ = 0;
    cap(start_, first_.from, -first_.from_normal);
    result_.points.insert(result_.points.end(), left_.data(), left_.data() + left_size_);
  }
  start_ = StrokeEnd::Seam;
}

void StrokePen::finish(StrokeEnd end) {
  reserve();
  empty_ = true;
  if (end == StrokeEnd::Seam && start_ == StrokeEnd::Seam && last_.from == last_.to) {
    // It only closed a line, and the join was all that it needed, but for half of a miter.
    if (left_size_ == 1 && left_[0] == last_.to + last_.to_normal) return;
    if (right_size_ == 1 && right_[0] == last_.to - last_.to_normal) return;
  }
  cap(end, last_.to, last_.to_normal);
  end_outline();
}

}  // namespace azulejo
