#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>

#include "azulejo/core/run.h"
#include "azulejo/data/array.h"
#include "azulejo/modelling/closest_point.h"
#include "azulejo/modelling/nearest_triangle_kernels.h"

namespace azulejo {

/// Finds the triangle that is nearest to a point, among any number of them; triangles may be segments and points.
///
/// Triangles lie in the order of a space-filling curve (TriangleTree), four to a leaf, under a complete tree of four
/// children a node. Distances are those of `closest_point`, in doubles, from coordinates that are exact.
/// Memory  36 bytes a triangle and 4 for its index; 8–32 for boxes
/// Cost    O(log n) as a rule: 10⁶ searches a second and more for points that follow one another on a surface
class NearestTriangle {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  using Triangle = std::array<glm::vec3, 3>;

  struct Found {
    double squared = std::numeric_limits<double>::infinity();  ///< of the distance
    std::uint32_t slot = kNone;                                ///< place in the tree, for `index` and `corners`
  };

  /// triangles  coordinates must be finite
  NearestTriangle(std::span<const Triangle> triangles, const Run& run);

  std::size_t size() const { return order_.size(); }
  /// guess  the slot of a triangle that may be near, as found for a point nearby; kNone: unknown. The distance doesn't
  ///        depend on it; of triangles at equal distances another one may be found
  Found find(const glm::dvec3& point, std::uint32_t guess = kNone) const;

  /// The number of a slot's triangle among those given.
  std::uint32_t index(std::uint32_t slot) const { return order_[slot]; }
  std::array<glm::dvec3, 3> corners(std::uint32_t slot) const;

 private:
  void make_leaves(std::span<const Triangle> triangles, const Run& run);
  void make_nodes(const Run& run);

  Array<std::uint32_t> order_;
  Array<kernels::TriangleLeaf> leaves_;
  Array<kernels::BoxNode> nodes_;  ///< 0 is the root; children of n are 4 n + 1 to 4 n + 4, leaves come last
};

}  // namespace azulejo
