#pragma once

#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "azulejo/core/export.h"

namespace azulejo {

/// Geometric predicates whose sign is that of the exact determinant, however close to degenerate: first in doubles with
/// a bound of the error, and where that leaves the sign open, with expansions of doubles. The value is the determinant
/// within about 10⁻¹⁵ of the sum of its terms' absolute values.
///
/// exact for  any floats; any doubles as long as no product of the determinant leaves the range of doubles, nor do its
///            last bits: differences between 10⁻⁷⁰ and 10⁷⁰ (or 0) suffice for all three
/// NaN, infinite coordinates  any number, or NaN
/// Cost       a few nanoseconds; where the sign was open, about 0.1 to 5 µs
/// Source     J. R. Shewchuk, Adaptive precision floating-point arithmetic and fast robust geometric predicates, 1997

namespace predicates {
inline constexpr double kHalfUlp = 0x1p-53;
AZULEJO_EXPORT double exact_orient2d(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c);
AZULEJO_EXPORT double exact_orient3d(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                                     const glm::dvec3& d);
AZULEJO_EXPORT double exact_incircle(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c,
                                     const glm::dvec2& d);
}  // namespace predicates

/// Twice the signed area of a triangle: positive where a, b, c turn counter-clockwise with y up (clockwise with y
/// down), zero where they are collinear.
inline double orient2d(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  constexpr double kBound = (3 + 16 * predicates::kHalfUlp) * predicates::kHalfUlp;
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double determinant = left - right;
  if (std::abs(determinant) > kBound * (std::abs(left) + std::abs(right))) return determinant;
  return predicates::exact_orient2d(a, b, c);
}

/// Six times the signed volume of a tetrahedron: positive where d sees a, b, c turn clockwise, zero where the four lie
/// in a plane.
inline double orient3d(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  constexpr double kBound = (7 + 56 * predicates::kHalfUlp) * predicates::kHalfUlp;
  const glm::dvec3 ad = a - d;
  const glm::dvec3 bd = b - d;
  const glm::dvec3 cd = c - d;
  const double bc = bd.x * cd.y;
  const double cb = cd.x * bd.y;
  const double ca = cd.x * ad.y;
  const double ac = ad.x * cd.y;
  const double ab = ad.x * bd.y;
  const double ba = bd.x * ad.y;
  const double determinant = ad.z * (bc - cb) + bd.z * (ca - ac) + cd.z * (ab - ba);
  const double size = (std::abs(bc) + std::abs(cb)) * std::abs(ad.z) + (std::abs(ca) + std::abs(ac)) * std::abs(bd.z) +
                      (std::abs(ab) + std::abs(ba)) * std::abs(cd.z);
  if (std::abs(determinant) > kBound * size) return determinant;
  return predicates::exact_orient3d(a, b, c, d);
}

/// Positive where d lies inside the circle through a, b, c, which turn counter-clockwise (else the sign is the other
/// one), zero where the four lie on a circle or line.
inline double incircle(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d) {
  constexpr double kBound = (10 + 96 * predicates::kHalfUlp) * predicates::kHalfUlp;
  const glm::dvec2 ad = a - d;
  const glm::dvec2 bd = b - d;
  const glm::dvec2 cd = c - d;
  const double bc = bd.x * cd.y;
  const double cb = cd.x * bd.y;
  const double ca = cd.x * ad.y;
  const double ac = ad.x * cd.y;
  const double ab = ad.x * bd.y;
  const double ba = bd.x * ad.y;
  const double a_lift = ad.x * ad.x + ad.y * ad.y;
  const double b_lift = bd.x * bd.x + bd.y * bd.y;
  const double c_lift = cd.x * cd.x + cd.y * cd.y;
  const double determinant = a_lift * (bc - cb) + b_lift * (ca - ac) + c_lift * (ab - ba);
  const double size = (std::abs(bc) + std::abs(cb)) * a_lift + (std::abs(ca) + std::abs(ac)) * b_lift +
                      (std::abs(ab) + std::abs(ba)) * c_lift;
  if (std::abs(determinant) > kBound * size) return determinant;
  return predicates::exact_incircle(a, b, c, d);
}

}  // namespace azulejo
