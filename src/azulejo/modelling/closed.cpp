#include "azulejo/modelling/closed.h"

#include "azulejo/core/parallel.h"
#include "azulejo/io/weld.h"
#include "azulejo/modelling/edge_uses.h"

namespace azulejo {
namespace {

constexpr std::size_t kEdges = std::size_t{1} << 14;  ///< of one task

EdgeCounts sum(const EdgeCounts& a, const EdgeCounts& b) {
  return {a.edges + b.edges, a.border + b.border, a.turned + b.turned, a.crowded + b.crowded};
}

}  // namespace

EdgeCounts count_edges(const Mesh& mesh, const Run& run) {
  if (mesh.corners.empty()) return {};
  const Array<std::uint32_t> welded = weld_exactly(mesh.positions, run).corners;
  const EdgeUses uses = edge_uses(mesh, welded, run);
  return parallel_reduce(
      uses.size(), kEdges, run, EdgeCounts(),
      [&](std::size_t begin, std::size_t end) {
        EdgeCounts counts;
        for (std::size_t e = begin; e < end; ++e) {
          const auto corners = uses.uses_of(e);
          ++counts.edges;
          counts.border += corners.size() == 1 ? 1 : 0;
          counts.turned +=
              corners.size() == 2 && welded[mesh.corners[corners[0]]] == welded[mesh.corners[corners[1]]] ? 1 : 0;
          counts.crowded += corners.size() > 2 ? 1 : 0;
        }
        return counts;
      },
      sum);
}

bool is_closed(const Mesh& mesh, const Run& run) { return count_edges(mesh, run).closed(); }

}  // namespace azulejo
