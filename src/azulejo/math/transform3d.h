#pragma once

#include <glm/ext/quaternion_double.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>

#include "azulejo/core/export.h"
#include "azulejo/math/transform_class.h"
#include "azulejo/math/turns.h"

namespace azulejo {

/// Transformations of space, as matrices that act on homogeneous column vectors (x, y, z, h): target_from_source · p.
/// All as in transform2d.h; concatenation is the product, M2 · M1: M1 acts first.
///
/// Angles  radians, counter-clockwise for those who look against the axis: x turns y to z, y turns z to x, z turns x
///         to y. Quarters of a turn around coordinate axes are exact
/// Source  Foley, van Dam, Feiner, Hughes, Computer Graphics: Principles and Practice, 2nd ed., 5.6–5.7

/// p + by. Its inverse: p − by.
struct AZULEJO_EXPORT Translation3d {
  glm::dvec3 by{0, 0, 0};
  glm::dmat4 matrix() const;
  glm::dmat4 inverse() const;
};

enum class CoordinateAxis : std::uint8_t { X, Y, Z };

/// Around the axis through a point; the axis is parallel to X, Y or Z, or has any direction, of any length. Its inverse:
/// by the opposite angle, which is the transpose where the axis goes through the origin.
struct AZULEJO_EXPORT Rotation3d {
  Turn turn{1, 0};
  glm::dvec3 axis{0, 0, 1};
  glm::dvec3 point{0, 0, 0};
  Rotation3d() = default;
  Rotation3d(const Turn& by, const glm::dvec3& direction, const glm::dvec3& through = {0, 0, 0})
      : turn(by), axis(direction), point(through) {}
  Rotation3d(double angle, const glm::dvec3& direction, const glm::dvec3& through = {0, 0, 0})
      : turn(turn_of_radians(angle)), axis(direction), point(through) {}
  Rotation3d(double angle, CoordinateAxis parallel, const glm::dvec3& through = {0, 0, 0});
  glm::dmat4 matrix() const;   ///< throws Error(Argument) for an axis of length 0
  glm::dmat4 inverse() const;  ///< as that
};

/// Along x, y and z, away from a point; negative factors mirror. Its inverse: by 1 / factors.
struct AZULEJO_EXPORT Scaling3d {
  glm::dvec3 factors{1, 1, 1};
  glm::dvec3 about{0, 0, 0};
  glm::dmat4 matrix() const;
  glm::dmat4 inverse() const;  ///< throws Error(Argument) for a factor of 0
};

/// (x + x.x · y + x.y · z, y + y.x · x + y.y · z, z + z.x · x + z.y · y), as seen from `about`.
struct AZULEJO_EXPORT Shear3d {
  glm::dvec2 x{0, 0};  ///< of x: by y, by z
  glm::dvec2 y{0, 0};  ///< of y: by x, by z
  glm::dvec2 z{0, 0};  ///< of z: by x, by y
  glm::dvec3 about{0, 0, 0};
  glm::dmat4 matrix() const;
  glm::dmat4 inverse() const;  ///< cofactors; throws Error(Argument) where everything falls onto a plane
};

/// At the plane through `point` with this normal, of any length. It is its own inverse. Both throw Error(Argument) for
/// normal 0.
struct AZULEJO_EXPORT Reflection3d {
  glm::dvec3 point{0, 0, 0};
  glm::dvec3 normal{0, 0, 1};
  glm::dmat4 matrix() const;
  glm::dmat4 inverse() const { return matrix(); }
};

/// The rotation that a quaternion is, of any length. Throws Error(Argument) for length 0.
AZULEJO_EXPORT glm::dmat4 rotation(const glm::dquat& quaternion);
/// The quaternion, w ≥ 0, of a rotation: of the upper left of `m`, which is one. Source: Shepperd, Quaternion from
/// rotation matrix, Journal of Guidance and Control 1 (1978).
AZULEJO_EXPORT glm::dquat quaternion_of(const glm::dmat3& rotation);
/// The quaternion of a rotation by an angle around an axis through the origin. Throws Error(Argument) for axis 0.
AZULEJO_EXPORT glm::dquat quaternion_about(const glm::dvec3& axis, double angle);

/// m, done around `point` instead of the origin: T(point) · m · T(−point). The linear part of an affine one stays as it
/// is, to the last bit.
AZULEJO_EXPORT glm::dmat4 about(const glm::dvec3& point, const glm::dmat4& m);

/// The inverse, in double. None where it is singular, as of inverse(glm::dmat3).
AZULEJO_EXPORT std::optional<glm::dmat4> inverse(const glm::dmat4& m);

/// Whether the last row is (0, 0, 0, 1) exactly: what applies points then skips it.
template <class T>
bool is_affine(const glm::mat<4, 4, T>& m) {
  return m[0].w == 0 && m[1].w == 0 && m[2].w == 0 && m[3].w == 1;
}
/// The same transformation for those who write points as rows, p · M; and back.
inline glm::dmat4 other_convention(const glm::dmat4& m) { return glm::transpose(m); }

/// (x, y, z) → (h x, h y, h z, h).
inline glm::vec4 homogeneous(const glm::vec3& point, float h = 1) { return {h * point, h}; }
/// (x, y, z, h) → (x / h, y / h, z / h). None for h = 0: a direction.
inline std::optional<glm::vec3> point_of(const glm::vec4& homogeneous) {
  if (homogeneous.w == 0) return std::nullopt;
  return glm::vec3(homogeneous) / homogeneous.w;
}

/// A point, divided by h unless the matrix is affine. h = 0 gives infinities or NaN.
AZULEJO_EXPORT glm::vec3 transform_point(const glm::mat4& m, const glm::vec3& point);
/// A difference of points, under the linear part: translations leave it alone.
AZULEJO_EXPORT glm::vec3 transform_direction(const glm::mat4& m, const glm::vec3& direction);
/// A normal, at length 1, so that it stays normal to its surface and outside of it (inverse transpose of the linear
/// part, turned around where that mirrors). 0 where nothing is left of it.
AZULEJO_EXPORT glm::vec3 transform_normal(const glm::mat4& m, const glm::vec3& normal);
/// The inverse transpose of the linear part but for its length, turned around where m mirrors: it exists for every
/// matrix.
AZULEJO_EXPORT glm::dmat3 normal_matrix(const glm::dmat3& linear);
/// Each of them, the same bytes as one by one, in vectors of numbers. `target` may be `source`; it has as many.
/// Cost O(points), bound by memory.
AZULEJO_EXPORT void transform_points(const glm::mat4& m, std::span<const glm::vec3> source,
                                     std::span<glm::vec3> target);
AZULEJO_EXPORT void transform_directions(const glm::mat4& m, std::span<const glm::vec3> source,
                                         std::span<glm::vec3> target);

/// What m does, as classify(glm::dmat3).
AZULEJO_EXPORT TransformClass classify(const glm::dmat4& m, double tolerance = 1e-6);
/// Whether it turns right hands into left ones.
AZULEJO_EXPORT bool is_mirroring(const glm::dmat4& m);

/// T(translation) · R(rotation) · H(shear) · S(scale), S first; H is (x + shear.x · y + shear.y · z, y + shear.z · z, z).
struct Decomposition3d {
  glm::dvec3 translation{0, 0, 0};
  glm::dquat rotation{1, 0, 0, 0};  ///< w, x, y, z; w ≥ 0
  glm::dvec3 shear{0, 0, 0};        ///< of x by y, of x by z, of y by z
  glm::dvec3 scale{1, 1, 1};        ///< one is negative where m mirrors: that for which the rotation is smallest
};
/// None of a projective or singular matrix. Source: Gram–Schmidt on the columns; Thomas, Decomposing a matrix into simple
/// transformations, Graphics Gems II (1991).
AZULEJO_EXPORT std::optional<Decomposition3d> decompose(const glm::dmat4& m);
AZULEJO_EXPORT glm::dmat4 compose(const Decomposition3d& parts);

}  // namespace azulejo
