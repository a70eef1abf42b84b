#include "azulejo/modelling/edge_uses.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "azulejo/core/parallel.h"

namespace azulejo {
namespace {

constexpr std::size_t kFaces = std::size_t{1} << 13;     ///< of one task
constexpr std::size_t kVertices = std::size_t{1} << 13;  ///< of one task

/// Of each corner, the next one of its face that has another vertex; kNone where the face has fewer than three sides.
template <class VertexOf>
Array<std::uint32_t> next_corners(const Mesh& mesh, VertexOf vertex_of, const Run& run) {
  Array<std::uint32_t> next(mesh.corner_count());
  parallel_for(mesh.face_count(), kFaces, run, [&](std::size_t first, std::size_t last) {
    for (std::size_t face = first; face < last; ++face) {
      const std::size_t begin = mesh.face_begin(face);
      const std::size_t end = mesh.face_end(face);
      std::size_t sides = 0;
      // Of corners with one vertex in turn only the last has a side: backwards, each finds the next that has one.
      std::uint32_t following = EdgeUses::kNone;
      for (std::size_t i = begin; i < end; ++i) {
        const std::size_t after = i + 1 == end ? begin : i + 1;
        const bool side = vertex_of(i) != vertex_of(after);
        sides += side ? 1 : 0;
        if (side && following == EdgeUses::kNone) following = static_cast<std::uint32_t>(i);
      }
      for (std::size_t i = end; i-- > begin;) {
        const std::size_t after = i + 1 == end ? begin : i + 1;
        const bool side = sides >= 3 && vertex_of(i) != vertex_of(after);
        next[i] = side ? following : EdgeUses::kNone;
        if (side) following = static_cast<std::uint32_t>(i);
      }
    }
  });
  return next;
}

/// A corner at its edge's lower vertex.
struct Use {
  std::uint32_t higher;
  std::uint32_t corner;
  friend bool operator<(const Use& a, const Use& b) {
    return a.higher != b.higher ? a.higher < b.higher : a.corner < b.corner;
  }
};

template <class VertexOf>
EdgeUses edge_uses(const Mesh& mesh, std::size_t vertices, VertexOf vertex_of, const Run& run) {
  EdgeUses edges;
  edges.next = next_corners(mesh, vertex_of, run);
  const std::size_t corners = mesh.corner_count();
  const auto ends = [&](std::size_t corner) {
    const std::uint32_t a = vertex_of(corner);
    const std::uint32_t b = vertex_of(edges.next[corner]);
    return std::pair(std::min(a, b), std::max(a, b));
  };

  Array<std::uint32_t> first(vertices + 1);
  std::fill(first.begin(), first.end(), 0);
  for (std::size_t c = 0; c < corners; ++c) {
    if (edges.next[c] != EdgeUses::kNone) ++first[ends(c).first];
  }
  std::uint32_t total = 0;
  for (std::uint32_t& each : first) total += std::exchange(each, total);
  Array<Use> uses(total);
  for (std::size_t c = 0; c < corners; ++c) {
    if (edges.next[c] == EdgeUses::kNone) continue;
    const auto [low, high] = ends(c);
    uses[first[low]++] = {high, static_cast<std::uint32_t>(c)};
  }
  // Each start has moved to the next one's place.
  std::move_backward(first.begin(), first.end() - 1, first.end());
  first[0] = 0;

  const std::size_t chunks = (vertices + kVertices - 1) / kVertices;
  std::vector<std::uint32_t> first_edge(chunks + 1, 0);
  parallel_for(vertices, kVertices, run, [&](std::size_t begin, std::size_t end) {
    std::uint32_t count = 0;
    for (std::size_t v = begin; v < end; ++v) {
      std::sort(uses.begin() + first[v], uses.begin() + first[v + 1]);
      for (std::size_t u = first[v]; u < first[v + 1]; ++u) {
        count += u == first[v] || uses[u].higher != uses[u - 1].higher ? 1 : 0;
      }
    }
    first_edge[begin / kVertices] = count;
  });
  std::uint32_t count = 0;
  for (std::uint32_t& each : first_edge) count += std::exchange(each, count);

  edges.vertices.resize(count);
  edges.first_use.resize(count + 1);
  edges.first_use[count] = total;
  edges.uses.resize(total);
  edges.of_corner.resize(corners);
  std::fill(edges.of_corner.begin(), edges.of_corner.end(), EdgeUses::kNone);
  parallel_for(vertices, kVertices, run, [&](std::size_t begin, std::size_t end) {
    std::uint32_t edge = first_edge[begin / kVertices] - 1;
    for (std::size_t v = begin; v < end; ++v) {
      for (std::uint32_t u = first[v]; u < first[v + 1]; ++u) {
        if (u == first[v] || uses[u].higher != uses[u - 1].higher) {
          ++edge;
          edges.vertices[edge] = {static_cast<std::uint32_t>(v), uses[u].higher};
          edges.first_use[edge] = u;
        }
        edges.uses[u] = uses[u].corner;
        edges.of_corner[uses[u].corner] = edge;
      }
    }
  });
  return edges;
}

}  // namespace

EdgeUses edge_uses(const Mesh& mesh, std::span<const std::uint32_t> welded, const Run& run) {
  if (welded.empty()) {
    return edge_uses(
        mesh, mesh.vertex_count(), [&](std::size_t corner) { return mesh.corners[corner]; }, run);
  }
  const std::size_t vertices = std::size_t{*std::max_element(welded.begin(), welded.end())} + 1;
  return edge_uses(
      mesh, vertices, [&](std::size_t corner) { return welded[mesh.corners[corner]]; }, run);
}

}  // namespace azulejo
