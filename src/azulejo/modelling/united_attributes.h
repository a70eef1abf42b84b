#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "azulejo/data/mesh.h"

namespace azulejo {

/// An attribute that several meshes are to have alike.
struct UnitedAttribute {
  std::string name;
  Domain domain = Domain::Vertex;
  int components = 1;
  Attribute::Values values;  ///< of the type that all take, or f32

  bool is_color() const { return name.rfind("COLOR_", 0) == 0; }
};

/// The attributes of all meshes, in the order in which they come up, without those of the name `but`; `values` are
/// empty.
std::vector<UnitedAttribute> unite_attributes(const std::vector<const Mesh*>& meshes, const std::string& but);

/// Bytes of one value.
std::size_t component_bytes(const Attribute::Values& values);

}  // namespace azulejo
