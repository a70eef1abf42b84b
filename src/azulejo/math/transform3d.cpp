#include "azulejo/math/transform3d.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "azulejo/core/error.h"
#include "azulejo/math/transform_kernels.h"
#include "azulejo/math/transform_tolerance.h"

namespace azulejo {
namespace {

glm::dmat4 with_linear(const glm::dmat3& linear) {
  return {glm::dvec4(linear[0], 0), glm::dvec4(linear[1], 0), glm::dvec4(linear[2], 0), glm::dvec4(0, 0, 0, 1)};
}

/// The direction at a length of which squares neither vanish nor overflow. Throws Error(Argument) for 0.
glm::dvec3 handy(const glm::dvec3& direction, const char* name) {
  const double longest = std::max({std::fabs(direction.x), std::fabs(direction.y), std::fabs(direction.z)});
  if (!(longest > 0)) {
    throw Error(Error::Argument, fmt::format("{}: {},{},{}, expected a direction other than 0,0,0", name, direction.x,
                                             direction.y, direction.z));
  }
  return direction / longest;
}

glm::dmat3 rotation_around_x(double c, double s) { return {1, 0, 0, 0, c, s, 0, -s, c}; }
glm::dmat3 rotation_around_y(double c, double s) { return {c, 0, -s, 0, 1, 0, s, 0, c}; }
glm::dmat3 rotation_around_z(double c, double s) { return {c, s, 0, -s, c, 0, 0, 0, 1}; }

glm::dmat3 rotation_around(const glm::dvec3& axis, double c, double s) {
  const glm::dvec3 d = handy(axis, "axis");
  if (d.y == 0 && d.z == 0) return rotation_around_x(c, d.x > 0 ? s : -s);
  if (d.x == 0 && d.z == 0) return rotation_around_y(c, d.y > 0 ? s : -s);
  if (d.x == 0 && d.y == 0) return rotation_around_z(c, d.z > 0 ? s : -s);
  const glm::dvec3 n = d / glm::length(d);
  const glm::dvec3 t = (1 - c) * n;
  return {t.x * n.x + c,       t.x * n.y + s * n.z, t.x * n.z - s * n.y, t.y * n.x - s * n.z, t.y * n.y + c,
          t.y * n.z + s * n.x, t.z * n.x + s * n.y, t.z * n.y - s * n.x, t.z * n.z + c};
}

glm::dvec3 direction_of(CoordinateAxis axis) {
  glm::dvec3 direction(0);
  direction[static_cast<int>(axis)] = 1;
  return direction;
}

/// Columns are cofactors: the inverse transpose times the determinant.
glm::dmat3 cofactors(const glm::dmat3& m) {
  return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

double size_of(const glm::dmat3& m) { return glm::length(m[0]) * glm::length(m[1]) * glm::length(m[2]); }

std::optional<glm::dmat3> inverse_of(const glm::dmat3& m) {
  const glm::dmat3 c = cofactors(m);
  const double determinant = glm::dot(m[0], c[0]);
  if (is_singular(determinant, size_of(m))) return std::nullopt;
  return glm::transpose(c) * (1 / determinant);
}

}  // namespace

glm::dmat4 Translation3d::matrix() const {
  glm::dmat4 m(1);
  m[3] = glm::dvec4(by, 1);
  return m;
}
glm::dmat4 Translation3d::inverse() const { return Translation3d{-by}.matrix(); }

Rotation3d::Rotation3d(double angle, CoordinateAxis parallel, const glm::dvec3& through)
    : Rotation3d(angle, direction_of(parallel), through) {}
glm::dmat4 Rotation3d::matrix() const {
  return about(point, with_linear(rotation_around(axis, turn.cosine, turn.sine)));
}
glm::dmat4 Rotation3d::inverse() const {
  return about(point, with_linear(rotation_around(axis, turn.cosine, -turn.sine)));
}

glm::dmat4 Scaling3d::matrix() const {
  return azulejo::about(about, {factors.x, 0, 0, 0, 0, factors.y, 0, 0, 0, 0, factors.z, 0, 0, 0, 0, 1});
}
glm::dmat4 Scaling3d::inverse() const {
  if (factors.x == 0 || factors.y == 0 || factors.z == 0) {
    throw Error(Error::Argument, fmt::format("scale: {},{},{} has no inverse, expected factors other than 0", factors.x,
                                             factors.y, factors.z));
  }
  return Scaling3d{1.0 / factors, about}.matrix();
}

glm::dmat4 Shear3d::matrix() const {
  return azulejo::about(about, {1, y.x, z.x, 0, x.x, 1, z.y, 0, x.y, y.y, 1, 0, 0, 0, 0, 1});
}
glm::dmat4 Shear3d::inverse() const {
  const glm::dmat3 m(1, y.x, z.x, x.x, 1, z.y, x.y, y.y, 1);
  const std::optional<glm::dmat3> turned = inverse_of(m);
  if (!turned) throw Error(Error::Argument, "shear: everything falls onto a plane, expected factors with an inverse");
  return azulejo::about(about, with_linear(*turned));
}

glm::dmat4 Reflection3d::matrix() const {
  const glm::dvec3 n = handy(normal, "reflect");
  const glm::dvec3 t = n * (2 / glm::dot(n, n));
  glm::dmat3 linear(1);
  for (int column = 0; column < 3; ++column) linear[column] -= t[column] * n;
  return about(point, with_linear(linear));
}

glm::dmat4 rotation(const glm::dquat& quaternion) {
  const double longest =
      std::max({std::fabs(quaternion.w), std::fabs(quaternion.x), std::fabs(quaternion.y), std::fabs(quaternion.z)});
  if (!(longest > 0)) throw Error(Error::Argument, "quaternion: 0, expected a length other than 0");
  const double w = quaternion.w / longest;
  const glm::dvec3 v = glm::dvec3(quaternion.x, quaternion.y, quaternion.z) / longest;
  const double s = 2 / (w * w + glm::dot(v, v));
  const glm::dvec3 t = s * v;
  return with_linear({1 - (t.y * v.y + t.z * v.z), t.x * v.y + t.z * w, t.x * v.z - t.y * w,  //
                      t.x * v.y - t.z * w, 1 - (t.x * v.x + t.z * v.z), t.y * v.z + t.x * w,  //
                      t.x * v.z + t.y * w, t.y * v.z - t.x * w, 1 - (t.x * v.x + t.y * v.y)});
}

glm::dquat quaternion_of(const glm::dmat3& m) {
  // The largest of 4w², 4x², 4y², 4z² first: its root is safe to divide by.
  const double trace = m[0].x + m[1].y + m[2].z;
  const double squares[] = {1 + trace, 1 + 2 * m[0].x - trace, 1 + 2 * m[1].y - trace, 1 + 2 * m[2].z - trace};
  const auto largest = std::max_element(squares, squares + 4) - squares;
  const double root = std::sqrt(squares[largest]);
  const double f = 0.5 / root;
  glm::dquat q;
  switch (largest) {
    case 0: q = {root / 2, f * (m[1].z - m[2].y), f * (m[2].x - m[0].z), f * (m[0].y - m[1].x)}; break;
    case 1: q = {f * (m[1].z - m[2].y), root / 2, f * (m[0].y + m[1].x), f * (m[2].x + m[0].z)}; break;
    case 2: q = {f * (m[2].x - m[0].z), f * (m[0].y + m[1].x), root / 2, f * (m[1].z + m[2].y)}; break;
    default: q = {f * (m[0].y - m[1].x), f * (m[2].x + m[0].z), f * (m[1].z + m[2].y), root / 2}; break;
  }
  return q.w < 0 ? -q : q;
}

glm::dquat quaternion_about(const glm::dvec3& axis, double angle) {
  const glm::dvec3 d = handy(axis, "axis");
  const Turn half = turn_of_radians(0.5 * angle);
  const glm::dvec3 v = d * (half.sine / glm::length(d));
  return {half.cosine, v.x, v.y, v.z};
}

glm::dmat4 about(const glm::dvec3& point, const glm::dmat4& m) {
  if (!is_affine(m)) return Translation3d{point}.matrix() * m * Translation3d{-point}.matrix();
  glm::dmat4 moved = m;
  for (int row = 0; row < 3; ++row) {
    // (1 − a) · p rather than p − a · p: what doesn't move, doesn't.
    double shift = 0;
    for (int column = 0; column < 3; ++column) shift += ((row == column ? 1 : 0) - m[column][row]) * point[column];
    moved[3][row] += shift;
  }
  return moved;
}

std::optional<glm::dmat4> inverse(const glm::dmat4& m) {
  if (is_affine(m)) {
    const std::optional<glm::dmat3> linear = inverse_of(glm::dmat3(m));
    if (!linear) return std::nullopt;
    glm::dmat4 inverted = with_linear(*linear);
    inverted[3] = glm::dvec4(-(*linear * glm::dvec3(m[3])), 1);
    return inverted;
  }
  const double size = glm::length(m[0]) * glm::length(m[1]) * glm::length(m[2]) * glm::length(m[3]);
  if (is_singular(glm::determinant(m), size)) return std::nullopt;
  return glm::inverse(m);
}

glm::vec3 transform_point(const glm::mat4& m, const glm::vec3& p) {
  const auto row = [&](int r) { return ((m[0][r] * p.x + m[1][r] * p.y) + m[2][r] * p.z) + m[3][r]; };
  if (is_affine(m)) return {row(0), row(1), row(2)};
  const float h = row(3);
  return {row(0) / h, row(1) / h, row(2) / h};
}

glm::vec3 transform_direction(const glm::mat4& m, const glm::vec3& v) {
  const auto row = [&](int r) { return ((m[0][r] * v.x + m[1][r] * v.y) + m[2][r] * v.z) + 0.0F; };
  return {row(0), row(1), row(2)};
}

glm::dmat3 normal_matrix(const glm::dmat3& linear) {
  const double sign = glm::determinant(linear) < 0 ? -1 : 1;
  return cofactors(linear) * sign;
}

glm::vec3 transform_normal(const glm::mat4& m, const glm::vec3& normal) {
  const glm::dvec3 turned = normal_matrix(glm::dmat3(m)) * glm::dvec3(normal);
  const double length = glm::length(turned);
  return length > 0 ? glm::vec3(turned / length) : glm::vec3(0);
}

void transform_points(const glm::mat4& m, std::span<const glm::vec3> source, std::span<glm::vec3> target) {
  if (source.empty()) return;
  if (is_affine(m)) {
    kernels::transform_affine3(m, &source[0].x, &target[0].x, source.size());
  } else {
    kernels::transform_projective3(m, &source[0].x, &target[0].x, source.size());
  }
}

void transform_directions(const glm::mat4& m, std::span<const glm::vec3> source, std::span<glm::vec3> target) {
  if (source.empty()) return;
  glm::mat4 linear = m;
  linear[3] = glm::vec4(0, 0, 0, 1);
  kernels::transform_affine3(linear, &source[0].x, &target[0].x, source.size());
}

bool is_mirroring(const glm::dmat4& m) { return glm::determinant(glm::dmat3(m)) * m[3].w < 0; }

TransformClass classify(const glm::dmat4& given, double tolerance) {
  const double h = given[3].w;
  const double perspective = std::max({std::fabs(given[0].w), std::fabs(given[1].w), std::fabs(given[2].w)});
  if (h == 0 || !(perspective <= tolerance * std::fabs(h))) return TransformClass::Projective;
  const glm::dmat4 m = given / h;
  const glm::dmat3 a(m);
  const Nearly near(tolerance, {a[0].x, a[0].y, a[0].z, a[1].x, a[1].y, a[1].z, a[2].x, a[2].y, a[2].z});
  const double length = glm::length(a[0]);
  const bool even = near.same(length, glm::length(a[1])) && near.same(length, glm::length(a[2]));
  const bool square = near.no_product(glm::dot(a[0], a[1])) && near.no_product(glm::dot(a[1], a[2])) &&
                      near.no_product(glm::dot(a[2], a[0]));
  if (!even || !square) return TransformClass::Affine;
  if (!near.same(length, 1)) return TransformClass::Similarity;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      if (!near.same(a[column][row], column == row ? 1 : 0)) return TransformClass::Rigid;
    }
  }
  const double moved = std::max({std::fabs(m[3].x), std::fabs(m[3].y), std::fabs(m[3].z)});
  return moved <= tolerance ? TransformClass::Identity : TransformClass::Translation;
}

