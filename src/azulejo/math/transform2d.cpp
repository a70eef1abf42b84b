#include "azulejo/math/transform2d.h"

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

/// From rows as they are written; the last is 0, 0, 1.
glm::dmat3 affine(double xx, double xy, double tx, double yx, double yy, double ty) {
  return {xx, yx, 0, xy, yy, 0, tx, ty, 1};
}

glm::dmat3 linear(const glm::dvec2& fixed, double xx, double xy, double yx, double yy) {
  return about(fixed, affine(xx, xy, 0, yx, yy, 0));
}

}  // namespace

glm::dmat3 Translation2d::matrix() const { return affine(1, 0, by.x, 0, 1, by.y); }
glm::dmat3 Translation2d::inverse() const { return affine(1, 0, -by.x, 0, 1, -by.y); }

glm::dmat3 Rotation2d::matrix() const { return linear(about, turn.cosine, -turn.sine, turn.sine, turn.cosine); }
glm::dmat3 Rotation2d::inverse() const { return linear(about, turn.cosine, turn.sine, -turn.sine, turn.cosine); }

glm::dmat3 Scaling2d::matrix() const { return linear(about, factors.x, 0, 0, factors.y); }
glm::dmat3 Scaling2d::inverse() const {
  if (factors.x == 0 || factors.y == 0) {
    throw Error(Error::Argument,
                fmt::format("scale: {},{} has no inverse, expected factors other than 0", factors.x, factors.y));
  }
  return linear(about, 1 / factors.x, 0, 0, 1 / factors.y);
}

glm::dmat3 Shear2d::matrix() const { return linear(about, 1, factors.x, factors.y, 1); }
glm::dmat3 Shear2d::inverse() const {
  const double determinant = 1 - factors.x * factors.y;
  if (determinant == 0) {
    throw Error(Error::Argument,
                fmt::format("shear: {},{} has no inverse, expected a product other than 1", factors.x, factors.y));
  }
  return linear(about, 1 / determinant, -factors.x / determinant, -factors.y / determinant, 1 / determinant);
}

glm::dmat3 Reflection2d::matrix() const {
  const double longest = std::max(std::fabs(direction.x), std::fabs(direction.y));
  if (!(longest > 0)) {
    throw Error(Error::Argument,
                fmt::format("reflect: {},{}, expected a direction other than 0,0", direction.x, direction.y));
  }
  const glm::dvec2 d = direction / longest;  // squares neither vanish nor overflow
  const double square = glm::dot(d, d);
  const double across = 2 * d.x * d.y / square;
  const double along = (d.x * d.x - d.y * d.y) / square;
  return linear(point, along, across, across, -along);
}

glm::dmat3 about(const glm::dvec2& point, const glm::dmat3& m) {
  if (!is_affine(m)) return Translation2d{point}.matrix() * m * Translation2d{-point}.matrix();
  // (1 − a) · p rather than p − a · p: what doesn't move, doesn't.
  glm::dmat3 moved = m;
  moved[2].x += (1 - m[0].x) * point.x - m[1].x * point.y;
  moved[2].y += (1 - m[1].y) * point.y - m[0].y * point.x;
  return moved;
}

std::optional<glm::dmat3> inverse(const glm::dmat3& m) {
  if (is_affine(m)) {
    const double determinant = m[0].x * m[1].y - m[1].x * m[0].y;
    if (is_singular(determinant, glm::length(glm::dvec2(m[0])) * glm::length(glm::dvec2(m[1])))) return std::nullopt;
    const double xx = m[1].y / determinant;
    const double xy = -m[1].x / determinant;
    const double yx = -m[0].y / determinant;
    const double yy = m[0].x / determinant;
    return affine(xx, xy, -(xx * m[2].x + xy * m[2].y), yx, yy, -(yx * m[2].x + yy * m[2].y));
  }
  const glm::dvec3 x = glm::cross(m[1], m[2]);
  const double determinant = glm::dot(m[0], x);
  if (is_singular(determinant, glm::length(m[0]) * glm::length(m[1]) * glm::length(m[2]))) return std::nullopt;
  return glm::transpose(glm::dmat3(x, glm::cross(m[2], m[0]), glm::cross(m[0], m[1])) * (1 / determinant));
}

