#pragma once

#include <cstdint>

#include "azulejo/data/array.h"
#include "azulejo/data/mesh.h"

namespace azulejo {

/// How a mesh is made of another one. 0xFFFFFFFF stands for an element that the other one doesn't have: its attributes
/// and its position are 0, its material is none.
struct MeshPick {
  Array<std::uint32_t> vertices;      ///< of each vertex, the one that it was
  Array<std::uint32_t> corners;       ///< the new vertex of each corner
  Array<std::uint32_t> corner_of;     ///< of each corner, the one that it was
  Array<std::uint32_t> faces;         ///< of each face, the one that it was
  Array<std::uint32_t> face_offsets;  ///< empty: triangles
  Array<std::uint32_t> lines;         ///< of new vertices
};

/// The mesh with its name, space, attributes, materials and morph targets.
Mesh picked(const Mesh& mesh, MeshPick pick);

}  // namespace azulejo
