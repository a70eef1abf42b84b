#include "azulejo/modelling/mesh_edges.h"

#include "azulejo/core/parallel.h"
#include "azulejo/modelling/corners_of_vertices.h"
#include "azulejo/modelling/edge_uses.h"

namespace azulejo {
namespace {

constexpr std::size_t kEdges = std::size_t{1} << 14;  ///< of one task

}  // namespace

Array<MeshEdge> mesh_edges(const Mesh& mesh, std::span<const std::uint32_t> welded, const Run& run) {
  const EdgeUses uses = edge_uses(mesh, welded, run);
  const Array<std::uint32_t> faces = faces_of_corners(mesh, run);
  const auto face_of = [&](std::uint32_t corner) { return faces.empty() ? corner / 3 : faces[corner]; };
  Array<MeshEdge> edges(uses.size());
  parallel_for(uses.size(), kEdges, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const auto corners = uses.uses_of(e);
      MeshEdge edge{corners[0],
                    uses.next[corners[0]],
                    face_of(corners[0]),
                    MeshEdge::kNone,
                    static_cast<std::uint32_t>(corners.size()),
                    false};
      if (corners.size() > 1) {
        edge.other_face = face_of(corners[1]);
        edge.turned = welded[mesh.corners[corners[1]]] == welded[mesh.corners[corners[0]]];
      }
      edges[e] = edge;
    }
  });
  return edges;
}

}  // namespace azulejo
