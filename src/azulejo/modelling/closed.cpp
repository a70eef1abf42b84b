#include "azulejo/modelling/closed.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "azulejo/core/parallel.h"
#include "azulejo/io/weld.h"

namespace azulejo {
namespace {

constexpr std::size_t kVertices = std::size_t{1} << 14;  ///< of one task

/// Calls f(from, to) along each face, in vertices of `welded`.
template <class F>
void for_each_half_edge(const Mesh& mesh, const Array<std::uint32_t>& welded, F f) {
  const std::uint32_t* const corners = mesh.corners.data();
  for (std::size_t face = 0; face < mesh.face_count(); ++face) {
    const std::size_t begin = mesh.face_begin(face);
    const std::size_t end = mesh.face_end(face);
    std::size_t edges = 0;
    for (std::size_t i = begin; i < end; ++i) {
      edges += welded[corners[i]] != welded[corners[i + 1 == end ? begin : i + 1]] ? 1 : 0;
    }
    if (edges < 3) continue;
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t from = welded[corners[i]];
      const std::uint32_t to = welded[corners[i + 1 == end ? begin : i + 1]];
      if (from != to) f(from, to);
    }
  }
}

/// The faces along each edge, listed at the edge's lower vertex: its other vertex · 2 + direction.
class EdgeLists {
 public:
  EdgeLists(const Mesh& mesh, const Array<std::uint32_t>& welded, std::size_t vertices) : starts_(vertices + 1, 0) {
    for_each_half_edge(mesh, welded, [&](std::uint32_t from, std::uint32_t to) { ++starts_[std::min(from, to)]; });
    std::uint32_t total = 0;
    for (std::uint32_t& each : starts_) total += std::exchange(each, total);
    uses_.resize(total);
    for_each_half_edge(mesh, welded, [&](std::uint32_t from, std::uint32_t to) {
      const auto [low, high] = std::minmax(from, to);
      uses_[starts_[low]++] = std::uint64_t{high} << 1 | (from == high ? 1U : 0U);
    });
    // Each start has moved to the next one's place.
    std::move_backward(starts_.begin(), starts_.end() - 1, starts_.end());
    starts_[0] = 0;
  }

  EdgeCounts count_at(std::size_t vertex) {
    std::uint64_t* const begin = uses_.data() + starts_[vertex];
    std::uint64_t* const end = uses_.data() + starts_[vertex + 1];
    std::sort(begin, end);
    EdgeCounts counts;
    for (const std::uint64_t* first = begin; first != end;) {
      const std::uint64_t* last = first + 1;
      while (last != end && *last >> 1 == *first >> 1) ++last;
      ++counts.edges;
      counts.border += last - first == 1 ? 1 : 0;
      counts.turned += last - first == 2 && first[0] == first[1] ? 1 : 0;
      counts.crowded += last - first > 2 ? 1 : 0;
      first = last;
    }
    return counts;
  }

 private:
  Array<std::uint32_t> starts_;
  Array<std::uint64_t> uses_;
};

EdgeCounts sum(const EdgeCounts& a, const EdgeCounts& b) {
  return {a.edges + b.edges, a.border + b.border, a.turned + b.turned, a.crowded + b.crowded};
}

}  // namespace

EdgeCounts count_edges(const Mesh& mesh, const Run& run) {
  if (mesh.corners.empty()) return {};
  Array<std::uint32_t> welded;
  std::size_t vertices = 0;
  {
    Welded positions = weld_exactly(mesh.positions, run);
    vertices = positions.positions.size();
    welded = std::move(positions.corners);
  }
  EdgeLists lists(mesh, welded, vertices);
  return parallel_reduce(
      vertices, kVertices, run, EdgeCounts(),
      [&](std::size_t begin, std::size_t end) {
        EdgeCounts counts;
        for (std::size_t vertex = begin; vertex < end; ++vertex) counts = sum(counts, lists.count_at(vertex));
        return counts;
      },
      sum);
}

bool is_closed(const Mesh& mesh, const Run& run) { return count_edges(mesh, run).closed(); }

}  // namespace azulejo
