#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/data/mesh.h"
#include "azulejo/modelling/nearest_triangle.h"
#include "azulejo/modelling/surface_area.h"

namespace azulejo {

/// A mesh as something to measure distances from and to.
class DistanceSurface {
 public:
  /// Throws Error(Argument), beginning with `what`, if nothing of the mesh is finite.
  DistanceSurface(const Mesh& mesh, const char* what, const Run& run);

  const Mesh& mesh() const { return mesh_; }
  const SurfaceArea& area() const { return area_; }
  const NearestTriangle& tree() const { return tree_; }
  /// Triangles of `area` that are finite; none: the mesh counts as points.
  const std::vector<std::uint32_t>& triangles() const { return triangles_; }
  /// Whether a vertex is a point of the surface.
  bool has(std::size_t vertex) const { return vertices_[vertex] != 0; }
  /// Triangles, or vertices where there are none.
  std::size_t size() const { return tree_.size(); }

 private:
  std::vector<NearestTriangle::Triangle> elements(const char* what, const Run& run);

  const Mesh& mesh_;
  SurfaceArea area_;
  std::vector<std::uint32_t> triangles_;
  std::vector<std::uint8_t> vertices_;
  NearestTriangle tree_;
};

}  // namespace azulejo
