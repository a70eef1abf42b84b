#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace azulejo {

// Bézier curves of any degree n, of n + 1 control points, over t in 0–1. P is a point with +, − and a product with a
// double: glm::dvec2, dvec3, dvec4. Outside 0–1 the curve goes on. What a control point that is not finite belongs to
// is not finite. No points: everything gives P{} or nothing.
//
// Error    each point is a chain of convex sums: within 2n · 2⁻⁵³ of the largest control point
// Same     + − × only: the same bytes everywhere
// Source   Farin, Curves and Surfaces for CAGD, 5th ed., chapters 4–6

/// Bernstein's polynomials of a degree at t, all of them: they sum to 1.
inline std::vector<double> bernstein(int degree, double t) {
  std::vector<double> values(static_cast<std::size_t>(degree) + 1, 0.0);
  values[0] = 1;
  for (std::size_t n = 1; n < values.size(); ++n) {
    for (std::size_t i = n; i > 0; --i) values[i] = (1 - t) * values[i] + t * values[i - 1];
    values[0] = (1 - t) * values[0];
  }
  return values;
}

/// The point at t. De Casteljau's algorithm: cost O(n²).
template <class P>
P bezier_point(std::span<const P> controls, double t) {
  if (controls.empty()) return P{};
  std::vector<P> points(controls.begin(), controls.end());
  for (std::size_t n = points.size() - 1; n > 0; --n) {
    for (std::size_t i = 0; i < n; ++i) points[i] = (1 - t) * points[i] + t * points[i + 1];
  }
  return points[0];
}

/// The control points of the derivative, a curve of one degree less; of a single point the one point 0.
template <class P>
std::vector<P> bezier_hodograph(std::span<const P> controls) {
  if (controls.size() < 2) return std::vector<P>(controls.size());
  std::vector<P> differences(controls.size() - 1);
  const auto degree = static_cast<double>(differences.size());
  for (std::size_t i = 0; i < differences.size(); ++i) differences[i] = degree * (controls[i + 1] - controls[i]);
  return differences;
}

/// The derivative of an order, 0 and up, at t.
template <class P>
P bezier_derivative(std::span<const P> controls, double t, int order = 1) {
  std::vector<P> points(controls.begin(), controls.end());
  for (int k = 0; k < order; ++k) points = bezier_hodograph<P>(points);
  return bezier_point<P>(points, t);
}

/// The control points of the parts before and behind t: together they are the curve.
template <class P>
std::pair<std::vector<P>, std::vector<P>> bezier_split(std::span<const P> controls, double t) {
  std::vector<P> behind(controls.begin(), controls.end());
  std::vector<P> before;
  before.reserve(behind.size());
  for (std::size_t n = behind.size(); n > 0; --n) {
    before.push_back(behind[0]);
    for (std::size_t i = 0; i + 1 < n; ++i) behind[i] = (1 - t) * behind[i] + t * behind[i + 1];
  }
  return {std::move(before), std::move(behind)};
}

/// The same curve with one control point more.
template <class P>
std::vector<P> bezier_elevated(std::span<const P> controls) {
  if (controls.empty()) return {};
  const auto count = static_cast<double>(controls.size());
  std::vector<P> raised(controls.size() + 1);
  raised.front() = controls.front();
  raised.back() = controls.back();
  for (std::size_t i = 1; i < controls.size(); ++i) {
    const double share = static_cast<double>(i) / count;
    raised[i] = share * controls[i - 1] + (1 - share) * controls[i];
  }
  return raised;
}

/// n over k, as a double.
inline double binomial(std::size_t n, std::size_t k) {
  double value = 1;
  for (std::size_t i = 1; i <= k; ++i) value = value * static_cast<double>(n - k + i) / static_cast<double>(i);
  return value;
}

/// The Bézier coefficients of the product of two polynomials, one of them a scalar; the degrees add up.
template <class P>
std::vector<P> bezier_product(std::span<const double> factor, std::span<const P> controls) {
  const std::size_t m = factor.size() - 1;
  const std::size_t n = controls.size() - 1;
  std::vector<P> product(m + n + 1, P{});
  for (std::size_t i = 0; i <= m; ++i) {
    for (std::size_t j = 0; j <= n; ++j) {
      product[i + j] += factor[i] * (binomial(m, i) * binomial(n, j) / binomial(m + n, i + j)) * controls[j];
    }
  }
  return product;
}

/// The largest length of a difference of the second order, times n (n − 1): what the second derivative is at most.
template <class P>
double bezier_second_derivative_bound(std::span<const P> controls) {
  const std::vector<P> second = bezier_hodograph<P>(bezier_hodograph<P>(controls));
  double largest = 0;
  for (const P& each : second) {
    double square = 0;
    for (int k = 0; k < P::length(); ++k) square += each[k] * each[k];
    largest = square > largest ? square : largest;
  }
  return std::sqrt(largest);
}

}  // namespace azulejo
