#pragma once

#include <cstdint>
#include <utility>

#include "azulejo/data/array.h"

namespace azulejo::plane {

/// What a sweep line crosses, from below to above: a list that is searched like a tree (a treap, whose priorities come
/// from a counter by a hash, so that its shape is always the same). Keeps its memory.
///
/// Cost  finding, inserting, removing O(log n) as a rule; neighbours O(1)
template <class Data>
class SweepLine {
 public:
  static constexpr std::uint32_t kEnd = 0;  ///< below all and above all

  SweepLine() { clear(); }
  void clear() {
    nodes_.assign(1, Node{});
    free_ = kEnd;
    root_ = kEnd;
    created_ = 0;
  }

  Data& operator[](std::uint32_t node) { return nodes_[node].data; }
  const Data& operator[](std::uint32_t node) const { return nodes_[node].data; }
  std::uint32_t below(std::uint32_t node) const { return nodes_[node].previous; }
  std::uint32_t above(std::uint32_t node) const { return nodes_[node].next; }

  /// The uppermost node for which `lies_below` is true, as it is for all below that one; kEnd if there is none.
  template <class LiesBelow>
  std::uint32_t last_below(LiesBelow lies_below) const {
    std::uint32_t found = kEnd;
    for (std::uint32_t at = root_; at != kEnd;) {
      const bool is_below = lies_below(nodes_[at].data);
      found = is_below ? at : found;
      at = is_below ? nodes_[at].right : nodes_[at].left;
    }
    return found;
  }

  /// A node just above another one, or the lowest.
  std::uint32_t insert_above(std::uint32_t place, const Data& data) {
    const std::uint32_t node = take();
    nodes_[node].data = data;
    nodes_[node].priority = priority();
    nodes_[node].left = nodes_[node].right = kEnd;
    const std::uint32_t next = nodes_[place].next;
    nodes_[node].previous = place;
    nodes_[node].next = next;
    nodes_[place].next = node;
    nodes_[next].previous = node;
    if (root_ == kEnd) {
      root_ = node;
      nodes_[node].parent = kEnd;
      return node;
    }
    // Between two neighbours in a tree, one of the two facing sides is free.
    const bool to_the_right = place != kEnd && nodes_[place].right == kEnd;
    const std::uint32_t parent = to_the_right ? place : next;
    (to_the_right ? nodes_[parent].right : nodes_[parent].left) = node;
    nodes_[node].parent = parent;
    while (nodes_[node].parent != kEnd && nodes_[node].priority > nodes_[nodes_[node].parent].priority) lift(node);
    return node;
  }

  void erase(std::uint32_t node) {
    while (nodes_[node].left != kEnd && nodes_[node].right != kEnd) {
      const std::uint32_t left = nodes_[node].left;
      const std::uint32_t right = nodes_[node].right;
      lift(nodes_[left].priority > nodes_[right].priority ? left : right);
    }
    const std::uint32_t child = nodes_[node].left != kEnd ? nodes_[node].left : nodes_[node].right;
    replace_child(nodes_[node].parent, node, child);
    if (child != kEnd) nodes_[child].parent = nodes_[node].parent;
    nodes_[nodes_[node].previous].next = nodes_[node].next;
    nodes_[nodes_[node].next].previous = nodes_[node].previous;
    nodes_[node].next = free_;
    free_ = node;
  }

 private:
  /// In a line of the cache of its own: searches wait for memory.
  struct alignas(64) Node {
    Data data;
    std::uint32_t left = kEnd;
    std::uint32_t right = kEnd;
    std::uint32_t parent = kEnd;
    std::uint32_t previous = kEnd;
    std::uint32_t next = kEnd;
    std::uint32_t priority = 0;
  };

  std::uint32_t take() {
    if (free_ == kEnd) {
      nodes_.emplace_back();
      return static_cast<std::uint32_t>(nodes_.size() - 1);
    }
    return std::exchange(free_, nodes_[free_].next);
  }
  std::uint32_t priority() {
    std::uint32_t x = ++created_ * 0x9E3779B9U;
    x = (x ^ x >> 16) * 0x85EBCA6BU;
    return x ^ x >> 13;
  }
  void replace_child(std::uint32_t parent, std::uint32_t old_child, std::uint32_t child) {
    if (parent == kEnd) {
      root_ = child;
    } else {
      (nodes_[parent].left == old_child ? nodes_[parent].left : nodes_[parent].right) = child;
    }
  }
  /// Rotates a node into the place of its parent.
  void lift(std::uint32_t node) {
    const std::uint32_t parent = nodes_[node].parent;
    const bool is_left = nodes_[parent].left == node;
    const std::uint32_t moved = is_left ? nodes_[node].right : nodes_[node].left;
    (is_left ? nodes_[parent].left : nodes_[parent].right) = moved;
    if (moved != kEnd) nodes_[moved].parent = parent;
    replace_child(nodes_[parent].parent, parent, node);
    nodes_[node].parent = nodes_[parent].parent;
    nodes_[parent].parent = node;
    (is_left ? nodes_[node].right : nodes_[node].left) = parent;
  }

  Array<Node> nodes_;
  std::uint32_t free_ = kEnd;
  std::uint32_t root_ = kEnd;
  std::uint32_t created_ = 0;
};

}  // namespace azulejo::plane
