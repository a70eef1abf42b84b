#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/data/array.h"
#include "azulejo/data/mesh.h"

namespace azulejo {

/// Boxes around boxes around triangles: finds those near a place without looking at all.
///
/// Triangles lie in the order of a space-filling curve through their middles, `kLeaf` to a leaf; the boxes above are a
/// complete binary tree. The same for any number of threads.
/// Memory  4 bytes a triangle and 48 a leaf of four
class TriangleTree {
 public:
  static constexpr std::size_t kLeaf = 4;

  /// boxes  one a triangle; an empty one is found by nothing
  TriangleTree(std::span<const Box3> boxes, const Run& run);

  /// Calls f(triangle) for each whose leaf's box meets `box` (closed).
  template <class F>
  void visit(const Box3& box, F f) const {
    visit_leaves([&](const Box3& each) { return meet(each, box); },
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t i = begin; i < end; ++i) f(order_[i]);
                 });
  }

  /// Calls f(begin, end), places in `order`, for each leaf whose box and those above it are such that `meets(box)`.
  template <class Meets, class F>
  void visit_leaves(Meets meets, F f) const {
    if (order_.empty()) return;
    std::uint32_t waiting[2 * 32];
    int count = 0;
    waiting[count++] = 1;
    while (count > 0) {
      const std::uint32_t node = waiting[--count];
      if (!meets(boxes_[node])) continue;
      if (node < leaves_) {
        waiting[count++] = 2 * node + 1;
        waiting[count++] = 2 * node;
        continue;
      }
      const std::size_t first = (node - leaves_) * kLeaf;
      f(first, std::min(first + kLeaf, order_.size()));
    }
  }

  /// The triangles in the order of the curve, those with an empty box left out.
  const Array<std::uint32_t>& order() const { return order_; }
  /// Leaves, a power of two: node n < leaves has the children 2 n and 2 n + 1; leaf l, which is node leaves + l, the
  /// places in `order` from kLeaf · l on, as far as there are any.
  std::size_t leaves() const { return leaves_; }

  static bool meet(const Box3& a, const Box3& b) {
    return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y && b.lower.y <= a.upper.y &&
           a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
  }

 private:
  Array<std::uint32_t> order_;
  std::uint32_t leaves_ = 1;  ///< a power of two
  std::vector<Box3> boxes_;   ///< 1 is the root; the children of n are 2 n and 2 n + 1
};

}  // namespace azulejo
