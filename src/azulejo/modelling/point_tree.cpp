#include "azulejo/modelling/point_tree.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace azulejo {

void PointTree::build(const std::vector<PlanePoint>& points, const std::vector<std::uint32_t>& held) {
  points_ = &points;
  sorted_ = held;
  leaves_ = std::bit_ceil(std::max<std::size_t>(held.size() / kLeaf, 1));
  boxes_.assign(2 * leaves_, Box());
  split(1, 0, leaves_);
  place_.assign(points.size(), kNowhere);
  for (std::size_t i = 0; i < sorted_.size(); ++i) place_[sorted_[i]] = static_cast<std::uint32_t>(i);
}

/// Makes the boxes of a node with the leaves [begin, end) and of all below it: as deep as the logarithm of the points.
void PointTree::split(std::size_t node, std::size_t begin, std::size_t end) {
  const auto at = [&](std::size_t leaf) { return sorted_.begin() + static_cast<std::ptrdiff_t>(begin_of(leaf)); };
  constexpr double kFar = std::numeric_limits<double>::max();
  Box box{{kFar, kFar}, {-kFar, -kFar}, static_cast<std::uint32_t>(begin_of(end) - begin_of(begin))};
  for (auto each = at(begin); each != at(end); ++each) {
    const PlanePoint& point = (*points_)[*each];
    box.lower = {std::min(box.lower.u, point.u), std::min(box.lower.v, point.v)};
    box.upper = {std::max(box.upper.u, point.u), std::max(box.upper.v, point.v)};
  }
  boxes_[node] = box;
  if (end - begin == 1) return;
  const bool along_u = box.upper.u - box.lower.u > box.upper.v - box.lower.v;
  const std::size_t middle = (begin + end) / 2;
  std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
    const PlanePoint& p = (*points_)[a];
    const PlanePoint& q = (*points_)[b];
    const double left = along_u ? p.u : p.v;
    const double right = along_u ? q.u : q.v;
    return left < right || (left == right && a < b);
  });
  split(2 * node, begin, middle);
  split(2 * node + 1, middle, end);
}

void PointTree::remove(std::uint32_t point) {
  const std::size_t place = place_[point];
  if (place == kNowhere) return;
  place_[point] = kNowhere;
  sorted_[place] = kNowhere;
  // The leaf whose range holds the place: rounding down may have to be made good by one.
  std::size_t leaf = place * leaves_ / sorted_.size();
  while (begin_of(leaf + 1) <= place) ++leaf;
  while (begin_of(leaf) > place) --leaf;
  for (std::size_t node = leaves_ + leaf; node > 0; node /= 2) --boxes_[node].count;
}

/// Certainly apart: beside the triangle's box, or on the outside of one of its sides.
bool PointTree::apart(const Box& box, const PlanePoint (&triangle)[3]) {
  const auto& [a, b, c] = triangle;
  if (std::max({a.u, b.u, c.u}) < box.lower.u || std::min({a.u, b.u, c.u}) > box.upper.u ||
      std::max({a.v, b.v, c.v}) < box.lower.v || std::min({a.v, b.v, c.v}) > box.upper.v) {
    return true;
  }
  for (int side = 0; side < 3; ++side) {
    const PlanePoint& from = triangle[side];
    const PlanePoint& to = triangle[side == 2 ? 0 : side + 1];
    // The corner of the box that lies farthest to the left of the side.
    const PlanePoint corner = {to.v > from.v ? box.lower.u : box.upper.u, to.u > from.u ? box.upper.v : box.lower.v};
    if (turn(from, to, corner) < 0) return true;
  }
  return false;
}

}  // namespace azulejo
