#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/mesh.h"

namespace azulejo {

struct WindingNumberOptions {
  /// How many times its radius away a group of triangles must be to be taken as one. More is slower and nearer to the
  /// sum. Nothing depends on it where the surface is closed.
  float accuracy = 2;
  std::size_t points = 0;  ///< about how many there will be to tell of: more are worth more preparation
};

/// Tells of any number of points how often the surface of a mesh goes around them: the generalized winding number, the
/// part of all directions in which its faces' backs are seen, less that of their fronts.
///
/// closed  every edge is run along as often in one direction as in the other, vertices at exactly equal positions taken
///         for one: a whole number, exactly (1 inside, 0 outside, −1 inside a shell that is inside out, 2 where shells
///         overlap). It counts where the way from the point along x meets faces, by signs of exact determinants
/// open    a number that changes little where holes are: near 1 inside, near 0 outside, half on what would close the
///         hole. The surface is closed by lids over its borders, which gives a whole number, and what the lids add is
///         taken away again: they are few triangles as a rule, and all that is left to approximate. Where borders have
///         more edges than half of the faces (soup, faces turned at random) the faces are summed themselves.
///         Within about 0.01 of the sum over all triangles for an accuracy of 2
/// faces   n-gons as the triangles that `triangulate` makes of them; those with a coordinate that isn't finite are left
///         out, lines and points are nothing
/// Cost    O(log n) a point as a rule, and O(1) for one in a cell of a grid that no face comes near, which are most of
///         them; about 100 bytes a triangle, 4 a cell. Points are independent of each other and of the grid
/// Source  solid_angles.h
class AZULEJO_EXPORT WindingNumber {
 public:
  explicit WindingNumber(const Mesh& mesh, const WindingNumberOptions& options = {}, const Run& run = {});
  ~WindingNumber();
  WindingNumber(WindingNumber&&) noexcept;
  WindingNumber& operator=(WindingNumber&&) noexcept;

  /// Edges that the surface runs along more often in one direction than in the other; none: it is closed.
  std::size_t open_edges() const;
  /// At a point that is not finite, 0. On the surface, that beside it.
  double operator()(const glm::vec3& point) const;
  /// Whether a point is on a face, exactly; with a distance above 0, whether a face is so near, in doubles.
  bool is_near(const glm::vec3& point, float distance = 0) const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace azulejo
