#pragma once

#include <cstdint>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/array.h"
#include "azulejo/data/mesh.h"

namespace azulejo {

struct Triangulation {
  Array<std::uint32_t> corners;  ///< three a triangle: indices into the mesh's `corners`
  Array<std::uint32_t> face;     ///< the face of each triangle, rising
};

/// Divides every face into triangles over its own corners: n − 2 of them, turning as the face does, none for fewer
/// than three corners. Together they cover a planar simple polygon exactly once, concave ones and those with holes
/// bridged by doubled vertices too.
///
/// quads       along the diagonal that leaves both triangles on one side; of two such, the shorter
/// others      convex: a fan; else ears are cut off in the plane of the Newell normal, seen along its largest axis
/// degenerate  collinear, crossing, not planar, NaN: still n − 2 triangles of the right corners, some without area
/// Cost        O(corners) for small faces; for one of n corners O(n log n) as a rule, and never more than about a
///             thousand comparisons a corner: what is left of a face after that becomes a fan
/// Source      Meisters, Polygons have ears, 1975; Eberly, Triangulation by ear clipping
AZULEJO_EXPORT Triangulation triangulate(const Mesh& mesh, const Run& run = {});

}  // namespace azulejo
