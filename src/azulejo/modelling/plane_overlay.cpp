#include "azulejo/modelling/plane_overlay.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "azulejo/core/error.h"
#include "azulejo/modelling/plane_noding.h"
#include "azulejo/modelling/plane_sweep.h"

namespace azulejo::plane {
namespace {

/// Keeps the edges between inside and outside.
class OutlineVisitor {
 public:
  OutlineVisitor(Inside rule, Array<Edge>& edges) : rule_(rule), edges_(edges) {}
  bool filled(const Winding&) const { return false; }
  bool edge(const Edge& edge, const Winding& below, const Winding& above) const {
    const bool inside_below = is_inside(rule_, below);
    const bool inside_above = is_inside(rule_, above);
    if (inside_below != inside_above) edges_.push_back({edge.low, edge.high, {inside_above ? 1 : -1, 0}});
    return true;
  }
  // Gaps are never of interest.
  std::uint32_t add_above(std::uint32_t, std::uint32_t) const { return kNone; }
  std::uint32_t add_below(std::uint32_t, std::uint32_t) const { return kNone; }
  void close(std::uint32_t, std::uint32_t) const {}
  std::pair<std::uint32_t, std::uint32_t> split(std::uint32_t, std::uint32_t) const { return {kNone, kNone}; }
  std::uint32_t open(std::uint32_t) const { return kNone; }
  std::uint32_t join(std::uint32_t, std::uint32_t, std::uint32_t) const { return kNone; }

 private:
  Inside rule_;
  Array<Edge>& edges_;
};

/// Edges of an outline as they are walked: the inside to the left.
class RingTracer {
 public:
  explicit RingTracer(const Graph& graph) : graph_(graph) {
    const std::size_t count = graph.points.size();
    first_.assign(count + 1, 0);
    for (const Edge& edge : graph.edges) ++first_[from(edge) + 1];
    for (std::size_t i = 0; i < count; ++i) first_[i + 1] += first_[i];
    targets_.resize(graph.edges.size());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (const Edge& edge : graph.edges) targets_[next[from(edge)]++] = to(edge);
    used_.assign(graph.edges.size(), 0);
    place_.assign(count, kNone);
  }

  /// Calls `ring` with the points of each ring, which are all different.
  template <class Ring>
  void trace(Ring ring) {
    for (std::uint32_t start = 0; start + 1 < first_.size(); ++start) {
      for (std::uint32_t e = first_[start]; e < first_[start + 1]; ++e) {
        if (used_[e] == 0) walk(start, e, ring);
      }
    }
  }

 private:
  static std::uint32_t from(const Edge& edge) { return edge.winding.a > 0 ? edge.low : edge.high; }
  static std::uint32_t to(const Edge& edge) { return edge.winding.a > 0 ? edge.high : edge.low; }

  template <class Ring>
  void walk(std::uint32_t start, std::uint32_t edge, Ring ring) {
    path_.clear();
    std::uint32_t at = start;
    while (true) {
      place_[at] = static_cast<std::uint32_t>(path_.size());
      path_.push_back(at);
      used_[edge] = 1;
      const std::uint32_t before = at;
      at = targets_[edge];
      const std::uint32_t begin = place_[at];
      if (begin != kNone) {
        // Back at a point of the path: what lies between is a ring of its own.
        ring(std::span(path_).subspan(begin));
        for (std::size_t i = begin; i < path_.size(); ++i) place_[path_[i]] = kNone;
        path_.resize(begin);
        if (path_.empty() && at == start) return;
      }
      edge = next_edge(before, at);
      if (edge == kNone) return;
    }
  }

  /// The edge from `at` that comes first clockwise from the one back to `before`: the other side of the inside there.
  std::uint32_t next_edge(std::uint32_t before, std::uint32_t at) const {
    std::uint32_t best = kNone;
    for (std::uint32_t e = first_[at]; e < first_[at + 1]; ++e) {
      if (used_[e] == 0 && (best == kNone || comes_before(at, before, targets_[e], targets_[best]))) best = e;
    }
    return best;
  }
  /// Whether a comes before b when turning clockwise around a point from `reference`.
  bool comes_before(std::uint32_t center, std::uint32_t reference, std::uint32_t a, std::uint32_t b) const {
    const GridPoint& o = graph_.points[center];
    const GridPoint& r = graph_.points[reference];
    const std::int64_t side_a = turn(o, r, graph_.points[a]);
    const std::int64_t side_b = turn(o, r, graph_.points[b]);
    const bool near_a = side_a < 0;  // within half a turn; straight ahead is the last of it, and counted with the rest
    const bool near_b = side_b < 0;
    if (near_a != near_b) return near_a;
    return turn(o, graph_.points[a], graph_.points[b]) < 0;
  }

