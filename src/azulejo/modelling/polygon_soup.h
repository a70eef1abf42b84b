#pragma once

#include <cstddef>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/mesh.h"

namespace azulejo {

/// The mesh as detached polygons: every corner has a vertex of its own, in the order of the corners. Attributes and
/// morph targets stay what they are; vertices without faces, and lines, are left out. Welding undoes it, where no two
/// vertices were at one position.
/// Cost  O(corners)
AZULEJO_EXPORT Mesh polygon_soup(const Mesh& mesh, const Run& run = {});

/// What positions and faces take: of a soup three floats a corner; of a list of vertices three floats a vertex and an
/// index a corner. Each with an index a face, where not all are triangles.
AZULEJO_EXPORT std::size_t polygon_soup_bytes(const Mesh& mesh);
AZULEJO_EXPORT std::size_t vertex_list_bytes(const Mesh& mesh);

}  // namespace azulejo
