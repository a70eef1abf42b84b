#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>

#include "azulejo/core/run.h"
#include "azulejo/data/array.h"
#include "azulejo/data/mesh.h"
#include "azulejo/modelling/united_attributes.h"

namespace azulejo {

/// A mesh as a node shows it, and where it goes in a mesh of many.
struct Instance {
  const Mesh* mesh = nullptr;
  std::uint32_t node = 0;
  glm::mat4 world_from_mesh{1.0F};
  std::size_t first_vertex = 0;
  std::size_t first_corner = 0;
  std::size_t first_face = 0;
  std::size_t first_line = 0;

  /// Seen from outside, its faces turn clockwise.
  bool mirrored() const;
  std::size_t first(Domain domain) const {
    return domain == Domain::Vertex ? first_vertex : domain == Domain::Corner ? first_corner : first_face;
  }
};

/// Copies the instance's values of an attribute to their place in `attribute.values`: converted, filled where it has
/// none, directions turned into the world's.
///
/// order  which of its corners is each corner of the result's
void copy_attribute(const Instance& instance, const Array<std::uint32_t>& order, UnitedAttribute& attribute,
                    const Run& run);

}  // namespace azulejo
