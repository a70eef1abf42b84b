#pragma once

#include <cstdint>

#include "azulejo/core/run.h"
#include "azulejo/data/array.h"
#include "azulejo/data/mesh.h"

namespace azulejo {

/// The corners at each vertex, rising: those of vertex v are corners[first[v]] … corners[first[v + 1] − 1].
struct VertexCorners {
  Array<std::uint32_t> first;
  Array<std::uint32_t> corners;
};

/// Sorts the corners of a mesh by vertex. Cost O(vertices + corners); memory 4 bytes a corner and 4 a vertex for each
/// of at most eight threads.
VertexCorners corners_of_vertices(const Mesh& mesh, const Run& run);

/// The face of each corner, where the faces are not all triangles; else empty: it is corner ÷ 3.
Array<std::uint32_t> faces_of_corners(const Mesh& mesh, const Run& run);

}  // namespace azulejo
