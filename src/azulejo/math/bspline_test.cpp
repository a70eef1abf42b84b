#include "azulejo/math/bspline.h"

#include <cmath>
#include <random>
#include <string>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "azulejo/core/error.h"
#include "azulejo/math/rational_curve.h"

namespace azulejo {
namespace {

using Points = std::vector<glm::dvec2>;
using Knots = std::vector<double>;

/// Cox and de Boor's recursion, as it is defined.
double basis(const Knots& knots, std::size_t i, int p, double u) {
  if (p == 0) return u >= knots[i] && u < knots[i + 1] ? 1 : 0;
  const auto n = static_cast<std::size_t>(p);
  const double left = knots[i + n] - knots[i];
  const double right = knots[i + n + 1] - knots[i + 1];
  return (left > 0 ? (u - knots[i]) / left * basis(knots, i, p - 1, u) : 0) +
         (right > 0 ? (knots[i + n + 1] - u) / right * basis(knots, i + 1, p - 1, u) : 0);
}

struct Case {
  Points controls;
  Knots knots;
  int degree = 0;
};

/// Random points and knots, some of them equal.
Case random_case(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  Case made;
  made.degree = static_cast<int>(seed % 5);
  const std::size_t count = static_cast<std::size_t>(made.degree) + 1 + random() % 6;
  for (std::size_t i = 0; i < count; ++i) made.controls.emplace_back(number(random), number(random));
  double knot = 0;
  while (made.knots.size() < count + static_cast<std::size_t>(made.degree) + 1) {
    const std::size_t equal = made.knots.size() < 2 ? 1 : 1 + random() % static_cast<std::size_t>(made.degree + 1);
    for (std::size_t k = 0; k < equal; ++k) made.knots.push_back(knot);
    knot += 0.1 + 0.5 * std::abs(number(random));
  }
  made.knots.resize(count + static_cast<std::size_t>(made.degree) + 1);
  return made;
}

bool is_valid(const Case& c) { return c.knots[static_cast<std::size_t>(c.degree)] < c.knots[c.controls.size()]; }

double domain_at(const Case& c, double share) {
  const double first = c.knots[static_cast<std::size_t>(c.degree)];
  return first + share * (c.knots[c.controls.size()] - first);
}

TEST(BSpline, IsTheSumOfCoxAndDeBoorsFunctions) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Case c = random_case(seed);
    if (!is_valid(c)) continue;
    SCOPED_TRACE(seed);
    check_knots(c.knots, c.degree, c.controls.size(), "knots");
    for (const double share : {0.0, 0.13, 0.5, 0.9, 0.9999}) {
      const double u = domain_at(c, share);
      glm::dvec2 sum(0);
      double weight = 0;
      for (std::size_t i = 0; i < c.controls.size(); ++i) {
        sum += basis(c.knots, i, c.degree, u) * c.controls[i];
        weight += basis(c.knots, i, c.degree, u);
      }
      EXPECT_NEAR(weight, 1, 1e-13);
      EXPECT_LT(glm::distance(bspline_point<glm::dvec2>(c.controls, c.knots, c.degree, u), sum), 1e-13);
      const std::size_t span = knot_span(c.knots, c.degree, u);
      const Knots values = bspline_basis(c.knots, c.degree, span, u);
      double total = 0;
      for (std::size_t k = 0; k < values.size(); ++k) {
        EXPECT_NEAR(values[k], basis(c.knots, span + k - static_cast<std::size_t>(c.degree), c.degree, u), 1e-13);
        total += values[k];
      }
      EXPECT_NEAR(total, 1, 1e-14);
    }
  }
}

TEST(BSpline, ClampedOnesBeginAndEndInTheirPointsAndOfDegreeNAreBezier) {
  const Points controls{{0, 0}, {1, 3}, {2, -1}, {4, 2}};
  const Knots knots = clamped_knots(4, 3);
  EXPECT_EQ(knots, (Knots{0, 0, 0, 0, 1, 1, 1, 1}));
  EXPECT_EQ(clamped_knots(5, 2), (Knots{0, 0, 0, 1.0 / 3, 2.0 / 3, 1, 1, 1}));
  for (const double t : {-1.0, 0.0, 0.3, 1.0, 7.0}) {
    EXPECT_LT(glm::distance(bspline_point<glm::dvec2>(controls, knots, 3, t),
                            bezier_point<glm::dvec2>(controls, std::min(std::max(t, 0.0), 1.0))),
              1e-15);
  }
}

