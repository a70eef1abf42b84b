#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/modelling/closed_surface.h"
#include "azulejo/modelling/triangle_tree.h"

namespace azulejo {

/// Whether a point lies behind a triangle's front, where its corners turn counter-clockwise, exactly. What is in
/// its plane counts as moved by (0, ε, ε²), then by ε³ along x: the same for all triangles, so that sums of them jump
/// nowhere.
bool lies_behind(const glm::dvec3& point, const SurfaceTriangle& triangle);

/// Of a way from a point along x, moved in the same manner: 1 where it leaves a triangle by its front, −1 where it enters
/// there, else 0. Exact.
int crossing_along_x(const glm::dvec3& point, const SurfaceTriangle& triangle);

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
  void make_clusters(double accuracy, const Run& run);

  TriangleTree tree_;
  std::vector<SurfaceTriangle> triangles_;  ///< in the tree's order
  std::vector<Cluster> clusters_;           ///< of each node of the tree
};

}  // namespace azulejo
