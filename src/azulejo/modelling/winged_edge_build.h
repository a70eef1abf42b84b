#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/mesh.h"
#include "azulejo/modelling/winged_edge.h"

namespace azulejo {

/// What of a mesh could not be said in a winged edge as it was.
struct WingedEdgeChanges {
  std::vector<std::array<std::uint32_t, 2>> split_edges;  ///< vertices of edges with three faces or more, or with two
                                                          ///< that run along it in the same direction
  std::vector<std::uint32_t> split_vertices;              ///< in several fans of faces; one entry for each vertex added
  std::vector<std::uint32_t> dropped_faces;               ///< with fewer than three different vertices in turn
  bool none() const { return split_edges.empty() && split_vertices.empty() && dropped_faces.empty(); }
};

struct WingedEdgeOfMesh {
  WingedEdge solid;
  WingedEdgeChanges changes;
};

/// A mesh as a winged edge, which has the same vertices (those without faces are left out) and faces in the same order,
/// their `source` the numbers in the mesh. Vertices at one position stay apart: weld first.
///
/// An edge with more than two faces becomes several: going around it, each face is joined to the next that turns its back
/// to it, so that solids which touch there come apart; what finds no partner becomes a border.
/// Throws  Error(Unsupported) beyond 2³¹ edges
/// Cost    O(corners); 1 M triangles in about 0.07 s on two threads
AZULEJO_EXPORT WingedEdgeOfMesh winged_edge(const Mesh& mesh, const Run& run = {});

/// A winged edge as a mesh: vertices and faces in the order of their numbers, faces with several loops bridged along
/// the shortest ways from hole to hole that cross no edge.
///
/// source  the mesh that it was made of: attributes and materials of vertices, faces and corners, and morph targets, are
///         taken from where `source` of each vertex and face points; null: none. Lines are left out
AZULEJO_EXPORT Mesh mesh_of(const WingedEdge& solid, const Mesh* source = nullptr);

}  // namespace azulejo
