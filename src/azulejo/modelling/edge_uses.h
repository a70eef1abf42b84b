#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "azulejo/core/run.h"
#include "azulejo/data/array.h"
#include "azulejo/data/mesh.h"

namespace azulejo {

/// The edges of a mesh and where its faces run along them.
///
/// A use of an edge is a corner: the face runs from the corner's vertex to the next corner's. Corners whose next has the
/// same vertex, and those of faces with fewer than three different vertices in turn, use no edge.
struct EdgeUses {
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  Array<std::array<std::uint32_t, 2>> vertices;  ///< of each edge, the lower first; edges rise with them
  Array<std::uint32_t> of_corner;                ///< the edge that the corner uses; kNone
  Array<std::uint32_t> next;                     ///< the next corner of the face that uses an edge; kNone
  Array<std::uint32_t> first_use;                ///< into `uses`, of each edge, and the end
  Array<std::uint32_t> uses;                     ///< corners, rising for each edge

  std::size_t size() const { return vertices.size(); }
  std::span<const std::uint32_t> uses_of(std::size_t edge) const {
    return {uses.data() + first_use[edge], first_use[edge + 1] - first_use[edge]};
  }
};

/// welded  instead of each vertex, the number of its position (Welded::corners); empty: vertices are taken as they are
/// Cost    O(corners), for any mesh O(corners · log corners); about 28 bytes a corner. On all threads
EdgeUses edge_uses(const Mesh& mesh, std::span<const std::uint32_t> welded = {}, const Run& run = {});

}  // namespace azulejo
