#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/engine/source.h"
#include "azulejo/engine/tile_node.h"

namespace azulejo {

/// One result of one vertex of a graph.
struct ValueRef {
  int vertex = -1;
  int output = 0;
  friend bool operator==(const ValueRef&, const ValueRef&) = default;
};

/// Sources and nodes, each node after what it reads.
class AZULEJO_EXPORT Graph {
 public:
  /// An image that the caller keeps alive, or an image file.
  ValueRef add_source(std::shared_ptr<ImageSource> source, std::string label);
  /// Pixels that the caller keeps alive.
  ValueRef add_source(const ConstAnyView& pixels, std::string label);
  /// The node's first result; of several, the others are {vertex, 1}, {vertex, 2}, ….
  /// result_names  one a result, for stages and --explain
  ValueRef add_node(std::unique_ptr<TileNode> node, std::vector<ValueRef> sources, std::string label,
                    std::vector<std::string> result_names = {"result"});

  const ImageInfo& info(ValueRef value) const;

  struct Vertex {
    std::string label;
    std::shared_ptr<ImageSource> source;  ///< of a source that is not plain memory
    ConstAnyView pixels;                  ///< of a source in memory
    std::unique_ptr<TileNode> node;
    std::vector<ValueRef> sources;
    std::vector<std::string> result_names;
    ImageInfo source_info;
  };
  std::span<const Vertex> vertices() const { return vertices_; }

 private:
  std::vector<Vertex> vertices_;
};

/// What is wanted of the graph, and where it goes: a value into `pixels` or, by rows, into `sink`; or what a node gathers
/// for its report, to `analysed`.
struct Target {
  ValueRef value;
  AnyView pixels = {};  ///< data null: not here
  ImageSink* sink = nullptr;
  /// Called once everything is gathered, with an analysis a source, then one a result, of the node `value.vertex`.
  std::function<void(std::span<const Analysis* const> analyses)> analysed = {};
};

/// Computes the targets.
///
/// Neighbouring nodes are fused: computed tile by tile while the data is in cache. A node that needs everything, or
/// reaches more than 64 pixels, has its source materialized first: in memory below run.limits.memory_bytes, else in
/// a temporary file. Files are read and written by bands of rows, while the band between is computed.
/// Results have the same bytes for any number of threads, tiles, bands and fusion.
/// Throws  what nodes, sources and sinks throw; Error(Cancelled); Error(Resource) past run.limits
AZULEJO_EXPORT void execute(const Graph& graph, std::span<const Target> targets, const Run& run);

/// Says what `execute` would do: fused groups, barriers, passes, memory. Several lines.
AZULEJO_EXPORT std::string explain(const Graph& graph, std::span<const Target> targets, const Run& run);

}  // namespace azulejo
