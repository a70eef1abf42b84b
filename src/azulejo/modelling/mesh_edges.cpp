#include "azulejo/modelling/mesh_edges.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "azulejo/core/parallel.h"

namespace azulejo {
namespace {

constexpr std::size_t kVertices = std::size_t{1} << 14;  ///< of one task

/// A step along a face, listed at its lower vertex.
struct HalfEdge {
  std::uint32_t high = 0;   ///< the other vertex
  std::uint32_t begin = 0;  ///< corner
};

/// Calls f(face, from, to), corners, along each face.
template <class F>
void for_each_step(const Mesh& mesh, std::span<const std::uint32_t> welded, F f) {
  for (std::size_t face = 0; face < mesh.face_count(); ++face) {
    const std::size_t begin = mesh.face_begin(face);
    const std::size_t end = mesh.face_end(face);
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t next = i + 1 == end ? begin : i + 1;
      if (welded[mesh.corners[i]] != welded[mesh.corners[next]]) f(face, i, next);
    }
  }
}

/// The steps of all faces by their lower vertex; those of one in the order of their corners.
struct HalfEdges {
  Array<std::uint32_t> starts;
  Array<HalfEdge> list;

  HalfEdges(const Mesh& mesh, std::span<const std::uint32_t> welded) {
    const std::uint32_t vertices = welded.empty() ? 0 : *std::max_element(welded.begin(), welded.end()) + 1;
    starts.assign(std::size_t{vertices} + 1, 0);
    for_each_step(mesh, welded, [&](std::size_t, std::size_t from, std::size_t to) {
      ++starts[std::min(welded[mesh.corners[from]], welded[mesh.corners[to]])];
    });
    std::uint32_t total = 0;
    for (std::uint32_t& each : starts) total += std::exchange(each, total);
    list.resize(total);
    for_each_step(mesh, welded, [&](std::size_t, std::size_t from, std::size_t to) {
      const auto [low, high] = std::minmax(welded[mesh.corners[from]], welded[mesh.corners[to]]);
      list[starts[low]++] = {high, static_cast<std::uint32_t>(from)};
    });
    // Each start has moved to the next one's place.
    std::move_backward(starts.begin(), starts.end() - 1, starts.end());
    starts[0] = 0;
  }
};

/// Corners are found in their faces.
class Faces {
 public:
  explicit Faces(const Mesh& mesh) : mesh_(mesh) {}
  std::uint32_t of(std::uint32_t corner) const {
    if (mesh_.all_triangles()) return corner / 3;
    const auto after = std::upper_bound(mesh_.face_offsets.begin(), mesh_.face_offsets.end(), corner);
    return static_cast<std::uint32_t>(after - mesh_.face_offsets.begin()) - 1;
  }
  std::uint32_t next(std::uint32_t corner, std::uint32_t face) const {
    return corner + 1 == mesh_.face_end(face) ? static_cast<std::uint32_t>(mesh_.face_begin(face)) : corner + 1;
  }

 private:
  const Mesh& mesh_;
};

}  // namespace

Array<MeshEdge> mesh_edges(const Mesh& mesh, std::span<const std::uint32_t> welded, const Run& run) {
  HalfEdges half(mesh, welded);
  const Faces faces(mesh);
  const std::size_t vertices = half.starts.size() - 1;
  std::vector<std::vector<MeshEdge>> parts((vertices + kVertices - 1) / kVertices);
  parallel_for(vertices, kVertices, run, [&](std::size_t begin, std::size_t end) {
    std::vector<MeshEdge>& part = parts[begin / kVertices];
    for (std::size_t vertex = begin; vertex < end; ++vertex) {
      HalfEdge* const first = half.list.data() + half.starts[vertex];
      HalfEdge* const last = half.list.data() + half.starts[vertex + 1];
      std::sort(first, last, [](const HalfEdge& a, const HalfEdge& b) {
        return a.high != b.high ? a.high < b.high : a.begin < b.begin;
      });
      for (const HalfEdge* each = first; each != last; ++each) {
        const std::uint32_t face = faces.of(each->begin);
        if (each != first && each->high == each[-1].high) {
          MeshEdge& edge = part.back();
          if (++edge.faces == 2) {
            edge.other_face = face;
            edge.turned = welded[mesh.corners[each->begin]] == welded[mesh.corners[edge.begin]];
          }
          continue;
        }
        part.push_back({each->begin, faces.next(each->begin, face), face, MeshEdge::kNone, 1, false});
      }
    }
  });
  std::size_t total = 0;
  for (const auto& part : parts) total += part.size();
  Array<MeshEdge> edges;
  edges.reserve(total);
  for (const auto& part : parts) edges.insert(edges.end(), part.begin(), part.end());
  return edges;
}

}  // namespace azulejo