TEST(BSpline, DerivativesAreDifferences) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const Case c = random_case(seed);
    if (!is_valid(c) || c.degree == 0) continue;
    SCOPED_TRACE(seed);
    const double u = domain_at(c, 0.37);
    constexpr double h = 1e-6;
    const glm::dvec2 difference = (bspline_point<glm::dvec2>(c.controls, c.knots, c.degree, u + h) -
                                   bspline_point<glm::dvec2>(c.controls, c.knots, c.degree, u - h)) /
                                  (2 * h);
    EXPECT_LT(glm::distance(bspline_derivative<glm::dvec2>(c.controls, c.knots, c.degree, u), difference), 2e-3);
  }
}

TEST(BSpline, AKnotMoreAndBezierPiecesAreTheSameCurve) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Case c = random_case(seed);
    if (!is_valid(c)) continue;
    SCOPED_TRACE(seed);
    const double added = domain_at(c, 0.01 * (seed % 100));
    const BSpline<glm::dvec2> finer = bspline_with_knot<glm::dvec2>(c.controls, c.knots, c.degree, added);
    ASSERT_EQ(finer.controls.size(), c.controls.size() + 1);
    ASSERT_EQ(finer.knots.size(), c.knots.size() + 1);
    for (const double share : {0.0, 0.21, 0.5, 0.87}) {
      const double u = domain_at(c, share);
      EXPECT_LT(glm::distance(bspline_point<glm::dvec2>(finer.controls, finer.knots, c.degree, u),
                              bspline_point<glm::dvec2>(c.controls, c.knots, c.degree, u)),
                1e-12);
    }
    const auto pieces = bspline_to_beziers<glm::dvec2>(c.controls, c.knots, c.degree);
    std::size_t k = 0;
    for (std::size_t span = static_cast<std::size_t>(c.degree); span < c.controls.size(); ++span) {
      const double first = c.knots[span];
      const double last = c.knots[span + 1];
      if (!(first < last)) continue;
      for (const double t : {0.0, 0.3, 0.99}) {
        EXPECT_LT(glm::distance(bezier_point<glm::dvec2>(pieces[k], t),
                                bspline_point<glm::dvec2>(c.controls, c.knots, c.degree, first + t * (last - first))),
                  1e-12);
      }
      ++k;
    }
    EXPECT_EQ(k, pieces.size());
  }
}

TEST(BSpline, ClosesWithEvenKnots) {
  Points controls{{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  for (std::size_t i = 0; i < 3; ++i) controls.push_back(controls[i]);
  const Knots knots = even_knots(controls.size(), 3);
  EXPECT_NEAR(knots[3], 0, 1e-15);
  EXPECT_NEAR(knots[7], 1, 1e-15);
  const auto at = [&](double u) { return bspline_point<glm::dvec2>(controls, knots, 3, u); };
  EXPECT_LT(glm::distance(at(0), at(1)), 1e-15);
  // The uniform cubic's knots: 1/6, 4/6, 1/6 of three points.
  EXPECT_LT(glm::distance(at(0), (controls[0] + 4.0 * controls[1] + controls[2]) / 6.0), 1e-15);
}

TEST(BSpline, ACircleIsExact) {
  // Nine points on a square: Piegl & Tiller, example 7.2.
  const double w = std::sqrt(0.5);
  const Points square{{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}};
  std::vector<glm::dvec3> controls;
  for (std::size_t i = 0; i < square.size(); ++i) {
    controls.push_back(homogeneous<glm::dvec2>(square[i], i % 2 == 0 ? 1 : w));
  }
  const Knots knots{0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1};
  check_knots(knots, 2, controls.size(), "knots");
  for (int i = 0; i <= 100; ++i) {
    const glm::dvec3 at = bspline_point<glm::dvec3>(controls, knots, 2, i / 100.0);
    EXPECT_NEAR(glm::length(projected<glm::dvec2>(at)), 1, 1e-15);
  }
}

TEST(BSpline, RefusesKnotsThatAreNone) {
  const auto message = [](const Knots& knots, int degree, std::size_t controls) -> std::string {
    try {
      check_knots(knots, degree, controls, "knots");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message({0, 0, 1, 1}, 1, 2), "");
  EXPECT_EQ(message({0, 0, 1}, 1, 2), "knots: 3 knots, expected 4: as many as control points, 2, and degree + 1");
  EXPECT_EQ(message({0, 0, 1}, 1, 1), "knots: 1 control points, expected 2 or more for degree 1");
  EXPECT_EQ(message({0, 2, 1, 3}, 1, 2), "knots: knot 3 is 1, less than 2 before it, expected knots that never fall");
  EXPECT_EQ(message({0, 0, 0, 1, 1}, 1, 3),
            "knots: knot 0 stands there more than 2 times, expected degree + 1 at most");
  EXPECT_EQ(message({0, 1, 1, 2}, 1, 2), "knots: knots 2 and 3 are both 1, expected a domain between them");
  EXPECT_EQ(message({0, 0, NAN, 1}, 1, 2), "knots: knot 3 is nan, expected a finite number");
}

}  // namespace
}  // namespace azulejo
