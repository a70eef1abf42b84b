#include "azulejo/modelling/plane_graph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace azulejo::plane {
namespace {

/// A point's place in the order of the sweep, and its index.
struct Keyed {
  std::uint64_t key;
  std::uint32_t index;
};

constexpr int kCoordinateBits = 26;

std::uint64_t key_of(const GridPoint& point) {
  const auto lift = [](std::int32_t value) { return static_cast<std::uint64_t>(value + (1 << (kCoordinateBits - 1))); };
  return lift(point.x) << kCoordinateBits | lift(point.y);
}

/// Sorts by key, least significant digits first; digits that are the same in all keys cost nothing.
void sort_keys(Array<Keyed>& keys) {
  constexpr int kDigitBits = 11;
  constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;
  constexpr int kPasses = (2 * kCoordinateBits + kDigitBits - 1) / kDigitBits;
  if (keys.size() < kDigits) {
    std::sort(keys.begin(), keys.end(), [](const Keyed& a, const Keyed& b) { return a.key < b.key; });
    return;
  }
  std::vector<std::array<std::uint32_t, kDigits>> counts(kPasses);
  const auto digit = [](std::uint64_t key, int pass) {
    return static_cast<std::size_t>(key >> (pass * kDigitBits)) & (kDigits - 1);
  };
  for (const Keyed& each : keys) {
    for (int pass = 0; pass < kPasses; ++pass) ++counts[static_cast<std::size_t>(pass)][digit(each.key, pass)];
  }
  Array<Keyed> other(keys.size());
  for (int pass = 0; pass < kPasses; ++pass) {
    std::array<std::uint32_t, kDigits>& count = counts[static_cast<std::size_t>(pass)];
    if (count[digit(keys.front().key, pass)] == keys.size()) continue;
    std::uint32_t begin = 0;
    for (std::uint32_t& each : count) begin += std::exchange(each, begin);
    for (const Keyed& each : keys) other[count[digit(each.key, pass)]++] = each;
    keys.swap(other);
  }
}

/// Sorts the edges by their lower point, joins those with the same ends, and fills in `first_edge`.
void arrange_edges(Graph& graph, const Array<Edge>& edges) {
  const std::size_t count = graph.points.size();
  graph.first_edge.assign(count + 1, 0);
  for (const Edge& edge : edges) ++graph.first_edge[edge.low + 1];
  for (std::size_t i = 0; i < count; ++i) graph.first_edge[i + 1] += graph.first_edge[i];
  graph.edges.resize(edges.size());
  for (const Edge& edge : edges) graph.edges[graph.first_edge[edge.low]++] = edge;
  // first_edge[i] is now where the edges of i end; they are joined towards the front.
  std::uint32_t begin = 0;
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t end = graph.first_edge[i];
    graph.first_edge[i] = kept;
    if (end - begin > 1) {
      std::sort(graph.edges.begin() + begin, graph.edges.begin() + end,
                [](const Edge& a, const Edge& b) { return a.high < b.high; });
    }
    while (begin < end) {
      Edge joined = graph.edges[begin++];
      for (; begin < end && graph.edges[begin].high == joined.high; ++begin) {
        joined.winding = joined.winding + graph.edges[begin].winding;
      }
      if (joined.winding != Winding()) graph.edges[kept++] = joined;
    }
  }
  graph.first_edge[count] = kept;
  graph.edges.resize(kept);
}

}  // namespace

Grid::Grid(float largest) {
  int exponent = 0;
  std::frexp(largest > 0 ? largest : 1.0F, &exponent);  // largest < 2^exponent
  step_ = std::ldexp(1.0, exponent - 24);
  scale_ = std::ldexp(1.0, 24 - exponent);
}

GridPoint Grid::snap(const glm::vec2& point) const {
  return {static_cast<std::int32_t>(std::lrint(static_cast<double>(point.x) * scale_)),
          static_cast<std::int32_t>(std::lrint(static_cast<double>(point.y) * scale_))};
}

glm::vec2 Grid::place(const GridPoint& point) const {
  return {static_cast<float>(point.x * step_), static_cast<float>(point.y * step_)};
}

Graph make_graph(std::span<const GridPoint> points, std::span<const Segment> segments) {
  Array<Keyed> keys(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) keys[i] = {key_of(points[i]), static_cast<std::uint32_t>(i)};
  sort_keys(keys);
  Graph graph;
  graph.points.reserve(points.size());
  Array<std::uint32_t> rank(points.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (i == 0 || keys[i].key != keys[i - 1].key) graph.points.push_back(points[keys[i].index]);
    rank[keys[i].index] = static_cast<std::uint32_t>(graph.points.size() - 1);
  }
  Array<Edge> edges;
  edges.reserve(segments.size());
  for (const Segment& segment : segments) {
    const std::uint32_t from = rank[segment.from];
    const std::uint32_t to = rank[segment.to];
    // Left of a line that goes to the right is above it.
    if (from < to) edges.push_back({from, to, segment.winding});
    if (from > to) edges.push_back({to, from, -segment.winding});
  }
  arrange_edges(graph, edges);
  return graph;
}

Graph with_edges(Graph graph, const Array<Edge>& edges) {
  arrange_edges(graph, edges);
  return graph;
}

}  // namespace azulejo::plane
