#include "azulejo/modelling/nearest_triangle.h"

#include <algorithm>
#include <vector>

#include "azulejo/core/parallel.h"
#include "azulejo/data/mesh.h"
#include "azulejo/modelling/triangle_tree.h"

namespace azulejo {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 12;

/// Puts a box in a child's place of a node.
void set_box(kernels::BoxNode& node, std::size_t child, const Box3& box) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    node.lower[a][child] = box.empty() ? std::numeric_limits<float>::infinity() : box.lower[axis];
    node.upper[a][child] = box.empty() ? std::numeric_limits<float>::infinity() : box.upper[axis];
  }
}

Box3 box_of(const kernels::BoxNode& node) {
  Box3 box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    box.lower[axis] = *std::min_element(node.lower[a], node.lower[a] + 4);
    // Children fill a node from the first on; the empty ones, at infinity, are left out.
    for (std::size_t child = 0; child < 4 && node.lower[a][child] < std::numeric_limits<float>::infinity(); ++child) {
      box.upper[axis] = std::max(box.upper[axis], node.upper[a][child]);
    }
  }
  return box;
}

}  // namespace

NearestTriangle::NearestTriangle(std::span<const Triangle> triangles, const Run& run) {
  {
    std::vector<Box3> boxes(triangles.size());
    parallel_for(boxes.size(), kChunk, run, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        for (const glm::vec3& corner : triangles[t]) boxes[t] = united(boxes[t], corner);
      }
    });
    order_ = TriangleTree(boxes, run).order();
  }
  if (order_.empty()) return;
  make_leaves(triangles, run);
  make_nodes(run);
}

void NearestTriangle::make_leaves(std::span<const Triangle> triangles, const Run& run) {
  leaves_.resize((order_.size() + 3) / 4);
  parallel_for(leaves_.size(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t leaf = begin; leaf < end; ++leaf) {
      for (std::size_t i = 0; i < 4; ++i) {
        // What is missing in the last leaf is its last triangle again, which is never nearer than itself.
        const Triangle& triangle = triangles[order_[std::min(4 * leaf + i, order_.size() - 1)]];
        for (std::size_t c = 0; c < 3; ++c) {
          for (std::size_t axis = 0; axis < 3; ++axis) {
            leaves_[leaf].corner[c][axis][i] = triangle[c][static_cast<int>(axis)];
          }
        }
      }
    }
  });
}

void NearestTriangle::make_nodes(const Run& run) {
  std::size_t width = 1;  // of a level
  std::size_t above = 0;  // nodes of all levels above
  while (width < leaves_.size()) {
    above += width;
    width *= 4;
  }
  nodes_.resize(above);
  const std::size_t leaves_begin = above;
  // Level by level, from the lowest.
  for (std::size_t count = width / 4; count > 0; count /= 4) {
    above -= count;
    parallel_for(count, kChunk, run, [&, above](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const std::size_t node = above + i;
        for (std::size_t child = 0; child < 4; ++child) {
          const std::size_t below = 4 * node + 1 + child;
          Box3 box;
          if (below < leaves_begin) {
            box = box_of(nodes_[below]);
          } else if (const std::size_t leaf = below - leaves_begin; leaf < leaves_.size()) {
            for (const auto& corner : leaves_[leaf].corner) {
              for (std::size_t t = 0; t < 4; ++t)
                box = united(box, glm::vec3(corner[0][t], corner[1][t], corner[2][t]));
            }
          }
          set_box(nodes_[node], child, box);
        }
      }
    });
  }
}

NearestTriangle::Found NearestTriangle::find(const glm::dvec3& point, std::uint32_t guess) const {
  Found found;
  if (order_.empty()) return found;
  if (guess != kNone) found = {closest_point(point, corners(guess)).squared, guess};
  const double coordinates[3] = {point.x, point.y, point.z};
  kernels::nearest_triangle({nodes_.data(), leaves_.data(), nodes_.size()}, coordinates, &found.squared, &found.slot);
  return found;
}

std::array<glm::dvec3, 3> NearestTriangle::corners(std::uint32_t slot) const {
  const kernels::TriangleLeaf& leaf = leaves_[slot / 4];
  std::array<glm::dvec3, 3> corners;
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      corners[c][static_cast<int>(axis)] = static_cast<double>(leaf.corner[c][axis][slot % 4]);
    }
  }
  return corners;
}

}  // namespace azulejo
