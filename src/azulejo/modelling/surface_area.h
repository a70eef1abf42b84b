#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/data/mesh.h"
#include "azulejo/modelling/triangulate.h"

namespace azulejo {

/// A place on a triangle: shares of its three corners, whose sum is 1.
using CornerShares = std::array<double, 3>;

/// Shares for two numbers in 0–1, even over the area if they are even.
CornerShares even_shares(double a, double b);

/// The surface of a mesh as one long line of triangles, as long as their areas: a number between 0 and `total` is a place
/// on it. Triangles with a coordinate that is not finite have no length.
class SurfaceArea {
 public:
  SurfaceArea(const Mesh& mesh, const Run& run);

  double total() const { return ends_.empty() ? 0 : ends_.back(); }
  std::size_t triangle_count() const { return ends_.size(); }
  /// The triangle at a number; of several at one number the one that has a length.
  std::size_t at(double number) const;
  /// The same, looked for from an earlier one on.
  std::size_t at(double number, std::size_t earlier) const;

  /// The corners of a triangle, as indices into the mesh's `corners`.
  std::array<std::uint32_t, 3> corners(std::size_t triangle) const {
    return {parts_.corners[3 * triangle], parts_.corners[3 * triangle + 1], parts_.corners[3 * triangle + 2]};
  }
  std::array<glm::dvec3, 3> positions(std::size_t triangle) const;
  std::uint32_t face(std::size_t triangle) const { return parts_.face[triangle]; }
  bool finite(std::size_t triangle) const;

 private:
  const Mesh& mesh_;
  Triangulation parts_;
  std::vector<double> ends_;  ///< sums of areas up to each triangle, this included
};

}  // namespace azulejo
