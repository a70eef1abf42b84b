#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "azulejo/modelling/point_tree.h"

namespace azulejo {

/// Cuts polygons into triangles by their ears; keeps its memory from one polygon to the next.
///
/// A cut changes only whether its two neighbours are ears: what was found to be none is not looked at again before that,
/// so that there are at most about 3 n looks, each a search in a tree of the points that can be in the way. Only where
/// this comes to an end too early (crossing, touching, rounding) is everything looked at again, with laxer rules.
class EarClipping {
 public:
  /// Any polygon of three points and more, counter-clockwise. Writes n − 2 triples of indices into `points`.
  void cut(const std::vector<PlanePoint>& points, std::uint32_t* triangles);

 private:
  enum class Rule { Ear, Loose, Convex, Any };

  void link();
  bool may_cut(std::uint32_t at, Rule rule);
  bool blocked(std::uint32_t at, bool touching_blocks);
  bool doubled(std::uint32_t at) const;
  bool convex(std::uint32_t at) const;
  bool cut_doubled();
  void cut_from_queue();
  void cut_by_laxer_rules();
  void cut_off(std::uint32_t at);
  void cut_fan();
  void changed(std::uint32_t at);

  const std::vector<PlanePoint>* points_ = nullptr;
  std::uint32_t* out_ = nullptr;
  std::uint32_t remaining_ = 0;
  std::uint32_t here_ = 0;  ///< a corner that is still there
  std::int64_t work_ = 0;   ///< comparisons left
  std::vector<std::uint32_t> previous_;
  std::vector<std::uint32_t> next_;
  PointTree blockers_;  ///< corners that are not convex: only they can be in the way of an ear

  enum Mark : std::uint8_t { kQueued = 1, kChanged = 2, kGone = 4 };
  std::vector<std::uint8_t> marks_;
  std::vector<std::uint32_t> queue_;  ///< corners to look at, from queue_front_
  std::size_t queue_front_ = 0;
};

}  // namespace azulejo
