#include "azulejo/modelling/triangle_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <glm/common.hpp>

#include "azulejo/core/parallel.h"

namespace azulejo {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 14;

/// 21 bits with two zeros between any two.
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | bits << 32) & 0x001F00000000FFFFU;
  bits = (bits | bits << 16) & 0x001F0000FF0000FFU;
  bits = (bits | bits << 8) & 0x100F00F00F00F00FU;
  bits = (bits | bits << 4) & 0x10C30C30C30C30C3U;
  return (bits | bits << 2) & 0x1249249249249249U;
}

struct Keyed {
  std::uint64_t key;
  std::uint32_t triangle;
};

Box3 all_of(std::span<const Box3> boxes, const Run& run) {
  return parallel_reduce(
      boxes.size(), kChunk, run, Box3(),
      [&](std::size_t begin, std::size_t end) {
        Box3 box;
        for (std::size_t i = begin; i < end; ++i) {
          if (!boxes[i].empty()) box = united(box, boxes[i]);
        }
        return box;
      },
      [](const Box3& a, const Box3& b) { return united(a, b); });
}

}  // namespace

TriangleTree::TriangleTree(std::span<const Box3> boxes, const Run& run) {
  const Box3 all = all_of(boxes, run);
  if (all.empty()) return;
  constexpr float kCells = 1 << 21;
  // One scale for all axes: what is nearly flat lies in order along itself.
  const glm::vec3 extent = all.size();
  const float size = std::max({extent.x, extent.y, extent.z, 1e-30F});
  std::vector<Keyed> keyed(boxes.size());
  parallel_for(boxes.size(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      keyed[i] = {~std::uint64_t{0}, static_cast<std::uint32_t>(i)};
      if (boxes[i].empty()) continue;
      const glm::vec3 place = (boxes[i].center() - all.lower) / size * kCells;
      std::uint64_t key = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const float cell = std::isfinite(place[axis]) ? std::clamp(place[axis], 0.0F, kCells - 1) : 0.0F;
        key |= spread(static_cast<std::uint64_t>(cell)) << axis;
      }
      keyed[i].key = key;
    }
  });
  parallel_sort(keyed.begin(), keyed.end(), run, [](const Keyed& a, const Keyed& b) { return a.key < b.key; });
  while (!keyed.empty() && keyed.back().key == ~std::uint64_t{0}) keyed.pop_back();
  order_.resize(keyed.size());
  for (std::size_t i = 0; i < keyed.size(); ++i) order_[i] = keyed[i].triangle;

  leaves_ = static_cast<std::uint32_t>(std::bit_ceil((order_.size() + kLeaf - 1) / kLeaf));
  boxes_.resize(2 * std::size_t{leaves_});
  parallel_for(leaves_, kChunk / kLeaf, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t leaf = begin; leaf < end; ++leaf) {
      Box3 box;
      for (std::size_t i = leaf * kLeaf; i < std::min(order_.size(), (leaf + 1) * kLeaf); ++i) {
        box = united(box, boxes[order_[i]]);
      }
      boxes_[leaves_ + leaf] = box;
    }
  });
  for (std::size_t node = leaves_; node-- > 1;) boxes_[node] = united(boxes_[2 * node], boxes_[2 * node + 1]);
}

}  // namespace azulejo
