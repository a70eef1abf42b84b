#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "azulejo/modelling/surface_builder.h"

namespace azulejo {

/// A place of a surface with its unit normal.
struct SurfacePlace {
  glm::dvec3 position;
  glm::dvec3 normal;
};

/// Cuts a surface over u and v in 0–1 into columns × rows quads, seen from the side where u × v turns clockwise.
struct ParametricGrid {
  int columns = 1;      ///< along u
  int rows = 1;         ///< along v
  bool wrap_u = false;  ///< the surface at u = 1 is that at 0: they share vertices
  bool wrap_v = false;
};

/// Vertices of row j and column i, row by row, of what add_grid added.
using GridVertices = std::vector<std::vector<std::uint32_t>>;

GridVertices add_grid(SurfaceBuilder& builder, const ParametricGrid& grid,
                      const std::function<SurfacePlace(double u, double v)>& surface);

}  // namespace azulejo
