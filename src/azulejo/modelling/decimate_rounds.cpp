#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "azulejo/core/parallel.h"
#include "azulejo/modelling/decimate_parts.h"

namespace azulejo::decimation {
namespace {

constexpr std::size_t kEdges = std::size_t{1} << 14;      ///< of one task
constexpr std::size_t kCandidates = std::size_t{1} << 9;  ///< of one task
/// How many of the edges compete in a round, and how many for each that is needed: tuned on the dragon for the distance
/// from the source; fewer is slower and no better.
constexpr double kShare = 0.2;
constexpr std::size_t kPerNeeded = 8;
constexpr std::size_t kFewest = 1024;
/// How many edges ahead memory is asked for what they need.
constexpr std::size_t kAheadOfChoice = 16;
constexpr std::size_t kAheadOfCollapse = 8;

/// How many edges cost about how much: bins are quarters of a doubling.
class Costs {
 public:
  static constexpr std::size_t kBins = std::size_t{1} << 10;
  static constexpr std::size_t kInfinite = std::size_t{0x7F800000} >> 21;  ///< the bin of what can't collapse
  static std::size_t bin(float cost) { return std::bit_cast<std::uint32_t>(cost) >> 21; }  // not negative: 10 bits

  void add(float cost) { ++counts_[bin(cost)]; }
  void add(const Costs& other) {
    for (std::size_t i = 0; i < kBins; ++i) counts_[i] += other.counts_[i];
  }
  /// The first bin by which there are as many edges.
  std::size_t last_bin(std::size_t wanted) const {
    std::size_t sum = 0;
    for (std::size_t i = 0; i < kInfinite; ++i) {
      sum += counts_[i];
      if (sum >= wanted) return i;
    }
    return kInfinite - 1;
  }
  /// Where each four bins begin, up to the end of `last`.
  std::vector<std::size_t> firsts(std::size_t last) const {
    std::vector<std::size_t> first(last / 4 + 2, 0);
    for (std::size_t i = 0; i <= last; ++i) first[i / 4 + 1] += counts_[i];
    for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
    return first;
  }
  /// Those that can collapse.
  std::size_t total() const { return std::accumulate(counts_.begin(), counts_.begin() + kInfinite, std::size_t{0}); }

 private:
  std::array<std::uint32_t, kBins> counts_{};
};

class Rounds {
 public:
  Rounds(Surface& surface, const DecimateOptions& options, std::size_t target, const Run& run)
      : surface_(surface), options_(options), planner_(surface, options), target_(target), run_(run) {}

  Reached run() {
    blocked_.assign(surface_.vertices.size(), 0);
    changed_.assign(surface_.vertices.size(), 0);
    surface_.costs.resize(surface_.ends.size());
    surface_.stars.reserve(kStarRoom * surface_.faces);
    find_costs();
    const std::size_t at_first = surface_.faces;
    std::size_t faces_then = surface_.faces;
    while (surface_.faces > target_) {
      check_cancelled(run_);
      if (choose_candidates()) {
        choose();
        do_chosen();
        if (run_.progress) {
          run_.progress(static_cast<double>(at_first - surface_.faces) / static_cast<double>(at_first - target_));
        }
        continue;
      }
      // What was refused may be possible now: things around it have changed. A few in a thousand are left undone, so
      // that this comes to an end.
      if (faces_then - surface_.faces <= surface_.faces / 256) break;
      faces_then = surface_.faces;
      renew_stars(surface_);
      find_costs();
    }
    Reached reached;
    reached.error = std::sqrt(largest_);
    reached.stopped = surface_.faces <= target_ ? DecimateStop::Faces
                      : stopped_by_error()      ? DecimateStop::Error
                                                : DecimateStop::Nothing;
    return reached;
  }

 private:
  void find_costs() {
    parallel_for(surface_.costs.size(), kEdges / 8, run_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) surface_.costs[i] = planner_.cost(static_cast<std::uint32_t>(i));
    });
  }

