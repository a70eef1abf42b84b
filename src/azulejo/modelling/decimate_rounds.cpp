#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
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

/// How many edges cost about how much: bins are quarters of a doubling.
class Costs {
 public:
  static constexpr std::size_t kBins = std::size_t{1} << 10;
  static std::size_t bin(float cost) { return std::bit_cast<std::uint32_t>(cost) >> 21; }  // not negative: 10 bits

  void add(float cost) { ++counts_[bin(cost)]; }
  void add(const Costs& other) {
    for (std::size_t i = 0; i < kBins; ++i) counts_[i] += other.counts_[i];
  }
  /// The first bin by which there are as many edges.
  std::size_t last_bin(std::size_t wanted) const {
    std::size_t sum = 0;
    for (std::size_t i = 0; i < kBins; ++i) {
      sum += counts_[i];
      if (sum >= wanted) return i;
    }
    return kBins - 1;
  }
  /// Where each four bins begin, up to the end of `last`.
  std::vector<std::size_t> firsts(std::size_t last) const {
    std::vector<std::size_t> first(last / 4 + 2, 0);
    for (std::size_t i = 0; i <= last; ++i) first[i / 4 + 1] += counts_[i];
    for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
    return first;
  }
  std::size_t total() const {
    std::size_t sum = 0;
    for (const std::uint32_t count : counts_) sum += count;
    return sum;
  }

 private:
  std::array<std::uint32_t, kBins> counts_{};
};

class Rounds {
 public:
  Rounds(Surface& surface, const DecimateOptions& options, std::size_t target, const Run& run)
      : surface_(surface), options_(options), planner_(surface, options), target_(target), run_(run) {}

