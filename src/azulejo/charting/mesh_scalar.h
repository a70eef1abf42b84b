#pragma once

#include <optional>
#include <string>

#include "azulejo/data/mesh.h"

namespace azulejo {

/// One number on each element of a mesh.
struct MeshScalar {
  Domain domain = Domain::Vertex;
  Array<float> values;
};

/// A coordinate of the positions ("x", "y", "z", if no attribute has that name), or an attribute.
/// component  auto: the length of a vector
/// Throws     Error(Argument), beginning with `attribute` or `component`
MeshScalar mesh_scalar(const Mesh& mesh, const std::string& attribute, std::optional<int> component);

}  // namespace azulejo
