#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace azulejo::decimation {

/// The sum of weighted squared distances of a point from planes: p·A·p + 2 b·p + c.
struct Quadric {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  glm::dvec3 b{0, 0, 0};
  double c = 0;
  double weight = 0;  ///< of the faces in it

  glm::dvec3 times(const glm::dvec3& p) const {
    return {xx * p.x + xy * p.y + xz * p.z, xy * p.x + yy * p.y + yz * p.z, xz * p.x + yz * p.y + zz * p.z};
  }
  /// Adds weight · (g·p + d)².
  void add(const glm::dvec3& g, double d, double w) {
    const glm::dvec3 wg = w * g;
    xx += wg.x * g.x;
    xy += wg.x * g.y;
    xz += wg.x * g.z;
    yy += wg.y * g.y;
    yz += wg.y * g.z;
    zz += wg.z * g.z;
    b += d * wg;
    c += w * d * d;
  }
  Quadric& operator+=(const Quadric& other) {
    xx += other.xx;
    xy += other.xy;
    xz += other.xz;
    yy += other.yy;
    yz += other.yz;
    zz += other.zz;
    b += other.b;
    c += other.c;
    weight += other.weight;
    return *this;
  }
};

/// A quadric seen from a point: values at small steps from there don't cancel.
class LocalQuadric {
 public:
  LocalQuadric(const Quadric& quadric, const glm::dvec3& origin)
      : q_(quadric), g_(quadric.times(origin) + quadric.b), c_(glm::dot(g_ + quadric.b, origin) + quadric.c) {}

  double at(const glm::dvec3& step) const { return c_ + glm::dot(2.0 * g_ + q_.times(step), step); }

  /// The step to the least value, held back a little where many points are nearly as good; NaN where there is none.
  glm::dvec3 least() const {
    // A share of the trace on the diagonal: along directions in which the surface is flat, nothing pulls.
    const double hold = kHold * (q_.xx + q_.yy + q_.zz);
    const double xx = q_.xx + hold;
    const double yy = q_.yy + hold;
    const double zz = q_.zz + hold;
    const double m00 = yy * zz - q_.yz * q_.yz;
    const double m01 = q_.xz * q_.yz - q_.xy * zz;
    const double m02 = q_.xy * q_.yz - q_.xz * yy;
    const double m11 = xx * zz - q_.xz * q_.xz;
    const double m12 = q_.xy * q_.xz - xx * q_.yz;
    const double m22 = xx * yy - q_.xy * q_.xy;
    const double scale = -1 / (xx * m00 + q_.xy * m01 + q_.xz * m02);
    return scale * glm::dvec3(m00 * g_.x + m01 * g_.y + m02 * g_.z, m01 * g_.x + m11 * g_.y + m12 * g_.z,
                              m02 * g_.x + m12 * g_.y + m22 * g_.z);
  }

 private:
  static constexpr double kHold = 1e-5;

  const Quadric& q_;
  glm::dvec3 g_;
  double c_;
};

}  // namespace azulejo::decimation
