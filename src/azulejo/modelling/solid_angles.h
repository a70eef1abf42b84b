#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/modelling/closed_surface.h"
#include "azulejo/modelling/triangle_tree.h"

namespace azulejo {

/// The part of all directions that triangles take up as seen from a point, positive where it sees their backs, summed:
/// the generalized winding number of their surface.
///
/// Triangles that are near are taken one by one; boxes of them that are far, as the first two terms of a series around
/// their middle.
/// Memory  36 bytes a triangle, and about 100 for each four
/// Source  Jacobson, Kavan, Sorkine-Hornung, Robust inside-outside segmentation using generalized winding numbers, 2013;
///         Barill, Dickson, Schmidt, Levin, Jacobson, Fast winding numbers for soups and clouds, 2018; of a triangle:
///         Van Oosterom, Strackee, The solid angle of a plane triangle, 1983
class SolidAngles {
 public:
  /// accuracy  a box is far where it is more than so many times its radius away
  SolidAngles(const std::vector<SurfaceTriangle>& triangles, double accuracy, const Run& run);
  double operator()(const glm::dvec3& point) const;

 private:
  /// What a box of triangles looks like from afar.
  struct Cluster {
    glm::dvec3 middle{0, 0, 0};
    double reach = 0;                ///< square of how near is too near
    glm::dvec3 area{0, 0, 0};        ///< sum of the triangles' areas, as vectors
    std::array<double, 6> spread{};  ///< sum of (centroid − middle) ⊗ area, symmetric: xx yy zz, twice xy yz zx
  };
  static double far_angle(const Cluster& cluster, const glm::dvec3& away, double squared);
  std::span<const SurfaceTriangle> leaf(std::size_t node) const;
  void make_clusters(double accuracy, const Run& run);

  TriangleTree tree_;
  std::vector<SurfaceTriangle> triangles_;  ///< in the tree's order
  std::vector<Cluster> clusters_;           ///< of each node of the tree
};

}  // namespace azulejo
