#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <utility>
#include <vector>

#include "azulejo/math/bezier.h"

namespace azulejo {

// Rational curves are curves of homogeneous points (w x, w y, w) or (w x, w y, w z, w) with weights w > 0. Point is
// glm::dvec2 or dvec3.
// Source   Piegl & Tiller, The NURBS Book, 2nd ed., 4.2, 4.3

template <class Point>
struct HomogeneousOf;
template <>
struct HomogeneousOf<glm::dvec2> {
  using Type = glm::dvec3;
};
template <>
struct HomogeneousOf<glm::dvec3> {
  using Type = glm::dvec4;
};
template <class Point>
using Homogeneous = typename HomogeneousOf<Point>::Type;

template <class Point>
Homogeneous<Point> homogeneous(const Point& point, double weight) {
  return Homogeneous<Point>(weight * point, weight);
}
template <class Point>
double weight_of(const Homogeneous<Point>& point) {
  return point[Point::length()];
}
template <class Point>
Point projected(const Homogeneous<Point>& point) {
  return Point(point) / weight_of<Point>(point);
}
/// The derivative of the projection of a curve that is at `point` and has the derivative `along` there.
template <class Point>
Point projected_derivative(const Homogeneous<Point>& point, const Homogeneous<Point>& along) {
  return (Point(along) - weight_of<Point>(along) * projected<Point>(point)) / weight_of<Point>(point);
}

/// How far the curve of homogeneous `controls` is from the curve of `plain` at the same t, at most: P ÷ w − q is
/// (P − w q) ÷ w, and what is in brackets is a Bézier curve, within its control points.
template <class Point>
double rational_distance_bound(std::span<const Homogeneous<Point>> controls, std::span<const Point> plain) {
  std::vector<double> weights;
  std::vector<Point> apart;
  for (const Homogeneous<Point>& each : controls) {
    weights.push_back(weight_of<Point>(each));
    apart.push_back(Point(each));
  }
  const std::vector<Point> product = bezier_product<Point>(weights, plain);
  while (apart.size() < product.size()) apart = bezier_elevated<Point>(apart);
  double largest = 0;
  for (std::size_t i = 0; i < product.size(); ++i) {
    double square = 0;
    for (int k = 0; k < Point::length(); ++k) square += (apart[i][k] - product[i][k]) * (apart[i][k] - product[i][k]);
    if (std::isnan(square)) return square;
    largest = std::max(largest, square);
  }
  return std::sqrt(largest) / *std::min_element(weights.begin(), weights.end());
}

/// The cubic with the ends and the end derivatives of a rational Bézier curve.
template <class Point>
std::array<Point, 4> cubic_of(std::span<const Homogeneous<Point>> controls) {
  using H = Homogeneous<Point>;
  const auto degree = static_cast<double>(controls.size() - 1);
  const Point first = projected<Point>(controls.front());
  const Point last = projected<Point>(controls.back());
  if (controls.size() < 2) return {first, first, last, last};
  const H out = degree * (controls[1] - controls[0]);
  const H in = degree * (controls[controls.size() - 1] - controls[controls.size() - 2]);
  return {first, first + projected_derivative<Point>(controls.front(), out) / 3.0,
          last - projected_derivative<Point>(controls.back(), in) / 3.0, last};
}

/// The chord of a rational Bézier curve.
template <class Point>
std::array<Point, 2> chord_of(std::span<const Homogeneous<Point>> controls) {
  return {projected<Point>(controls.front()), projected<Point>(controls.back())};
}

/// Cuts a rational Bézier curve in halves until each part is within `tolerance` of what `simple` makes of it (cubic_of,
/// chord_of), and gives those in order to `take`. Parts that 2¹⁶ of would make the curve are taken as they are: the
/// tolerance was below what doubles can tell, or a coordinate is not finite.
template <class Point, class Simple, class Take>
void simplify_rational(std::span<const Homogeneous<Point>> controls, double tolerance, Simple simple, Take take) {
  constexpr int kDeepest = 16;
  struct Part {
    std::vector<Homogeneous<Point>> controls;
    int depth;
  };
  std::vector<Part> waiting;
  waiting.push_back({{controls.begin(), controls.end()}, 0});
  while (!waiting.empty()) {
    const Part part = std::move(waiting.back());
    waiting.pop_back();
    const auto plain = simple(std::span<const Homogeneous<Point>>(part.controls));
    const double bound = rational_distance_bound<Point>(part.controls, plain);
    if (bound <= tolerance || part.depth == kDeepest || !std::isfinite(bound)) {
      take(plain);
      continue;
    }
    auto [before, behind] = bezier_split<Homogeneous<Point>>(part.controls, 0.5);
    waiting.push_back({std::move(behind), part.depth + 1});
    waiting.push_back({std::move(before), part.depth + 1});
  }
}

}  // namespace azulejo