  Reached run() {
    edges_.resize(surface_.ends.size());
    for (std::size_t e = 0; e < edges_.size(); ++e) edges_[e] = static_cast<std::uint32_t>(e);
    blocked_.assign(surface_.positions.size(), 0);
    changed_.assign(surface_.positions.size(), 0);
    surface_.costs.resize(edges_.size());
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
      renew_stars();
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
    parallel_for(edges_.size(), kEdges / 8, run_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) surface_.costs[edges_[i]] = planner_.cost(edges_[i]);
    });
  }

  /// Whether an edge is left that only `error` keeps from collapsing.
  bool stopped_by_error() const {
    if (!options_.error) return false;
    return std::any_of(edges_.begin(), edges_.end(), [&](std::uint32_t edge) {
      const Plan plan = planner_.plan(edge);
      return std::isfinite(plan.cost) && !std::isfinite(planner_.cost(edge));
    });
  }

  /// The cheapest edges that can collapse; false: none.
  bool choose_candidates() {
    const std::size_t chunks = (edges_.size() + kEdges * 4 - 1) / (kEdges * 4);
    std::vector<Costs> counts(chunks);
    parallel_for(edges_.size(), kEdges * 4, run_, [&](std::size_t begin, std::size_t end) {
      Costs& count = counts[begin / (kEdges * 4)];
      for (std::size_t i = begin; i < end; ++i) {
        const float cost = surface_.costs[edges_[i]];
        if (cost < std::numeric_limits<float>::infinity()) count.add(cost);
      }
    });
    if (counts.empty()) return false;
    for (std::size_t i = 1; i < chunks; ++i) counts[0].add(counts[i]);
    const std::size_t total = counts[0].total();
    if (total == 0) return false;
    const std::size_t needed = std::max(kFewest, (surface_.faces - target_ + 1) / 2 * kPerNeeded);
    const auto share = static_cast<std::size_t>(kShare * static_cast<double>(surface_.faces) * 1.5);
    const std::size_t last = counts[0].last_bin(std::min({total, needed, share + 1}));

    const std::size_t pieces = (edges_.size() + kEdges - 1) / kEdges;
    std::vector<std::vector<std::uint32_t>> found(pieces);
    parallel_for(edges_.size(), kEdges, run_, [&](std::size_t begin, std::size_t end) {
      std::vector<std::uint32_t>& here = found[begin / kEdges];
      for (std::size_t i = begin; i < end; ++i) {
        const float cost = surface_.costs[edges_[i]];
        if (cost < std::numeric_limits<float>::infinity() && Costs::bin(cost) <= last) here.push_back(edges_[i]);
      }
    });
    // By doublings of the cost, in which they are in the order of the surface.
    std::vector<std::size_t> first = counts[0].firsts(last);
    candidates_.resize(first.back());
    for (const std::vector<std::uint32_t>& each : found) {
      for (const std::uint32_t edge : each) candidates_[first[Costs::bin(surface_.costs[edge]) / 4]++] = edge;
    }
    if (surface_.faces * 2 < edges_.size()) {  // of a surface there are 1.5 edges a face
      edges_.erase(std::remove_if(edges_.begin(), edges_.end(),
                                  [&](std::uint32_t edge) { return surface_.ends[edge][0] == kNone; }),
                   edges_.end());
    }
    return true;
  }

  /// Of the candidates, the cheapest first, those that are apart: no vertices of two are the same or neighbors.
  void choose() {
    chosen_.clear();
    ++round_;
    for (const std::uint32_t edge : candidates_) {
      const auto [a, b] = surface_.ends[edge];
      if (blocked_[a] == round_ || blocked_[b] == round_) continue;
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
    const std::size_t pieces = (chosen_.size() + kCandidates - 1) / kCandidates;
    std::vector<std::vector<Collapse>> found(pieces);
    parallel_for(chosen_.size(), kCandidates, run_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        Collapse collapse;
        collapse.edge = chosen_[i];
        collapse.plan = planner_.plan(collapse.edge);
        check_collapse(surface_, options_.keep_topology, collapse);
        found[begin / kCandidates].push_back(collapse);
      }
    });
    collapses_.clear();
    for (const std::vector<Collapse>& each : found) {
      for (const Collapse& collapse : each) {
        if (collapse.legal) {
          collapses_.push_back(collapse);
        } else {
          surface_.costs[collapse.edge] = std::numeric_limits<float>::infinity();
          refused_.push_back({collapse.edge, round_});
        }
      }
    }
    leave_out();
    apply();
    retry();
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

  void apply() {
    std::size_t room = surface_.stars.size();
    for (Collapse& collapse : collapses_) {
      collapse.star_first = static_cast<std::uint32_t>(room);
      room += collapse.star_size;
      if (collapse.plan.weight > 0) largest_ = std::max(largest_, collapse.plan.cost / collapse.plan.weight);
    }
    surface_.stars.resize(room);
    surface_.faces -= parallel_reduce(
        collapses_.size(), kCandidates, run_, std::size_t{0},
        [&](std::size_t begin, std::size_t end) {
          std::size_t removed = 0;
          for (std::size_t i = begin; i < end; ++i) {
            removed += apply_collapse(surface_, options_.keep_topology, collapses_[i]);
          }
          return removed;
        },
        [](std::size_t a, std::size_t b) { return a + b; });
    parallel_for(collapses_.size(), kCandidates, run_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        surface_.each_corner(collapses_[i].plan.kept, [&](std::uint32_t corner) {
          const std::uint32_t edge = surface_.edge_of_corner[corner];
          surface_.costs[edge] = planner_.cost(edge);
          const std::uint32_t before = surface_.edge_of_corner[previous_of(corner)];
          if ((surface_.flags[before] & (kBorder | kOdd)) != 0) surface_.costs[before] = planner_.cost(before);
          for (const std::uint32_t each : {corner, next_of(corner), previous_of(corner)}) {
            std::atomic_ref(changed_[surface_.corners[each]]).store(round_, std::memory_order_relaxed);
          }
        });
      }
    });
    if (surface_.stars.size() > 12 * surface_.faces + (std::size_t{1} << 22)) renew_stars();
  }

  /// Without corners that are gone, one after another.
  void renew_stars() {
    Array<std::uint32_t> stars;
    stars.reserve(3 * surface_.faces);
    for (std::uint32_t v = 0; v < surface_.star_first.size(); ++v) {
      const auto first = static_cast<std::uint32_t>(stars.size());
      surface_.each_corner(v, [&](std::uint32_t corner) { stars.push_back(corner); });
      surface_.star_first[v] = first;
      surface_.star_size[v] = static_cast<std::uint32_t>(stars.size()) - first;
    }
    surface_.stars = std::move(stars);
  }

  Surface& surface_;
  const DecimateOptions& options_;
  Planner planner_;
  std::size_t target_;
  const Run& run_;
  Array<std::uint32_t> edges_;    ///< those that are looked at
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
