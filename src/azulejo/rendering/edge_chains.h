#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "azulejo/data/array.h"

namespace azulejo {

/// Vertices one after the other, in lines.
struct EdgeChains {
  Array<std::uint32_t> vertices;
  std::vector<std::size_t> first;  ///< of each line, in `vertices`; one more at the end
  std::size_t size() const { return first.size() - 1; }
  std::span<const std::uint32_t> operator[](std::size_t line) const {
    return {vertices.data() + first[line], first[line + 1] - first[line]};
  }
};

/// Joins edges end to end, each once, into lines of at most `longest` edges: first those between vertices where an odd
/// number of edges meet, then the rest, which are rings. The same for equal edges in equal order.
///
/// edges     pairs of different vertices below `vertices`
/// Cost      O(edges + vertices)
EdgeChains edge_chains(std::span<const std::pair<std::uint32_t, std::uint32_t>> edges, std::size_t vertices,
                       std::size_t longest);

}  // namespace azulejo
