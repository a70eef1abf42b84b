#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace azulejo {

/// A point of a plane.
struct PlanePoint {
  double u = 0;
  double v = 0;
  friend bool operator==(const PlanePoint&, const PlanePoint&) = default;
};

/// Twice the area of a triangle, positive where it turns counter-clockwise. Points that were floats of like size make
/// differences and products that are exact in double, so the sign is right.
inline double turn(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

/// Points of a plane that can be taken out, and searched for those in a triangle: a balanced tree of boxes.
class PointTree {
 public:
  /// Holds those of `points` that `held` names; both are to outlive the tree.
  void build(const std::vector<PlanePoint>& points, const std::vector<std::uint32_t>& held);
  void remove(std::uint32_t point);
  bool holds(std::uint32_t point) const { return place_[point] != kNowhere; }

  /// Whether `wanted(point)` holds for a point that may lie in the triangle (those outside are only mostly left out).
  /// Counts what it looks at down from `work`.
  template <class Wanted>
  bool any_near(const PlanePoint (&triangle)[3], std::int64_t& work, Wanted wanted) const;

 private:
  static constexpr std::uint32_t kNowhere = 0xFFFFFFFF;
  static constexpr std::size_t kLeaf = 8;  ///< points

  struct Box {
    PlanePoint lower;
    PlanePoint upper;
    std::uint32_t count = 0;  ///< of points still there
  };

  void split(std::size_t node, std::size_t begin, std::size_t end);
  std::size_t begin_of(std::size_t leaf) const { return leaf * sorted_.size() / leaves_; }
  static bool apart(const Box& box, const PlanePoint (&triangle)[3]);

  const std::vector<PlanePoint>* points_ = nullptr;
  std::vector<std::uint32_t> sorted_;  ///< the points, leaf by leaf; removed ones become kNowhere
  std::vector<std::uint32_t> place_;   ///< of each point in sorted_
  std::vector<Box> boxes_;             ///< the root is 1, children of n are 2n and 2n + 1; leaves come last
  std::size_t leaves_ = 1;             ///< a power of two
};

template <class Wanted>
bool PointTree::any_near(const PlanePoint (&triangle)[3], std::int64_t& work, Wanted wanted) const {
  std::size_t waiting[64];  // one more a level, at most
  std::size_t count = 0;
  waiting[count++] = 1;
  while (count > 0) {
    const std::size_t node = waiting[--count];
    --work;
    if (boxes_[node].count == 0 || apart(boxes_[node], triangle)) continue;
    if (node < leaves_) {
      waiting[count++] = 2 * node;
      waiting[count++] = 2 * node + 1;
      continue;
    }
    const std::size_t leaf = node - leaves_;
    const std::size_t end = begin_of(leaf + 1);
    for (std::size_t i = begin_of(leaf); i < end; ++i) {
      --work;
      if (sorted_[i] != kNowhere && wanted(sorted_[i])) return true;
    }
  }
  return false;
}

}  // namespace azulejo