  /// Whether an edge is left that only `error` keeps from collapsing.
  bool stopped_by_error() const {
    if (!options_.error) return false;
    for (std::uint32_t edge = 0; edge < surface_.costs.size(); ++edge) {
      if (std::isfinite(planner_.plan(edge).cost) && !std::isfinite(planner_.cost(edge))) return true;
    }
    return false;
  }

  /// The cheapest edges that can collapse; false: none.
  bool choose_candidates() {
    const std::size_t chunks = (surface_.costs.size() + kEdges * 4 - 1) / (kEdges * 4);
    std::vector<Costs> counts(chunks);
    parallel_for(surface_.costs.size(), kEdges * 4, run_, [&](std::size_t begin, std::size_t end) {
      Costs& count = counts[begin / (kEdges * 4)];
      for (std::size_t i = begin; i < end; ++i) count.add(surface_.costs[i]);
    });
    if (counts.empty()) return false;
    for (std::size_t i = 1; i < chunks; ++i) counts[0].add(counts[i]);
    const std::size_t total = counts[0].total();
    if (total == 0) return false;
    const std::size_t needed = std::max(kFewest, (surface_.faces - target_ + 1) / 2 * kPerNeeded);
    const auto share = static_cast<std::size_t>(kShare * static_cast<double>(surface_.faces) * 1.5);
    const std::size_t last = counts[0].last_bin(std::min({total, needed, share + 1}));

    const std::size_t pieces = (surface_.costs.size() + kEdges - 1) / kEdges;
    std::vector<Array<std::uint32_t>> found(pieces);
    parallel_for(surface_.costs.size(), kEdges, run_, [&](std::size_t begin, std::size_t end) {
      Array<std::uint32_t> here(end - begin);
      std::size_t count = 0;
      for (std::size_t i = begin; i < end; ++i) {
        here[count] = static_cast<std::uint32_t>(i);
        count += Costs::bin(surface_.costs[i]) <= last ? 1 : 0;
      }
      here.resize(count);
      found[begin / kEdges] = std::move(here);
    });
    // By doublings of the cost, in which they are in the order of the surface.
    std::vector<std::size_t> first = counts[0].firsts(last);
    candidates_.resize(first.back());
    for (const Array<std::uint32_t>& each : found) {
      for (const std::uint32_t edge : each) candidates_[first[Costs::bin(surface_.costs[edge]) / 4]++] = edge;
    }
    return true;
  }

