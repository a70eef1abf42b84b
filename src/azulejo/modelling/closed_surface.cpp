#include "azulejo/modelling/closed_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "azulejo/core/parallel.h"
#include "azulejo/io/weld.h"
#include "azulejo/modelling/edge_uses.h"
#include "azulejo/modelling/triangulate.h"

namespace azulejo {
namespace {

/// An edge that the surface runs along more often from `from` to `to` than back; as many of it as it is more.
struct OpenEdge {
  std::uint32_t from;
  std::uint32_t to;
};

/// By where they begin.
std::vector<OpenEdge> open_edges(const Mesh& mesh, ClosedSurface& result, const Run& run) {
  const EdgeUses edges = edge_uses(mesh, {}, run);
  std::vector<OpenEdge> open;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto [low, high] = edges.vertices[e];
    std::int64_t surplus = 0;
    for (const std::uint32_t corner : edges.uses_of(e)) surplus += mesh.corners[corner] == low ? 1 : -1;
    if (surplus == 0) continue;
    ++result.open_edges;
    open.insert(open.end(), static_cast<std::size_t>(std::abs(surplus)),
                surplus > 0 ? OpenEdge{low, high} : OpenEdge{high, low});
  }
  std::stable_sort(open.begin(), open.end(), [](const OpenEdge& a, const OpenEdge& b) { return a.from < b.from; });
  return open;
}

/// A border from one of its places to another, closed by a chord: the chord and the middle of the way make a triangle,
/// which leaves the two halves.
void close(std::span<const std::uint32_t> border, const Array<glm::vec3>& positions,
           std::vector<SurfaceTriangle>& lids) {
  if (border.size() < 3) return;
  const std::size_t middle = border.size() / 2;
  lids.push_back({positions[border.front()], positions[border.back()], positions[border[middle]]});
  close(border.first(middle + 1), positions, lids);
  close(border.subspan(middle), positions, lids);
}

/// Open edges come to every vertex as often as they leave it: a way along them that is cut wherever it meets itself
/// falls into closed borders, until no edge is left.
std::vector<SurfaceTriangle> lids_over(const std::vector<OpenEdge>& open, const Array<glm::vec3>& positions) {
  constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::vector<std::uint32_t> first(positions.size() + 1, 0);  // of the edges that begin at a vertex, that not yet gone
  for (const OpenEdge& edge : open) ++first[edge.from + 1];
  for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
  std::vector<std::uint32_t> next = first;
  std::vector<std::uint32_t> place(positions.size(), kNone);  // of a vertex, on the way
  std::vector<std::uint32_t> way;
  std::vector<SurfaceTriangle> lids;
  for (const OpenEdge& start : open) {
    std::uint32_t at = start.from;
    for (;;) {
      if (place[at] != kNone) {
        const std::span border = std::span(way).subspan(place[at]);
        close(border, positions, lids);
        for (const std::uint32_t each : border) place[each] = kNone;
        way.resize(way.size() - border.size());
      }
      if (next[at] == first[at + 1]) break;  // only where the way began, and nothing is left there
      place[at] = static_cast<std::uint32_t>(way.size());
      way.push_back(at);
      at = open[next[at]++].to;
    }
  }
  return lids;
}

}  // namespace

ClosedSurface closed_surface(const Mesh& mesh, const Run& run) {
  ClosedSurface result;
  const Triangulation parts = triangulate(mesh, run);
  std::vector<glm::vec3> corners;
  corners.reserve(parts.corners.size());
  for (std::size_t c = 0; c + 2 < parts.corners.size(); c += 3) {
    SurfaceTriangle triangle;
    for (std::size_t i = 0; i < 3; ++i) triangle[i] = mesh.positions[mesh.corners[parts.corners[c + i]]];
    if (!std::all_of(triangle.begin(), triangle.end(), [](const glm::vec3& p) {
          return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
        })) {
      continue;
    }
    result.triangles.push_back(triangle);
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
  Welded welded = weld_exactly(corners, run);
  Mesh triangles;
  triangles.positions = std::move(welded.positions);
  triangles.corners = std::move(welded.corners);
  result.lids = lids_over(open_edges(triangles, result, run), triangles.positions);
  return result;
}

std::vector<Box3> boxes_of(std::span<const SurfaceTriangle> triangles, const Run& run) {
  std::vector<Box3> boxes(triangles.size());
  parallel_for(boxes.size(), std::size_t{1} << 14, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      for (const glm::vec3& corner : triangles[t]) boxes[t] = united(boxes[t], corner);
    }
  });
  return boxes;
}

}  // namespace azulejo
