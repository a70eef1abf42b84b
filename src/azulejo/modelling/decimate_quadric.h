#pragma once

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace azulejo::decimation {

/// How much a face counts: less than its area, so that small ones, which horns and fingers are made of, count for more.
inline double face_weight(double area) { return std::sqrt(area); }

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

/// A quadric around a point near which its planes are: that way single precision is enough.
struct NearQuadric {
  float xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  std::array<float, 3> b{};
  float c = 0;
  float weight = 0;  ///< of the faces in it
};

/// A quadric seen from a point: values at small steps from there don't cancel.
class LocalQuadric {
 public:
  LocalQuadric() = default;
  /// The sum of two, seen from the middle of the points that they are around: `half` leads from that of `a` there, and on
  /// to that of `b`.
  LocalQuadric(const NearQuadric& a, const NearQuadric& b, const glm::dvec3& half) {
    const Quadric first = quadric_of(a);
    const Quadric second = quadric_of(b);
    q_ = first;
    q_ += second;
    Quadric apart;
    apart.xx = first.xx - second.xx;
    apart.xy = first.xy - second.xy;
    apart.xz = first.xz - second.xz;
    apart.yy = first.yy - second.yy;
    apart.yz = first.yz - second.yz;
    apart.zz = first.zz - second.zz;
    g_ = q_.b + apart.times(half);
    c_ = q_.c + glm::dot(2.0 * (first.b - second.b) + q_.times(half), half);
  }

  void add(const Quadric& quadric, const glm::dvec3& origin) {
    const glm::dvec3 g = quadric.times(origin) + quadric.b;
    q_ += quadric;
    g_ += g;
    c_ += glm::dot(g + quadric.b, origin) + quadric.c;
  }
  /// One around the point from which `step` leads to the one from which this is seen.
  void add(const NearQuadric& near, const glm::dvec3& step) { add(quadric_of(near), step); }

  NearQuadric near() const {
    const auto single = [](double value) { return static_cast<float>(value); };
    return {single(q_.xx),
            single(q_.xy),
            single(q_.xz),
            single(q_.yy),
            single(q_.yz),
            single(q_.zz),
            {single(g_.x), single(g_.y), single(g_.z)},
            single(c_),
            single(q_.weight)};
  }

  double weight() const { return q_.weight; }
  double here() const { return c_; }
  /// The values at a step back and ahead.
  std::array<double, 2> at_ends(const glm::dvec3& step) const {
    const double even = c_ + glm::dot(q_.times(step), step);
    const double odd = 2 * glm::dot(g_, step);
    return {even - odd, even + odd};
  }

  struct Least {
    glm::dvec3 step;
    double value;
  };
  /// The step to the least value, held back a little where many points are nearly as good, and the value there; NaN where
  /// there is none.
  Least least() const {
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
    const glm::dvec3 step =
        scale * glm::dvec3(m00 * g_.x + m01 * g_.y + m02 * g_.z, m01 * g_.x + m11 * g_.y + m12 * g_.z,
                           m02 * g_.x + m12 * g_.y + m22 * g_.z);
    // There q · step = -g - hold · step.
    return {step, c_ + glm::dot(g_ - hold * step, step)};
  }

 private:
  static constexpr double kHold = 1e-5;

  static Quadric quadric_of(const NearQuadric& near) {
    Quadric quadric;
    quadric.xx = near.xx;
    quadric.xy = near.xy;
    quadric.xz = near.xz;
    quadric.yy = near.yy;
    quadric.yz = near.yz;
    quadric.zz = near.zz;
    quadric.b = {near.b[0], near.b[1], near.b[2]};
    quadric.c = near.c;
    quadric.weight = near.weight;
    return quadric;
  }

  Quadric q_;  ///< but for b and c
  glm::dvec3 g_{0, 0, 0};
  double c_ = 0;
};

}  // namespace azulejo::decimation
