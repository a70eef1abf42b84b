#pragma once

#include <cstddef>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/mesh.h"

namespace azulejo {

/// How the faces of a mesh meet at its edges, vertices at exactly equal positions taken for one (-0 = 0). A face with
/// fewer than three different positions in turn has no edges.
struct EdgeCounts {
  std::size_t edges = 0;
  std::size_t border = 0;   ///< with one face
  std::size_t turned = 0;   ///< with two faces that run along it in the same direction: one of them is inside out
  std::size_t crowded = 0;  ///< with three faces or more
  bool closed() const { return edges > 0 && border + turned + crowded == 0; }
  friend bool operator==(const EdgeCounts&, const EdgeCounts&) = default;
};

/// Cost  O(corners), for any mesh O(corners · log corners); 28 bytes a corner, 24 a vertex
AZULEJO_EXPORT EdgeCounts count_edges(const Mesh& mesh, const Run& run = {});

/// Whether every edge has exactly two faces, which run along it in opposite directions: the surface has an inside.
AZULEJO_EXPORT bool is_closed(const Mesh& mesh, const Run& run = {});

}  // namespace azulejo
