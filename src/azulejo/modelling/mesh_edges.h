#pragma once

#include <cstdint>
#include <span>

#include "azulejo/core/run.h"
#include "azulejo/data/array.h"
#include "azulejo/data/mesh.h"

namespace azulejo {

/// Where faces end or meet: from one corner of a face to its next.
struct MeshEdge {
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::uint32_t begin = 0;           ///< corner of the first face along it; its vertex and that of `end` are the edge's
  std::uint32_t end = 0;             ///< corner
  std::uint32_t face = 0;            ///< the first along it
  std::uint32_t other_face = kNone;  ///< the second
  std::uint32_t faces = 1;           ///< along it, in all
  bool turned = false;               ///< the second runs along it in the same direction: one is inside out
};

/// The edges of a mesh's faces, each once, vertices at exactly equal positions taken for one. In the order of the lower
/// of their (welded) vertices, then of the other, for any number of threads. Steps between corners at one position are
/// no edges, nor are those of faces with fewer than three different positions in turn.
///
/// welded  of each vertex, the number of its position: Welded::corners of the positions
/// Cost    O(corners), for any mesh O(corners · log corners); 28 bytes a corner beside the result
Array<MeshEdge> mesh_edges(const Mesh& mesh, std::span<const std::uint32_t> welded, const Run& run);

}  // namespace azulejo
