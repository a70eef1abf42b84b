#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/image.h"
#include "azulejo/engine/border.h"
#include "azulejo/engine/report.h"
#include "azulejo/engine/scratch.h"
#include "azulejo/math/rect.h"

namespace azulejo {

/// A part of an image that a node reads. `pixels` has the size of `rect`, which may reach outside the image:
/// what lies there was filled in by the node's border rule.
struct ConstTile {
  ConstAnyView pixels;
  Rect rect;
};

/// A part of an image that a node computes. A result that nobody wants has pixels.data == nullptr.
struct Tile {
  AnyView pixels;
  Rect rect;
  bool wanted() const { return pixels.data != nullptr; }
};

/// What is gathered of a whole image: a histogram, extrema. Of a node's source, because its first pixel can't be computed
/// without, or because a report says it; of its result, for a report.
/// The outcome must not depend on how the image was divided: gather integers, minima, maxima.
class AZULEJO_EXPORT Analysis {
 public:
  virtual ~Analysis() = default;
  /// Gathers the pixels of `tile`. The tiles of all calls, over all partial results, make up the image.
  virtual void add(const ConstTile& tile, Scratch& scratch) = 0;
  /// Takes in a partial result, which has the same dynamic type.
  virtual void merge(const Analysis& other) = 0;
  /// Everything was merged: tables and such are made here.
  virtual void finish() {}
};

/// What `TileNode::run` gets beside the tiles.
struct TileContext {
  Scratch& scratch;                           ///< memory for the call, this thread's own
  std::span<const Analysis* const> analyses;  ///< one a source first; null where the node asked for none
};

/// One step of a tiled computation, with its options and the kinds of its sources bound. Immutable.
///
/// The constructor is the type check: it throws Error(Argument | Unsupported) if the sources don't fit, and
/// says with `set_results` what comes out. A node without sources makes images from its options; one without results
/// only reports.
class AZULEJO_EXPORT TileNode {
 public:
  explicit TileNode(std::span<const ImageInfo> sources) : sources_(sources.begin(), sources.end()) {}
  virtual ~TileNode() = default;
  TileNode(const TileNode&) = delete;
  TileNode& operator=(const TileNode&) = delete;

  std::span<const ImageInfo> sources() const { return sources_; }
  std::span<const ImageInfo> results() const { return results_; }

  /// The part of `source` from which `result` is computed, before borders: it may reach outside the image.
  /// Monotone: a part of `result` needs a part of it.
  virtual Rect needs(const Rect& result, [[maybe_unused]] int source) const { return result; }
  virtual BorderRule border([[maybe_unused]] int source) const { return {}; }
  /// True if any result needs about all of the source: it is materialized first.
  virtual bool needs_everything([[maybe_unused]] int source) const { return false; }
  /// An empty analysis if the node needs one of this source.
  virtual std::unique_ptr<Analysis> analysis([[maybe_unused]] int source) const { return nullptr; }

  /// An empty analysis if the node's report needs one of this result. It is gathered while the result is computed.
  virtual std::unique_ptr<Analysis> result_analysis([[maybe_unused]] int result) const { return nullptr; }
  /// What the node measured.
  /// analyses  one a source, then one a result; null where the node asked for none
  virtual Report report([[maybe_unused]] std::span<const Analysis* const> analyses) const { return {}; }

  /// Computes the result tiles (all of the same rect) from the source tiles (their rects are needs(rect)), with
  /// vector kernels. Called from several threads at once. Depends on nothing but the pixels in `needs`.
  virtual void run(std::span<const ConstTile> sources, std::span<const Tile> results,
                   const TileContext& context) const = 0;
  /// The same bytes by the plain scalar definition.
  virtual void run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                             const TileContext& context) const = 0;

  /// Reports to run.stages what the step does inside, beside its results (those are reported by the executor).
  virtual void report_stages([[maybe_unused]] std::span<const Analysis* const> analyses,
                             [[maybe_unused]] const class StageReporter& reporter) const {}

 protected:
  void set_results(std::vector<ImageInfo> results) { results_ = std::move(results); }

 private:
  std::vector<ImageInfo> sources_;
  std::vector<ImageInfo> results_;
};

}  // namespace azulejo
