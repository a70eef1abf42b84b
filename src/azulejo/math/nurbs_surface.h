#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "azulejo/core/export.h"

namespace azulejo {

/// A surface of two parameters, for each a B-spline of homogeneous points (w x, w y, w z, w), w > 0: of equal weights a
/// B-spline surface, with clamped_knots of as many points as degree + 1 a Bézier patch.
struct NurbsSurface {
  int degree_u = 3;
  int degree_v = 3;
  std::size_t columns = 0;  ///< control points along u
  std::size_t rows = 0;     ///< along v
  std::vector<double> knots_u;
  std::vector<double> knots_v;
  std::vector<glm::dvec4> controls;  ///< row by row
};

/// Throws Error(Argument) that begins with `what` for knots that check_knots refuses and for another number of points.
AZULEJO_EXPORT void check_surface(const NurbsSurface& surface, const char* what);

struct SurfacePoint {
  glm::dvec3 position;
  glm::dvec3 along_u;  ///< derivatives
  glm::dvec3 along_v;
};

/// The place at (u, v), which are taken into the domain. Cost O(p q). Source: Piegl & Tiller, The NURBS Book, A4.3, A4.4
AZULEJO_EXPORT SurfacePoint surface_point(const NurbsSurface& surface, double u, double v);

/// Upper bounds of the second derivatives.
struct SurfaceBends {
  double uu = 0;
  double uv = 0;
  double vv = 0;
};
/// From the control points of the derivatives of numerator and weight, about the middle of the points: exact within
/// them for equal weights, coarser the more weights differ.
AZULEJO_EXPORT SurfaceBends surface_bends(const NurbsSurface& surface);

/// A surface of revolution around y: turns the profile, homogeneous points (w r, w y, w) of a B-spline, by a whole turn
/// along u, counter-clockwise seen from above, exactly. Source: Piegl & Tiller, A8.1
AZULEJO_EXPORT NurbsSurface revolved(const std::vector<glm::dvec3>& profile, const std::vector<double>& knots,
                                     int degree);

}  // namespace azulejo