  /// Of the candidates, the cheapest first, those that are apart: no vertices of two are the same or neighbors.
  void choose() {
    chosen_.clear();
    ++round_;
    const auto blocked = [&](const std::array<std::uint32_t, 2>& ends) {
      return blocked_[ends[0]] == round_ || blocked_[ends[1]] == round_;
    };
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      const std::uint32_t edge = candidates_[i];
      fetch(std::span(candidates_).subspan(i), kAheadOfChoice, blocked);
      if (blocked(surface_.ends[edge])) continue;
      const auto [a, b] = surface_.ends[edge];
      chosen_.push_back(edge);
      for (const std::uint32_t vertex : {a, b}) {
        surface_.each_corner(vertex, [&](std::uint32_t corner) {
          blocked_[surface_.corners[next_of(corner)]] = round_;
          blocked_[surface_.corners[previous_of(corner)]] = round_;
        });
      }
    }
  }

  void do_chosen() {
    // In the order of the surface, what is near lies near in memory.
    parallel_sort(chosen_.begin(), chosen_.end(), run_);
    collapses_.assign(chosen_.size(), Collapse());
    std::size_t room = surface_.stars.size();
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      collapses_[i].edge = chosen_[i];
      collapses_[i].star_first = static_cast<std::uint32_t>(room);
      for (const std::uint32_t end : surface_.ends[chosen_[i]]) room += surface_.vertices[end].star_size;
    }
    surface_.stars.resize(room);
    // Where all of them can't be too many, each is done while what it needs is in the cache.
    const std::size_t most = chosen_.size() * (options_.keep_topology ? 2 : kMostWings);
    const bool all = surface_.faces >= target_ + most;
    parallel_for(collapses_.size(), kCandidates, run_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const std::span<const std::uint32_t> next = std::span(chosen_).subspan(i, end - i);
        fetch(next, kAheadOfCollapse, [](const auto&) { return false; });
        fetch_around(next);
        collapses_[i].plan = planner_.plan(collapses_[i].edge);
        check_collapse(surface_, options_.keep_topology, collapses_[i]);
        if (all && collapses_[i].legal) apply(collapses_[i]);
      }
    });
    for (const Collapse& collapse : collapses_) {
      if (collapse.legal) continue;
      surface_.costs[collapse.edge] = std::numeric_limits<float>::infinity();
      refused_.push_back({collapse.edge, round_});
    }
    collapses_.erase(
        std::remove_if(collapses_.begin(), collapses_.end(), [](const Collapse& collapse) { return !collapse.legal; }),
        collapses_.end());
    if (!all) {
      leave_out();
      each_collapse([&](Collapse& collapse) { apply(collapse); });
    }
    if (values_in_cost()) {
      each_collapse([&](const Collapse& collapse) { renew_costs(collapse.plan.kept); });
    }
    for (const Collapse& collapse : collapses_) {
      surface_.faces -= collapse.removed;
      if (collapse.plan.weight > 0) largest_ = std::max(largest_, collapse.plan.cost / collapse.plan.weight);
    }
    retry();
    if (6 * surface_.faces < surface_.corners.size()) {
      compact();
    } else if (surface_.stars.size() > 12 * surface_.faces + (std::size_t{1} << 22)) {
      renew_stars(surface_);
    }
  }

  /// What was refused may be possible once something around it has changed.
  void retry() {
    refused_.erase(std::remove_if(refused_.begin(), refused_.end(),
                                  [&](const Refused& refused) {
                                    const auto [a, b] = surface_.ends[refused.edge];
                                    if (a == kNone) return true;
                                    if (changed_[a] < refused.round && changed_[b] < refused.round) return false;
                                    surface_.costs[refused.edge] = planner_.cost(refused.edge);
                                    return true;
                                  }),
                   refused_.end());
  }

  /// The cheapest that suffice.
  void leave_out() {
    std::size_t removed = 0;
    for (const Collapse& collapse : collapses_) removed += collapse.removed;
    if (surface_.faces - std::min(removed, surface_.faces) >= target_) return;
    std::sort(collapses_.begin(), collapses_.end(), [&](const Collapse& a, const Collapse& b) {
      const float cost_a = surface_.costs[a.edge];
      const float cost_b = surface_.costs[b.edge];
      return cost_a != cost_b ? cost_a < cost_b : a.edge < b.edge;
    });
    std::size_t count = 0;
    for (std::size_t left = surface_.faces; left > target_; ++count) {
      left -= std::min<std::size_t>(left, collapses_[count].removed);
    }
    collapses_.resize(count);
  }

  /// Asks memory for the faces at edges that come next, step by step: what one step reads, an earlier one has asked for.
  /// Always inline, without lambdas: GCC leaves out calls of functions that do nothing else.
  template <class IsSkipped>
  [[gnu::always_inline]] void fetch(std::span<const std::uint32_t> next, std::size_t ahead,
                                    IsSkipped is_skipped) const {
    if (next.size() <= 3 * ahead) return;
    const auto& ends = surface_.ends;
    __builtin_prefetch(&ends[next[3 * ahead]]);
    if (!is_skipped(ends[next[2 * ahead]])) {
      for (const std::uint32_t end : ends[next[2 * ahead]]) __builtin_prefetch(&surface_.vertices[end]);
    }
    if (!is_skipped(ends[next[ahead]])) {
      for (const std::uint32_t end : ends[next[ahead]]) {
        __builtin_prefetch(surface_.stars.data() + surface_.vertices[end].star_first);
      }
    }
    if (is_skipped(ends[next[ahead / 2]])) return;
    for (const std::uint32_t end : ends[next[ahead / 2]]) {
      for (const std::uint32_t corner : surface_.star(end)) __builtin_prefetch(&surface_.corners[corner]);
    }
  }

  /// And what a collapse needs beside the faces.
  [[gnu::always_inline]] void fetch_around(std::span<const std::uint32_t> next) const {
    if (next.size() <= kAheadOfCollapse / 2) return;
    for (const std::uint32_t end : surface_.ends[next[kAheadOfCollapse / 2]]) {
      for (const std::uint32_t corner : surface_.star(end)) __builtin_prefetch(&surface_.edge_of_corner[corner]);
    }
    for (const std::uint32_t end : surface_.ends[next[kAheadOfCollapse / 4]]) {
      for (const std::uint32_t corner : surface_.star(end)) {
        if (surface_.gone(corner)) continue;
        __builtin_prefetch(&surface_.vertices[surface_.corners[next_of(corner)]]);
        __builtin_prefetch(&surface_.ends[surface_.edge_of_corner[corner]]);
        __builtin_prefetch(&surface_.costs[surface_.edge_of_corner[corner]]);
      }
    }
  }

  template <class F>
  void each_collapse(F f) {
    parallel_for(collapses_.size(), kCandidates, run_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) f(collapses_[i]);
    });
  }

  /// Whether costs depend on the faces around neighbors, not only on the neighbors: they are found when all is done.
  bool values_in_cost() const { return surface_.values.in_metric() && !surface_.wedges.empty(); }

  void apply(Collapse& collapse) {
    collapse.removed = apply_collapse(surface_, options_.keep_topology, collapse);
    if (!values_in_cost()) renew_costs(collapse.plan.kept);
  }

  void renew_costs(std::uint32_t vertex) {
    surface_.each_corner(vertex, [&](std::uint32_t corner) {
      const std::uint32_t edge = surface_.edge_of_corner[corner];
      surface_.costs[edge] = planner_.cost(edge);
      const std::uint32_t before = surface_.edge_of_corner[previous_of(corner)];
      if ((surface_.flags[before] & (kBorder | kOdd)) != 0) surface_.costs[before] = planner_.cost(before);
      for (const std::uint32_t each : {corner, next_of(corner), previous_of(corner)}) {
        std::atomic_ref(changed_[surface_.corners[each]]).store(round_, std::memory_order_relaxed);
      }
    });
  }

  void compact() {
    const Array<std::uint32_t> edges = decimation::compact(surface_);
    for (Refused& refused : refused_) refused.edge = edges[refused.edge];
    refused_.erase(
        std::remove_if(refused_.begin(), refused_.end(), [](const Refused& refused) { return refused.edge == kNone; }),
        refused_.end());
  }

  Surface& surface_;
  const DecimateOptions& options_;
  Planner planner_;
  std::size_t target_;
  const Run& run_;
  Array<std::uint32_t> blocked_;  ///< of each vertex, in which round it last was at a collapse or beside one
  struct Refused {
    std::uint32_t edge;
    std::uint32_t round;
  };
  std::vector<Refused> refused_;
  Array<std::uint32_t> changed_;  ///< of each vertex: after which round the faces around it were others
  std::uint32_t round_ = 0;
  std::vector<std::uint32_t> candidates_;
  std::vector<std::uint32_t> chosen_;
  std::vector<Collapse> collapses_;
  double largest_ = 0;  ///< squared error
};

}  // namespace

Reached collapse_edges(Surface& surface, const DecimateOptions& options, std::size_t target, const Run& run) {
  return Rounds(surface, options, target, run).run();
}

}  // namespace azulejo::decimation
