#pragma once

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <vector>

#include "azulejo/modelling/plane_graph.h"
#include "azulejo/modelling/sweep_line.h"

namespace azulejo::plane {

inline constexpr std::uint32_t kNone = 0xFFFFFFFF;

enum class Sweep : std::uint8_t {
  Done,
  Crossed,  ///< edges meet elsewhere than at their ends
  Refused,  ///< by the visitor
};

/// Sweeps a line over a graph to the right and tells a visitor what it meets. The areas between neighbouring edges are
/// gaps; each carries a number of the visitor's. At a point, in this order:
///
///   bool filled(const Winding&)            whether gaps of this winding matter; for others nothing of the below is called
///   uint32 add_above(gap, point)           the point is the next one of the edges above a gap, of those below:
///   uint32 add_below(gap, point)           the gap as it goes on
///   void close(gap, point)                 where the edges around a gap meet
///   pair<uint32, uint32> split(gap, point) edges begin inside a gap: its parts below and above
///   uint32 open(point)                     a gap begins between two edges that do
///   uint32 join(below, above, point)       edges end, and the gaps below and above are one
///   bool edge(const Edge&, below, above)   an edge begins, with the windings of both sides; false: the sweep is over
///
/// Every two edges are compared when they become neighbours: if any two meet elsewhere than at their ends, it is noticed
/// (M. I. Shamos, D. Hoey, Geometric intersection problems, 1976). Cost O(n log n).
template <class Visitor>
class PlaneSweep {
 public:
  PlaneSweep(const Graph& graph, Visitor& visitor) : graph_(graph), visitor_(visitor) {}

  Sweep run() {
    line_.clear();
    node_at_.assign(graph_.points.size(), kNone);
    ending_.assign(graph_.points.size(), 0);
    for (const Edge& edge : graph_.edges) ++ending_[edge.high];
    for (std::uint32_t p = 0; p < graph_.points.size(); ++p) {
      if (ending_[p] == 0 && graph_.edges_of(p).empty()) continue;
      const Sweep result = visit(p);
      if (result != Sweep::Done) return result;
    }
    return Sweep::Done;
  }

 private:
  struct Crossing {
    GridPoint low;
    GridPoint high;
    std::uint32_t end = kNone;  ///< the point `high`
    Winding above;
    std::uint32_t gap = kNone;  ///< above the edge
  };
  using Line = SweepLine<Crossing>;

  static std::int64_t side(const Crossing& edge, const GridPoint& point) { return turn(edge.low, edge.high, point); }

  Sweep visit(std::uint32_t p) {
    const GridPoint& point = graph_.points[p];
    starting_.assign(graph_.edges_of(p).begin(), graph_.edges_of(p).end());
    if (starting_.size() > 1) {
      std::sort(starting_.begin(), starting_.end(), [&](const Edge& a, const Edge& b) {
        return turn(point, graph_.points[a.high], graph_.points[b.high]) > 0;
      });
    }
    std::uint32_t below = Line::kEnd;
    std::uint32_t last = Line::kEnd;  // of the edges that end here, or `below`
    if (ending_[p] > 0) {
      below = last = node_at_[p];
      std::uint32_t count = 0;
      for (; below != Line::kEnd && line_[below].end == p; below = line_.below(below)) ++count;
      for (std::uint32_t up = line_.above(last); up != Line::kEnd && line_[up].end == p; up = line_.above(up)) {
        last = up;
        ++count;
      }
      if (count != ending_[p]) return Sweep::Crossed;
    } else {
      below = last = line_.last_below([&](const Crossing& edge) { return side(edge, point) > 0; });
      const std::uint32_t above = line_.above(below);
      if (above != Line::kEnd && side(line_[above], point) == 0) return Sweep::Crossed;
    }
    leave_gaps(p, below, last);
    return enter_edges(p, below, last);
  }

  bool filled(std::uint32_t node) { return visitor_.filled(line_[node].above); }

  /// What is left of a point ends there; the gaps just below and above it go on in lower_ and upper_.
  void leave_gaps(std::uint32_t p, std::uint32_t below, std::uint32_t last) {
    lower_ = upper_ = kNone;
    if (below == last) {
      if (filled(below)) std::tie(lower_, upper_) = visitor_.split(line_[below].gap, p);
      return;
    }
    if (filled(below)) lower_ = visitor_.add_above(line_[below].gap, p);
    for (std::uint32_t inner = line_.above(below); inner != last; inner = line_.above(inner)) {
      if (filled(inner)) visitor_.close(line_[inner].gap, p);
    }
    if (filled(last)) upper_ = visitor_.add_below(line_[last].gap, p);
  }

  Sweep enter_edges(std::uint32_t p, std::uint32_t below, std::uint32_t last) {
    const std::uint32_t above = line_.above(last);
    std::uint32_t old = line_.above(below);  // nodes up to `last` are used again
    std::uint32_t place = below;
    if (starting_.empty()) {
      line_[below].gap = filled(below) ? visitor_.join(lower_, upper_, p) : kNone;
    } else {
      line_[below].gap = lower_;
    }
    for (std::size_t i = 0; i < starting_.size(); ++i) {
      const Edge& edge = starting_[i];
      if (i > 0 && turn(graph_.points[p], line_[place].high, graph_.points[edge.high]) <= 0) return Sweep::Crossed;
      Crossing crossing{graph_.points[p], graph_.points[edge.high], edge.high, line_[place].above + edge.winding,
                        kNone};
      if (!visitor_.edge(edge, line_[place].above, crossing.above)) return Sweep::Refused;
      if (i + 1 == starting_.size()) {
        crossing.gap = upper_;
      } else if (visitor_.filled(crossing.above)) {
        crossing.gap = visitor_.open(p);
      }
      if (old != above) {
        place = old;
        old = line_.above(old);
        line_[place] = crossing;
      } else {
        place = line_.insert_above(place, crossing);
      }
      node_at_[edge.high] = place;
    }
    while (old != above) {
      const std::uint32_t gone = old;
      old = line_.above(old);
      line_.erase(gone);
    }
    if (starting_.empty()) return apart(below, above) ? Sweep::Done : Sweep::Crossed;
    return apart(below, line_.above(below)) && apart(place, above) ? Sweep::Done : Sweep::Crossed;
  }

  /// Whether neighbours stay one above the other up to where the first of them ends.
  bool apart(std::uint32_t lower, std::uint32_t upper) const {
    if (lower == Line::kEnd || upper == Line::kEnd) return true;
    const Crossing& a = line_[lower];
    const Crossing& b = line_[upper];
    if (a.end == b.end) return true;
    return a.end < b.end ? side(b, a.high) < 0 : side(a, b.high) > 0;
  }

  const Graph& graph_;
  Visitor& visitor_;
  Line line_;
  Array<std::uint32_t> node_at_;  ///< of an edge that ends at a point
  Array<std::uint32_t> ending_;   ///< how many do
  std::vector<Edge> starting_;
  std::uint32_t lower_ = kNone;
  std::uint32_t upper_ = kNone;
};

}  // namespace azulejo::plane
