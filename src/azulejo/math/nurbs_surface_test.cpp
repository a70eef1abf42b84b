#include "azulejo/math/nurbs_surface.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "azulejo/core/error.h"
#include "azulejo/math/bezier.h"
#include "azulejo/math/bspline.h"
#include "azulejo/math/rational_curve.h"

namespace azulejo {
namespace {

NurbsSurface random_surface(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  NurbsSurface surface;
  surface.degree_u = 1 + static_cast<int>(seed % 4);
  surface.degree_v = 1 + static_cast<int>(seed / 4 % 4);
  surface.columns = static_cast<std::size_t>(surface.degree_u) + 1 + random() % 4;
  surface.rows = static_cast<std::size_t>(surface.degree_v) + 1 + random() % 4;
  surface.knots_u = clamped_knots(surface.columns, surface.degree_u);
  surface.knots_v = clamped_knots(surface.rows, surface.degree_v);
  const bool rational = seed % 2 == 1;
  for (std::size_t i = 0; i < surface.columns * surface.rows; ++i) {
    const glm::dvec3 point(number(random), number(random), number(random));
    surface.controls.push_back(homogeneous<glm::dvec3>(point, rational ? 1.5 + number(random) : 1));
  }
  return surface;
}

TEST(NurbsSurface, IsTheSumOfItsPoints) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const NurbsSurface surface = random_surface(seed);
    check_surface(surface, "surface");
    for (const double u : {0.0, 0.31, 0.77, 1.0}) {
      const double v = 0.9 * u + 0.05;
      const std::size_t at_u = knot_span(surface.knots_u, surface.degree_u, u);
      const std::size_t at_v = knot_span(surface.knots_v, surface.degree_v, v);
      const auto basis_u = bspline_basis(surface.knots_u, surface.degree_u, at_u, u);
      const auto basis_v = bspline_basis(surface.knots_v, surface.degree_v, at_v, v);
      glm::dvec4 sum(0);
      for (std::size_t j = 0; j < basis_v.size(); ++j) {
        for (std::size_t i = 0; i < basis_u.size(); ++i) {
          const std::size_t row = at_v + j + 1 - basis_v.size();
          const std::size_t column = at_u + i + 1 - basis_u.size();
          sum += basis_u[i] * basis_v[j] * surface.controls[row * surface.columns + column];
        }
      }
      EXPECT_LT(glm::distance(surface_point(surface, u, v).position, projected<glm::dvec3>(sum)), 1e-13);
    }
  }
}

TEST(NurbsSurface, DerivativesAreDifferences) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const NurbsSurface surface = random_surface(seed);
    constexpr double h = 1e-6;
    const double u = 0.4321;
    const double v = 0.5678;
    const auto at = [&](double x, double y) { return surface_point(surface, x, y).position; };
    const SurfacePoint point = surface_point(surface, u, v);
    EXPECT_LT(glm::distance(point.along_u, (at(u + h, v) - at(u - h, v)) / (2 * h)), 1e-6);
    EXPECT_LT(glm::distance(point.along_v, (at(u, v + h) - at(u, v - h)) / (2 * h)), 1e-6);
  }
}

TEST(NurbsSurface, BendsNoMoreThanItsBounds) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const NurbsSurface surface = random_surface(seed);
    const SurfaceBends bends = surface_bends(surface);
    constexpr double h = 1e-5;
    double largest = 0;
    for (int i = 1; i < 20; ++i) {
      for (int j = 1; j < 20; ++j) {
        const double u = i / 20.0 + 0.003;
        const double v = j / 20.0 + 0.003;
        const SurfacePoint right = surface_point(surface, u + h, v);
        const SurfacePoint left = surface_point(surface, u - h, v);
        const SurfacePoint below = surface_point(surface, u, v + h);
        const SurfacePoint above = surface_point(surface, u, v - h);
        const double uu = glm::length(right.along_u - left.along_u) / (2 * h);
        EXPECT_LE(uu, bends.uu + 1e-4);
        EXPECT_LE(glm::length(right.along_v - left.along_v) / (2 * h), bends.uv + 1e-4);
        EXPECT_LE(glm::length(below.along_v - above.along_v) / (2 * h), bends.vv + 1e-4);
        largest = std::max(largest, uu);
      }
    }
    if (seed % 2 == 0 && surface.degree_u > 1) {
      EXPECT_GT(largest, 0.05 * bends.uu);
    }
  }
}

TEST(NurbsSurface, ATurnedHalfCircleIsASphere) {
  const double w = std::sqrt(0.5);
  // Five points of half a circle, from the top down.
  const std::vector<glm::dvec3> profile{{0, 1, 1}, {w, w, w}, {1, 0, 1}, {w, -w, w}, {0, -1, 1}};
  const NurbsSurface sphere = revolved(profile, {0, 0, 0, 0.5, 0.5, 1, 1, 1}, 2);
  check_surface(sphere, "sphere");
  for (int i = 0; i <= 16; ++i) {
    for (int j = 1; j < 16; ++j) {
      const SurfacePoint at = surface_point(sphere, i / 16.0, j / 16.0);
      EXPECT_NEAR(glm::length(at.position), 1, 1e-14);
      // Down along v and around along u: from outside v × u.
      EXPECT_LT(glm::distance(glm::normalize(glm::cross(at.along_v, at.along_u)), at.position), 1e-13);
    }
  }
}

TEST(NurbsSurface, RefusesWhatDoesNotFit) {
  NurbsSurface surface = random_surface(5);
  surface.controls.pop_back();
  EXPECT_THROW(check_surface(surface, "surface"), Error);
  surface = random_surface(5);
  surface.knots_v.pop_back();
  EXPECT_THROW(check_surface(surface, "surface"), Error);
}

}  // namespace
}  // namespace azulejo