std::optional<Decomposition3d> decompose(const glm::dmat4& given) {
  if (given[0].w != 0 || given[1].w != 0 || given[2].w != 0 || given[3].w == 0) return std::nullopt;
  const glm::dmat4 m = given / given[3].w;
  const glm::dmat3 a(m);
  if (!inverse_of(a)) return std::nullopt;
  Decomposition3d parts;
  parts.translation = glm::dvec3(m[3]);
  glm::dmat3 axes;
  glm::dvec3& scale = parts.scale;
  scale.x = glm::length(a[0]);
  axes[0] = a[0] / scale.x;
  const double xy = glm::dot(axes[0], a[1]);
  const glm::dvec3 y = a[1] - xy * axes[0];
  scale.y = glm::length(y);
  axes[1] = y / scale.y;
  axes[2] = glm::cross(axes[0], axes[1]);
  scale.z = glm::dot(axes[2], a[2]);
  parts.shear = {xy / scale.y, glm::dot(axes[0], a[2]) / scale.z, glm::dot(axes[1], a[2]) / scale.z};
  if (scale.z < 0) {
    // The factor −1 may stand at any axis: turning the two others around is a rotation. Shears change their signs with
    // one of their axes.
    const double gains[] = {axes[0].x + axes[2].z, axes[1].y + axes[2].z, 0};
    const int axis = gains[0] < gains[1] ? (gains[0] < 0 ? 0 : 2) : (gains[1] < 0 ? 1 : 2);
    if (axis != 2) {
      axes[axis] = -axes[axis];
      axes[2] = -axes[2];
      scale[axis] = -scale[axis];
      scale.z = -scale.z;
      parts.shear = axis == 0 ? glm::dvec3(-parts.shear.x, parts.shear.y, -parts.shear.z)
                              : glm::dvec3(-parts.shear.x, -parts.shear.y, parts.shear.z);
    }
  }
  parts.rotation = quaternion_of(axes);
  return parts;
}

glm::dmat4 compose(const Decomposition3d& parts) {
  const Shear3d shear{.x = {parts.shear.x, parts.shear.y}, .y = {0, parts.shear.z}};
  return Translation3d{parts.translation}.matrix() * rotation(parts.rotation) * shear.matrix() *
         Scaling3d{parts.scale, {0, 0, 0}}.matrix();
}

}  // namespace azulejo
