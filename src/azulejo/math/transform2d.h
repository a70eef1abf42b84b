#pragma once

#include <cstdint>
#include <glm/mat3x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "azulejo/core/export.h"
#include "azulejo/math/transform_class.h"
#include "azulejo/math/turns.h"

namespace azulejo {

/// Transformations of the plane, as matrices that act on homogeneous column vectors (x, y, h): target_from_source · p.
/// Concatenation is the product, M2 · M1: M1 acts first. Built in double, so that long chains keep more digits than
/// f32 has; points in f32 take glm::mat3(m).
///
/// Angles  radians, from +x towards +y: counter-clockwise where y points up, clockwise as seen where it points down.
///         Quarters of a turn are exact: `Rotation2d{turn_of_degrees(90)}`, or the double nearest to π / 2
/// Inverse each in closed form; `inverse(matrix)` is for what was composed
/// NaN     passes
/// Source  Foley, van Dam, Feiner, Hughes, Computer Graphics: Principles and Practice, 2nd ed., 5.1–5.4

/// p + by. Its inverse: p − by.
struct AZULEJO_EXPORT Translation2d {
  glm::dvec2 by{0, 0};
  glm::dmat3 matrix() const;
  glm::dmat3 inverse() const;
};

/// Around a point. Its inverse: by the opposite angle, which is the transpose around the origin.
struct AZULEJO_EXPORT Rotation2d {
  Turn turn{1, 0};
  glm::dvec2 about{0, 0};
  Rotation2d() = default;
  explicit Rotation2d(const Turn& by, const glm::dvec2& fixed = {0, 0}) : turn(by), about(fixed) {}
  explicit Rotation2d(double angle, const glm::dvec2& fixed = {0, 0}) : turn(turn_of_radians(angle)), about(fixed) {}
  glm::dmat3 matrix() const;
  glm::dmat3 inverse() const;
};

/// Along x and y, away from a point; negative factors mirror. Its inverse: by 1 / factors.
struct AZULEJO_EXPORT Scaling2d {
  glm::dvec2 factors{1, 1};
  glm::dvec2 about{0, 0};
  glm::dmat3 matrix() const;
  glm::dmat3 inverse() const;  ///< throws Error(Argument) for a factor of 0
};

/// (x + factors.x · y, y + factors.y · x), as seen from `about`. One along x alone has its opposite as the inverse.
struct AZULEJO_EXPORT Shear2d {
  glm::dvec2 factors{0, 0};
  glm::dvec2 about{0, 0};
  glm::dmat3 matrix() const;
  glm::dmat3 inverse() const;  ///< throws Error(Argument) where factors.x · factors.y = 1: everything falls onto a line
};

/// At the line through `point` in this direction, of any length: {{0, 0}, {1, 0}} is the axis XX', {{0, 0}, {0, 1}} YY'.
/// It is its own inverse. Both throw Error(Argument) for direction 0.
struct AZULEJO_EXPORT Reflection2d {
  glm::dvec2 point{0, 0};
  glm::dvec2 direction{1, 0};
  glm::dmat3 matrix() const;
  glm::dmat3 inverse() const { return matrix(); }
};

/// m, done around `point` instead of the origin: T(point) · m · T(−point). The linear part of an affine one stays as it
/// is, to the last bit.
AZULEJO_EXPORT glm::dmat3 about(const glm::dvec2& point, const glm::dmat3& m);

/// The inverse, in double. None where it is singular: where the determinant, of the linear part of an affine matrix, is
/// not more than 2⁻⁴⁸ of the product of its columns' lengths, or not finite.
AZULEJO_EXPORT std::optional<glm::dmat3> inverse(const glm::dmat3& m);

/// Whether the last row is (0, 0, 1) exactly: what applies points then skips it.
template <class T>
bool is_affine(const glm::mat<3, 3, T>& m) {
  return m[0].z == 0 && m[1].z == 0 && m[2].z == 1;
}
inline glm::dmat3 matrix_of(const glm::mat3x2& affine) {
  return {glm::dvec3(affine[0], 0), glm::dvec3(affine[1], 0), glm::dvec3(affine[2], 1)};
}
/// Without the last row, which must be (0, 0, 1).
inline glm::mat3x2 affine_part(const glm::dmat3& m) { return {glm::vec2(m[0]), glm::vec2(m[1]), glm::vec2(m[2])}; }

/// The same transformation for those who write points as rows, p · M; and back.
inline glm::dmat3 other_convention(const glm::dmat3& m) { return glm::transpose(m); }

/// (x, y) → (h x, h y, h).
inline glm::vec3 homogeneous(const glm::vec2& point, float h = 1) { return {h * point.x, h * point.y, h}; }
/// (x, y, h) → (x / h, y / h). None for h = 0: a direction.
inline std::optional<glm::vec2> point_of(const glm::vec3& homogeneous) {
  if (homogeneous.z == 0) return std::nullopt;
  return glm::vec2(homogeneous.x / homogeneous.z, homogeneous.y / homogeneous.z);
}

/// A point, divided by h unless the matrix is affine. h = 0 gives infinities or NaN.
AZULEJO_EXPORT glm::vec2 transform_point(const glm::mat3& m, const glm::vec2& point);
/// A difference of points, under the linear part: translations leave it alone.
AZULEJO_EXPORT glm::vec2 transform_direction(const glm::mat3& m, const glm::vec2& direction);
/// A normal, at length 1, so that it stays normal to what it was normal to (inverse transpose of the linear part); on a
/// mirrored curve it stays on its side. 0 where nothing is left of it.
AZULEJO_EXPORT glm::vec2 transform_normal(const glm::mat3& m, const glm::vec2& normal);
/// Each of them, the same bytes as one by one, in vectors of numbers. `target` may be `source`; it has as many.
/// Cost O(points), bound by memory.
AZULEJO_EXPORT void transform_points(const glm::mat3& m, std::span<const glm::vec2> source,
                                     std::span<glm::vec2> target);

/// What m does, by its entries: those that differ by no more than `tolerance` count as equal (of translations in their
/// units, of the others relative to the largest of the linear part).
AZULEJO_EXPORT TransformClass classify(const glm::dmat3& m, double tolerance = 1e-6);
/// Whether it turns the plane over.
AZULEJO_EXPORT bool is_mirroring(const glm::dmat3& m);

/// T(translation) · R(rotation) · H(shear) · S(scale), S first; H is (x + shear · y, y).
struct Decomposition2d {
  glm::dvec2 translation{0, 0};
  double rotation = 0;  ///< radians, in (−π, π]
  double shear = 0;
  glm::dvec2 scale{1, 1};  ///< one is negative where m mirrors: that for which the rotation is smaller
};
/// None of a projective or singular matrix. Source: Gram–Schmidt on the columns.
AZULEJO_EXPORT std::optional<Decomposition2d> decompose(const glm::dmat3& m);
AZULEJO_EXPORT glm::dmat3 compose(const Decomposition2d& parts);

}  // namespace azulejo