glm::vec2 transform_point(const glm::mat3& m, const glm::vec2& p) {
  const float x = (m[0].x * p.x + m[1].x * p.y) + m[2].x;
  const float y = (m[0].y * p.x + m[1].y * p.y) + m[2].y;
  if (is_affine(m)) return {x, y};
  const float h = (m[0].z * p.x + m[1].z * p.y) + m[2].z;
  return {x / h, y / h};
}

glm::vec2 transform_direction(const glm::mat3& m, const glm::vec2& v) {
  return {m[0].x * v.x + m[1].x * v.y, m[0].y * v.x + m[1].y * v.y};
}

glm::vec2 transform_normal(const glm::mat3& m, const glm::vec2& normal) {
  // The inverse transpose but for its length: cofactors, which exist for every matrix.
  const double sign = is_mirroring(glm::dmat3(m)) ? -1 : 1;
  const double x = sign * (double{m[1].y} * normal.x - double{m[0].y} * normal.y);
  const double y = sign * (double{m[0].x} * normal.y - double{m[1].x} * normal.x);
  const double length = std::hypot(x, y);
  return length > 0 ? glm::vec2(x / length, y / length) : glm::vec2(0);
}

void transform_points(const glm::mat3& m, std::span<const glm::vec2> source, std::span<glm::vec2> target) {
  if (source.empty()) return;
  const float* const from = &source[0].x;
  float* const to = &target[0].x;
  if (is_affine(m)) {
    kernels::transform_affine2(m, from, to, source.size());
  } else {
    kernels::transform_projective2(m, from, to, source.size());
  }
}

bool is_mirroring(const glm::dmat3& m) { return (m[0].x * m[1].y - m[1].x * m[0].y) * m[2].z < 0; }

TransformClass classify(const glm::dmat3& given, double tolerance) {
  const double h = given[2].z;
  const double perspective = std::max(std::fabs(given[0].z), std::fabs(given[1].z));
  if (h == 0 || !(perspective <= tolerance * std::fabs(h))) return TransformClass::Projective;
  const glm::dmat3 m = given / h;
  const glm::dvec2 x(m[0]);
  const glm::dvec2 y(m[1]);
  const Nearly near(tolerance, {x.x, x.y, y.x, y.y});
  if (!near.same(glm::length(x), glm::length(y)) || !near.no_product(glm::dot(x, y))) return TransformClass::Affine;
  if (!near.same(glm::length(x), 1)) return TransformClass::Similarity;
  if (!near.same(x.x, 1) || !near.same(y.y, 1) || !near.same(x.y, 0) || !near.same(y.x, 0))
    return TransformClass::Rigid;
  const bool moves = !(std::fabs(m[2].x) <= tolerance && std::fabs(m[2].y) <= tolerance);
  return moves ? TransformClass::Translation : TransformClass::Identity;
}

std::optional<Decomposition2d> decompose(const glm::dmat3& given) {
  if (given[0].z != 0 || given[1].z != 0 || given[2].z == 0) return std::nullopt;
  const glm::dmat3 m = given / given[2].z;
  if (!inverse(m)) return std::nullopt;
  Decomposition2d parts;
  parts.translation = glm::dvec2(m[2]);
  parts.scale.x = glm::length(glm::dvec2(m[0]));
  glm::dvec2 axis = glm::dvec2(m[0]) / parts.scale.x;
  parts.scale.y = axis.x * m[1].y - axis.y * m[1].x;
  parts.shear = (axis.x * m[1].x + axis.y * m[1].y) / parts.scale.y;
  // Half a turn more, and both factors with the other sign, are the same.
  if (parts.scale.y < 0 && axis.x < 0) {
    axis = -axis;
    parts.scale = -parts.scale;
  }
  parts.rotation = std::atan2(axis.y, axis.x);
  return parts;
}

glm::dmat3 compose(const Decomposition2d& parts) {
  const glm::dmat3 shear = affine(1, parts.shear, 0, 0, 1, 0);
  return Translation2d{parts.translation}.matrix() * Rotation2d(parts.rotation).matrix() * shear *
         Scaling2d{parts.scale, {0, 0}}.matrix();
}

}  // namespace azulejo