  const Graph& graph_;
  std::vector<std::uint32_t> first_;    ///< of each point, into targets_
  std::vector<std::uint32_t> targets_;  ///< of the edges
  std::vector<std::uint8_t> used_;
  std::vector<std::uint32_t> place_;  ///< of each point in the path
  std::vector<std::uint32_t> path_;
};

[[noreturn]] void fail() { throw Error(Error::Data, "polygon: edges cross after they were separated"); }

Sweep find_outline(const Graph& graph, Inside rule, Array<Edge>& edges) {
  edges.clear();
  OutlineVisitor visitor(rule, edges);
  return PlaneSweep(graph, visitor).run();
}

}  // namespace

void GraphBuilder::close_ring(std::uint32_t first, const Winding& winding) {
  const auto end = static_cast<std::uint32_t>(points_.size());
  for (std::uint32_t i = first; i < end; ++i) segments_.push_back({i, i + 1 == end ? first : i + 1, winding});
}

void GraphBuilder::add(std::span<const glm::vec2> ring, const Winding& winding) {
  const auto first = static_cast<std::uint32_t>(points_.size());
  for (const glm::vec2& point : ring) {
    if (std::isfinite(point.x) && std::isfinite(point.y)) points_.push_back(grid_.snap(point));
  }
  close_ring(first, winding);
}

void GraphBuilder::add(std::span<const GridPoint> ring, const Winding& winding) {
  const auto first = static_cast<std::uint32_t>(points_.size());
  points_.insert(points_.end(), ring.begin(), ring.end());
  close_ring(first, winding);
}

void GraphBuilder::add(const Polygon& polygon, const Winding& winding) {
  for (std::size_t r = 0; r < polygon.ring_count(); ++r) add(polygon.ring(r), winding);
}

float largest_coordinate(const Polygon& polygon) {
  float largest = 0;
  for (const glm::vec2& point : polygon.points) {
    const float size = std::max(std::abs(point.x), std::abs(point.y));
    if (std::isfinite(point.x) && std::isfinite(point.y)) largest = std::max(largest, size);
  }
  return largest;
}

Graph outline(Graph graph, Inside rule, const Run& run) {
  Array<Edge> edges;
  if (find_outline(graph, rule, edges) == Sweep::Crossed) {
    graph = snap_rounded(graph, run);
    if (find_outline(graph, rule, edges) == Sweep::Crossed) fail();
  }
  return with_edges(std::move(graph), edges);
}

Polygon rings_of(const Graph& outline, const Grid& grid) {
  Polygon polygon;
  RingTracer(outline).trace([&](std::span<const std::uint32_t> ring) {
    polygon.ring_begins.push_back(static_cast<std::uint32_t>(polygon.points.size()));
    for (const std::uint32_t point : ring) polygon.points.push_back(grid.place(outline.points[point]));
  });
  return polygon;
}

Triangles triangles_of(Graph graph, Inside rule, const Run& run,
                       const std::function<void(const Graph& graph, const MonotonePiece& piece)>& on_piece) {
  Triangles result{std::move(graph), {}};
  result.corners.reserve(3 * result.graph.edges.size());
  std::vector<MonotonePiece> pieces;
  const auto sweep = [&](Inside inside) {
    result.corners.clear();
    pieces.clear();
    Triangulator triangulator(result.graph, inside, result.corners);
    if (on_piece) triangulator.on_piece = [&](const MonotonePiece& piece) { pieces.push_back(piece); };
    return PlaneSweep(result.graph, triangulator).run();
  };
  // Most polygons need nothing else; others are made so that they don't.
  if (sweep(rule) != Sweep::Done) {
    result.graph = outline(std::move(result.graph), rule, run);
    if (sweep(Inside::NonZero) != Sweep::Done) fail();
  }
  for (const MonotonePiece& piece : pieces) on_piece(result.graph, piece);
  return result;
}

}  // namespace azulejo::plane
