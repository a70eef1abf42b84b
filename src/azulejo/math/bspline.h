#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "azulejo/core/export.h"

namespace azulejo {

// B-splines of a degree p: n control points and n + p + 1 knots u₀ ≤ u₁ ≤ …, defined from knot p to knot n. Of
// homogeneous points (math/rational_curve.h) they are NURBS. P as in math/bezier.h.
//
// Where    parameters outside the domain are taken to its end
// Same     + − × ÷ only: the same bytes everywhere
// Source   de Boor, A Practical Guide to Splines, IX–X; Boehm, Inserting new knots into B-spline curves, 1980;
//          Piegl & Tiller, The NURBS Book, 2nd ed., chapters 2, 3, 5

/// Throws Error(Argument) unless there are `controls` + degree + 1 finite knots that never fall, no more than degree + 1
/// of them equal, and more than `degree` control points, over a domain that is not empty. The message begins with `what`.
AZULEJO_EXPORT void check_knots(std::span<const double> knots, int degree, std::size_t controls, const char* what);

/// Knots that are 0 at the beginning and 1 at the end, degree + 1 times each, and even between: the curve begins in the
/// first control point and ends in the last. More than `degree` controls.
AZULEJO_EXPORT std::vector<double> clamped_knots(std::size_t controls, int degree);

/// Even knots whose domain is 0–1: with the first `degree` control points repeated at the end the curve is closed.
AZULEJO_EXPORT std::vector<double> even_knots(std::size_t controls, int degree);

/// The k with knot k ≤ u < knot k + 1, at the domain's end the last one that isn't empty.
AZULEJO_EXPORT std::size_t knot_span(std::span<const double> knots, int degree, double u);

/// The degree + 1 basis functions that aren't 0 on a span, those of the control points span − degree … span, at u: they
/// sum to 1.
AZULEJO_EXPORT std::vector<double> bspline_basis(std::span<const double> knots, int degree, std::size_t span, double u);

/// The multi-affine form of the polynomial on a span at degree numbers: f(u, …, u) is the curve; its Bézier points over
/// [a, b] are f(a, …, a), f(a, …, a, b), …, f(b, …, b).
template <class P>
P bspline_blossom(std::span<const P> controls, std::span<const double> knots, int degree, std::size_t span,
                  std::span<const double> at) {
  const auto p = static_cast<std::size_t>(degree);
  std::vector<P> d(controls.begin() + static_cast<std::ptrdiff_t>(span - p),
                   controls.begin() + static_cast<std::ptrdiff_t>(span + 1));
  for (std::size_t r = 1; r <= p; ++r) {
    for (std::size_t j = p; j >= r; --j) {
      const double first = knots[span - p + j];
      const double last = knots[span + 1 + j - r];
      const double share = (at[r - 1] - first) / (last - first);
      d[j] = (1 - share) * d[j - 1] + share * d[j];
    }
  }
  return d[p];
}

/// The point at u, by de Boor's algorithm. Cost O(p²).
template <class P>
P bspline_point(std::span<const P> controls, std::span<const double> knots, int degree, double u) {
  const double first = knots[static_cast<std::size_t>(degree)];
  const double last = knots[controls.size()];
  const double inside = u < first ? first : u > last ? last : u;
  const std::vector<double> at(static_cast<std::size_t>(degree), inside);
  return bspline_blossom<P>(controls, knots, degree, knot_span(knots, degree, inside), at);
}

/// The control points of the derivative, a spline of one degree less over the same knots without the first and last.
/// degree ≥ 1. Where knots make a control point's support empty, it is 0.
template <class P>
std::vector<P> bspline_hodograph(std::span<const P> controls, std::span<const double> knots, int degree) {
  std::vector<P> differences(controls.size() - 1, P{});
  for (std::size_t i = 0; i < differences.size(); ++i) {
    const double width = knots[i + static_cast<std::size_t>(degree) + 1] - knots[i + 1];
    if (width > 0) differences[i] = (degree / width) * (controls[i + 1] - controls[i]);
  }
  return differences;
}

/// The derivative at u; of degree 0 it is 0. Where the curve has a corner, it is that behind it.
template <class P>
P bspline_derivative(std::span<const P> controls, std::span<const double> knots, int degree, double u) {
  if (degree < 1) return P{};
  const std::vector<P> along = bspline_hodograph<P>(controls, knots, degree);
  return bspline_point<P>(along, knots.subspan(1, knots.size() - 2), degree - 1, u);
}

/// Knots and control points of a curve.
template <class P>
struct BSpline {
  std::vector<P> controls;
  std::vector<double> knots;
};

/// The same curve with one more knot, u in the domain, by Boehm's algorithm. The knot isn't there degree + 1 times yet.
template <class P>
BSpline<P> bspline_with_knot(std::span<const P> controls, std::span<const double> knots, int degree, double u) {
  const auto p = static_cast<std::size_t>(degree);
  const std::size_t span = knot_span(knots, degree, u);
  BSpline<P> result;
  result.knots.assign(knots.begin(), knots.end());
  result.knots.insert(result.knots.begin() + static_cast<std::ptrdiff_t>(span) + 1, u);
  for (std::size_t i = 0; i <= controls.size(); ++i) {
    const double share = i + p <= span                          ? 1
                         : i > span || knots[i + p] <= knots[i] ? 0
                                                                : (u - knots[i]) / (knots[i + p] - knots[i]);
    result.controls.push_back(share == 1   ? controls[i]
                              : share == 0 ? controls[i - 1]
                                           : (1 - share) * controls[i - 1] + share * controls[i]);
  }
  return result;
}

/// The Bézier curves of degree p that the curve is made of, one for each span that isn't empty.
template <class P>
std::vector<std::vector<P>> bspline_to_beziers(std::span<const P> controls, std::span<const double> knots, int degree) {
  const auto p = static_cast<std::size_t>(degree);
  std::vector<std::vector<P>> pieces;
  std::vector<double> at(p);
  for (std::size_t span = p; span < controls.size(); ++span) {
    if (!(knots[span] < knots[span + 1])) continue;
    std::vector<P>& piece = pieces.emplace_back();
    for (std::size_t j = 0; j <= p; ++j) {
      for (std::size_t k = 0; k < p; ++k) at[k] = k < p - j ? knots[span] : knots[span + 1];
      piece.push_back(bspline_blossom<P>(controls, knots, degree, span, at));
    }
  }
  return pieces;
}

}  // namespace azulejo
