#pragma once

#include <cstddef>
#include <cstdint>

namespace azulejo::kernels {

/// Boxes of the four children of a node; an empty one begins at infinity.
struct BoxNode {
  float lower[3][4];
  float upper[3][4];
};

/// Four triangles: coordinates by corner and axis.
struct TriangleLeaf {
  float corner[3][3][4];
};

struct TriangleSearch {
  const BoxNode* nodes;
  const TriangleLeaf* leaves;
  std::size_t node_count;
};

/// Looks for a triangle nearer than `*squared`; sets it and its slot, leaf × 4 + place, if there is one.
void nearest_triangle(const TriangleSearch& tree, const double point[3], double* squared, std::uint32_t* slot);

}  // namespace azulejo::kernels
