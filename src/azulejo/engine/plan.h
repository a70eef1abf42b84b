#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/engine/graph.h"

namespace azulejo {

/// A value that a group computes for every tile, and what is done with it.
struct Root {
  ValueRef value;
  bool resident = false;     ///< kept whole, for groups that come later
  std::vector<int> targets;  ///< indices into the targets
  struct Analysis {
    int vertex;  ///< the node that wants it
    int index;   ///< of which of its sources; from their number on, of which of its results
  };
  std::vector<Analysis> analyses;
};

/// Nodes that are computed together, tile by tile: all roots have the same size.
struct Group {
  int level = 0;  ///< groups run in the order of their levels
  std::vector<Root> roots;
  std::vector<int> nodes;       ///< vertices, each after what it reads
  std::vector<ValueRef> files;  ///< sources that are read by bands of rows
  int width = 0;
  int height = 0;
  int tile_width = 0;
  int tile_height = 0;
  int band_height = 0;  ///< a multiple of tile_height; `height` where nothing is streamed
};

/// What `execute` does, decided before anything runs. Depends on kinds and limits, never on pixels.
struct Plan {
  std::vector<Group> groups;
  std::vector<char> resident;    ///< by value index: materialized whole
  std::vector<int> first_value;  ///< index of a vertex's first value; one more at the end

  std::size_t index(ValueRef value) const {
    return static_cast<std::size_t>(first_value[static_cast<std::size_t>(value.vertex)] + value.output);
  }
};

/// An empty analysis as Root::Analysis counts them; null if the node wants none there.
std::unique_ptr<Analysis> make_analysis(const TileNode& node, int index);

Plan make_plan(const Graph& graph, std::span<const Target> targets, const Run& run);

/// The rows or columns of a source that stand for [low, high) under a border rule: the smallest range that
/// covers them. Empty (0, 0) where Border::Constant needs none.
struct Span1 {
  int low = 0;
  int high = 0;
};
Span1 covering(std::int64_t low, std::int64_t high, int size, Border mode);

/// The part of a source inside its image that a node reads to compute `result`.
Rect source_part(const TileNode& node, int source, const Rect& result);

/// By value index: the part of each value that a group needs for one tile. `required` has the plan's number of
/// values; those that the group does not touch become empty.
void propagate(const Graph& graph, const Plan& plan, const Group& group, const Rect& tile, std::vector<Rect>& required);

}  // namespace azulejo
