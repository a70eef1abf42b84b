#pragma once

#include "azulejo/core/export.h"
#include "azulejo/engine/report.h"
#include "azulejo/modelling/winged_edge_build.h"

namespace azulejo {

struct WingedEdgeOptions {
  int listed = 500;   ///< edges up to which the records are told
  bool soup = false;  ///< the mesh comes back as detached polygons
};

/// The records of a winged edge, what it took to make it, and what each representation of the mesh takes of memory.
///
/// table     lines: faces with their edges, edges with vertices, faces (left, right) and wings, vertices with positions and
///           edges; none beyond options.listed edges, nor "records", the same as numbers
/// bytes     of positions and faces, without attributes
AZULEJO_EXPORT Report report_of(const WingedEdgeOfMesh& made, const Mesh& mesh, const WingedEdgeOptions& options = {});

}  // namespace azulejo
