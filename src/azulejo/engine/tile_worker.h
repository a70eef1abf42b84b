#pragma once

#include <memory>
#include <span>
#include <vector>

#include "azulejo/engine/graph.h"
#include "azulejo/engine/plan.h"
#include "azulejo/engine/scratch.h"

namespace azulejo {

/// Pixels of a value that tiles of a group may read: all of it, or a band of its rows.
struct Available {
  ConstAnyView pixels;  ///< data null: not there
  Rect rect;            ///< which part of the value
};

/// A place that the root tiles of a group are written to.
struct Destination {
  std::size_t root;  ///< index into the group's roots
  AnyView pixels;
  Rect rect;  ///< which part of the value `pixels` is
};

/// What all workers of a group share while a band is computed.
struct GroupJob {
  const Graph& graph;
  const Plan& plan;
  const Group& group;
  bool reference = false;
  std::vector<Available> available;  ///< by value index
  std::vector<Destination> destinations;
  std::vector<std::vector<const Analysis*>> finished_analyses;  ///< by vertex: one a source, then one a result
};

/// Computes tiles of a group, one after another, on one thread.
class TileWorker {
 public:
  explicit TileWorker(const GroupJob& job);

  /// Computes all roots at `tile` and writes them to the job's destinations.
  void compute(const Rect& tile);

  /// Partial results of the analyses that the group's roots feed, in the order of the roots and their analyses.
  std::span<const std::unique_ptr<Analysis>> partials() const { return partials_; }

 private:
  void run_node(int vertex, const Rect& tile);
  void find_readers();
  Rect with_margin(ValueRef value, const Rect& computed) const;
  void fill_margin(ValueRef value, const Rect& computed);
  ConstTile source_tile(int vertex, int source, const Rect& computed);
  ConstTile bordered(const ConstAnyView& pixels, const Rect& rect, const Rect& need, const ImageInfo& whole,
                     const BorderRule& rule);
  AnyView new_tile(const ImageInfo& info, const Rect& rect);
  void deliver(const Rect& tile);

  const GroupJob& job_;
  Scratch tiles_;    ///< intermediates of a tile
  Scratch scratch_;  ///< what nodes take while they run
  std::vector<Rect> required_;
  std::vector<Tile> computed_;  ///< by value index; with the margin that its reader needs, where it has one
  struct Reader {
    int vertex = -1;  ///< the only one in the group that reads the value; −1: none or several, or it is a root
    int source = 0;
  };
  std::vector<Reader> readers_;  ///< by value index
  std::vector<ConstTile> node_sources_;
  std::vector<Tile> node_results_;
  std::vector<std::unique_ptr<Analysis>> partials_;
};

}  // namespace azulejo
