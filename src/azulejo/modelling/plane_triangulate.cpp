#include "azulejo/modelling/plane_triangulate.h"

namespace azulejo::plane {

void Triangulator::push(Piece& piece, std::uint32_t point) {
  std::uint32_t place = free_waiting_;
  if (place == kNone) {
    place = static_cast<std::uint32_t>(waiting_.size());
    waiting_.emplace_back();
  } else {
    free_waiting_ = waiting_[place].under;
  }
  waiting_[place] = {point, piece.top};
  piece.top = place;
}

void Triangulator::pop(Piece& piece) {
  const std::uint32_t place = piece.top;
  piece.top = waiting_[place].under;
  waiting_[place].under = free_waiting_;
  free_waiting_ = place;
}

void Triangulator::triangle(Chain chain, std::uint32_t left, std::uint32_t right, std::uint32_t point) {
  if (chain == Chain::Upper) std::swap(left, right);
  triangles_.insert(triangles_.end(), {left, right, point});
}

/// Triangles from all that wait to a point on the other chain, or at the end of both. Nothing waits then.
void Triangulator::fan(Piece& piece, std::uint32_t point) {
  while (piece.top != kNone) {
    const Waiting top = waiting_[piece.top];
    pop(piece);
    if (top.under != kNone) triangle(piece.chain, waiting_[top.under].point, top.point, point);
  }
}

void Triangulator::add(std::uint32_t index, std::uint32_t point, Chain chain) {
  Piece& piece = pieces_[index];
  if (on_piece) (chain == Chain::Lower ? outlines_[index].lower : outlines_[index].upper).push_back(point);
  if (piece.chain != chain && waiting_[piece.top].under != kNone) {
    const std::uint32_t last = waiting_[piece.top].point;
    fan(piece, point);
    push(piece, last);
  } else {
    const std::int64_t sign = chain == Chain::Lower ? 1 : -1;
    for (std::uint32_t under = waiting_[piece.top].under; under != kNone; under = waiting_[piece.top].under) {
      const std::uint32_t left = waiting_[under].point;
      const std::uint32_t right = waiting_[piece.top].point;
      if (sign * turn(graph_.points[left], graph_.points[right], graph_.points[point]) <= 0) break;
      triangle(chain, left, right, point);
      pop(piece);
    }
  }
  piece.chain = chain;
  push(piece, point);
}

void Triangulator::finish(std::uint32_t index, std::uint32_t point) {
  fan(pieces_[index], point);
  if (on_piece) {
    outlines_[index].lower.push_back(point);
    outlines_[index].upper.push_back(point);
    on_piece(outlines_[index]);
  }
  free_pieces_.push_back(index);
}

std::uint32_t Triangulator::begin(std::uint32_t point) {
  if (free_pieces_.empty()) {
    free_pieces_.push_back(static_cast<std::uint32_t>(pieces_.size()));
    pieces_.emplace_back();
    if (on_piece) outlines_.emplace_back();
  }
  const std::uint32_t index = free_pieces_.back();
  free_pieces_.pop_back();
  pieces_[index] = Piece();
  push(pieces_[index], point);
  if (on_piece) outlines_[index] = {{point}, {point}};
  return index;
}

std::uint32_t Triangulator::open(std::uint32_t point) { return begin(point); }

std::uint32_t Triangulator::add_above(std::uint32_t gap, std::uint32_t point) {
  const std::uint32_t other = std::exchange(pieces_[gap].above, kNone);
  if (other != kNone) finish(other, point);
  add(gap, point, Chain::Upper);
  return gap;
}

std::uint32_t Triangulator::add_below(std::uint32_t gap, std::uint32_t point) {
  const std::uint32_t other = std::exchange(pieces_[gap].above, kNone);
  if (other != kNone) finish(gap, point);
  const std::uint32_t on = other != kNone ? other : gap;
  add(on, point, Chain::Lower);
  return on;
}

void Triangulator::close(std::uint32_t gap, std::uint32_t point) {
  const std::uint32_t other = std::exchange(pieces_[gap].above, kNone);
  finish(gap, point);
  if (other != kNone) finish(other, point);
}

std::pair<std::uint32_t, std::uint32_t> Triangulator::split(std::uint32_t gap, std::uint32_t point) {
  std::uint32_t upper = std::exchange(pieces_[gap].above, kNone);
  std::uint32_t lower = gap;
  if (upper == kNone) {
    // The part behind the chain of the last point goes on, the other one begins at that point.
    const std::uint32_t fresh = begin(waiting_[pieces_[gap].top].point);
    const bool last_is_lower = pieces_[gap].chain == Chain::Lower;
    lower = last_is_lower ? fresh : gap;
    upper = last_is_lower ? gap : fresh;
  }
  add(lower, point, Chain::Upper);
  add(upper, point, Chain::Lower);
  return {lower, upper};
}

std::uint32_t Triangulator::join(std::uint32_t below, std::uint32_t above, std::uint32_t) {
  pieces_[below].above = above;
  return below;
}

}  // namespace azulejo::plane
