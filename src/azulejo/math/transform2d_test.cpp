#include "azulejo/math/transform2d.h"

#include <array>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>
#include <hwy/highway.h>
#include <glm/geometric.hpp>

#include "azulejo/core/error.h"
#include "azulejo/math/transform_testing.h"

namespace azulejo {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kExact = 0;
constexpr double kRounding = 1e-13;  // a few operations on numbers up to 100: 100 · 2⁻⁵³ · 10

/// As it is written: row by row.
glm::dmat3 rows(double a, double b, double c, double d, double e, double f, double g = 0, double h = 0, double i = 1) {
  return {a, d, g, b, e, h, c, f, i};
}

/// An elementary transformation of each kind by turns.
glm::dmat3 elementary(Random& random, unsigned kind, glm::dmat3* inverse = nullptr) {
  const auto give = [&](const auto& each) {
    if (inverse != nullptr) *inverse = each.inverse();
    return each.matrix();
  };
  const glm::dvec2 about = random.point2();
  switch (kind % 5) {
    case 0: return give(Translation2d{about});
    case 1: return give(Rotation2d(random(-7, 7), about));
    case 2: return give(Scaling2d{{random.factor(), random.factor()}, about});
    case 3: return give(Shear2d{{random(-0.9, 0.9), random(-0.9, 0.9)}, about});
    default: return give(Reflection2d{about, random.point2()});
  }
}

TEST(Transform2d, FormulasOfTheElementaryOnes) {
  const double angle = 0.7;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  EXPECT_EQ(difference(Translation2d{{3, -4}}.matrix(), rows(1, 0, 3, 0, 1, -4)), kExact);
  EXPECT_LE(difference(Rotation2d(angle).matrix(), rows(c, -s, 0, s, c, 0)), 4e-16);
  EXPECT_EQ(difference(Scaling2d{{2, -5}, {0, 0}}.matrix(), rows(2, 0, 0, 0, -5, 0)), kExact);
  EXPECT_EQ(difference(Shear2d{{0.5, 0}, {0, 0}}.matrix(), rows(1, 0.5, 0, 0, 1, 0)), kExact);
  EXPECT_EQ(difference(Shear2d{{0, 0.5}, {0, 0}}.matrix(), rows(1, 0, 0, 0.5, 1, 0)), kExact);
  EXPECT_EQ(difference(Reflection2d{{0, 0}, {9, 0}}.matrix(), rows(1, 0, 0, 0, -1, 0)), kExact);
  EXPECT_EQ(difference(Reflection2d{{0, 0}, {0, -3}}.matrix(), rows(-1, 0, 0, 0, 1, 0)), kExact);
  EXPECT_EQ(difference(Reflection2d{{0, 0}, {2, 2}}.matrix(), rows(0, 1, 0, 1, 0, 0)), kExact);
}

TEST(Transform2d, FormulasOfTheInverses) {
  const double angle = 0.7;
  EXPECT_EQ(difference(Translation2d{{3, -4}}.inverse(), rows(1, 0, -3, 0, 1, 4)), kExact);
  EXPECT_EQ(difference(Rotation2d(angle).inverse(), glm::transpose(Rotation2d(angle).matrix())), kExact);
  EXPECT_EQ(difference(Rotation2d(angle).inverse(), Rotation2d(-angle).matrix()), kExact);
  EXPECT_EQ(difference(Scaling2d{{2, -4}, {0, 0}}.inverse(), rows(0.5, 0, 0, 0, -0.25, 0)), kExact);
  EXPECT_EQ(difference(Shear2d{{0.5, 0}, {0, 0}}.inverse(), rows(1, -0.5, 0, 0, 1, 0)), kExact);
}

TEST(Transform2d, FormulasAboutAPoint) {
  const double angle = 0.7;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const double x = 3;
  const double y = -2;
  EXPECT_LE(difference(Rotation2d(angle, {x, y}).matrix(), rows(c, -s, x * (1 - c) + y * s, s, c, y * (1 - c) - x * s)),
            2e-15);
  const glm::dmat3 in_steps =
      Translation2d{{x, y}}.matrix() * Rotation2d(angle).matrix() * Translation2d{{-x, -y}}.matrix();
  EXPECT_LE(difference(Rotation2d(angle, {x, y}).matrix(), in_steps), 2e-15);
  EXPECT_EQ(difference(Scaling2d{{2, 4}, {x, y}}.matrix(), rows(2, 0, -x, 0, 4, -3 * y)), kExact);
  // A mirror beside the axis: x = 5.
  EXPECT_EQ(difference(Reflection2d{{5, 1}, {0, 1}}.matrix(), rows(-1, 0, 10, 0, 1, 0)), kExact);
}

TEST(Transform2d, QuartersOfATurnAreExact) {
  for (int quarter = -8; quarter <= 8; ++quarter) {
    const std::array<glm::dmat3, 4> turned{rows(1, 0, 0, 0, 1, 0), rows(0, -1, 0, 1, 0, 0), rows(-1, 0, 0, 0, -1, 0),
                                           rows(0, 1, 0, -1, 0, 0)};
    const glm::dmat3& expected = turned[static_cast<std::size_t>((quarter + 8) % 4)];
    EXPECT_EQ(difference(Rotation2d(quarter * (kPi / 2)).matrix(), expected), kExact) << quarter;
    EXPECT_EQ(difference(Rotation2d(turn_of_degrees(90.0 * quarter)).matrix(), expected), kExact) << quarter;
  }
  for (int degrees = -1000; degrees <= 1000; ++degrees) {
    const Turn exact = turn_of(degrees, 360);
    const Turn turn = turn_of_degrees(degrees);
    const Turn radians = turn_of_radians(degrees * kPi / 180);
    EXPECT_NEAR(turn.cosine, exact.cosine, 3e-16) << degrees;
    EXPECT_NEAR(turn.sine, exact.sine, 3e-16) << degrees;
    // The angle itself, up to 18, is rounded to 2⁻⁵⁰.
    EXPECT_NEAR(radians.cosine, std::cos(degrees * kPi / 180), 1.3e-15) << degrees;
    EXPECT_NEAR(radians.sine, std::sin(degrees * kPi / 180), 1.3e-15) << degrees;
  }
  EXPECT_NEAR(turn_of_radians(1e5).sine, std::sin(1e5), 1e-14);
  EXPECT_TRUE(std::isnan(turn_of_degrees(std::numeric_limits<double>::infinity()).sine));
  EXPECT_TRUE(std::isnan(turn_of_radians(std::numeric_limits<double>::quiet_NaN()).cosine));
}

TEST(Transform2d, EachTimesItsInverseIsTheIdentity) {
  Random random(31);
  for (unsigned i = 0; i < 1000; ++i) {
    SCOPED_TRACE(i);
    glm::dmat3 closed;
    const glm::dmat3 m = elementary(random, i, &closed);
    EXPECT_LE(difference(m * closed, glm::dmat3(1)), 5e-13);
    const std::optional<glm::dmat3> general = inverse(m);
    ASSERT_TRUE(general);
    EXPECT_LE(difference(closed, *general), 5e-13);
  }
}

TEST(Transform2d, RandomCompositionsFollowTheReferenceInLongDouble) {
  using Long = long double;
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    glm::dmat3 m(1);
    glm::mat<3, 3, Long> reference(1);
    for (unsigned i = 0; i < 2 + seed % 7; ++i) {
      const glm::dmat3 next = elementary(random, random.below(5));
      m = next * m;
      reference = glm::mat<3, 3, Long>(next) * reference;
    }
    double size = 1;
    for (int column = 0; column < 3; ++column) size = std::max(size, glm::length(m[column]));
    // Eight products, each of three terms that are rounded to 2⁻⁵³ of the largest number on the way, at most 100 times
    // what comes out.
    EXPECT_LE(difference(m, glm::dmat3(reference)), 100 * 8 * 3 * 1.2e-16 * size);
    const glm::dvec2 p = random.point2();
    const glm::vec<3, Long> expected = reference * glm::vec<3, Long>(p.x, p.y, 1);
    const glm::vec2 got = transform_point(glm::mat3(m), glm::vec2(p));
    const double tolerance = 6e-7 * size * 15;  // f32: 5 roundings of numbers up to 15 · size
    EXPECT_NEAR(got.x, static_cast<double>(expected.x), tolerance);
    EXPECT_NEAR(got.y, static_cast<double>(expected.y), tolerance);
  }
}

TEST(Transform2d, WhatCommutesAndWhatDoesNot) {
  Random random(7);
  const auto apart = [](const glm::dmat3& a, const glm::dmat3& b) { return difference(a * b, b * a); };
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    const glm::dvec2 p = random.point2();
    const glm::dvec2 q = p + glm::dvec2(2, 1);
    const auto turn = [&](const glm::dvec2& about) { return Rotation2d(random(0.3, 1.2), about).matrix(); };
    const auto scaling = [&](const glm::dvec2& about) {
      return Scaling2d{{random(1.5, 3), random(0.2, 0.6)}, about}.matrix();
    };
    const auto even = [&](const glm::dvec2& about) { return Scaling2d{glm::dvec2(random(1.5, 3)), about}.matrix(); };
    EXPECT_LE(apart(Translation2d{p}.matrix(), Translation2d{q}.matrix()), kRounding);
    EXPECT_LE(apart(scaling(p), scaling(p)), kRounding);
    EXPECT_LE(apart(turn(p), turn(p)), kRounding);
    EXPECT_LE(apart(even(p), turn(p)), kRounding);

    EXPECT_GT(apart(Translation2d{q}.matrix(), turn({0, 0})), 0.01);
    EXPECT_GT(apart(Translation2d{{3, 4}}.matrix(), scaling({0, 0})), 0.01);
    EXPECT_GT(apart(scaling(p), scaling(q)), 0.01);
    EXPECT_GT(apart(turn(p), turn(q)), 0.01);
    EXPECT_GT(apart(scaling(p), turn(p)), 0.01);
    EXPECT_GT(apart(even(p), turn(q)), 0.01);
    EXPECT_GT(apart(Reflection2d{p, {1, 0}}.matrix(), turn(p)), 0.01);
    EXPECT_GT(apart(Shear2d{{0.5, 0}, p}.matrix(), Shear2d{{0, 0.5}, p}.matrix()), 0.01);
  }
  // Printed: T(t2) · T(t1) = T(t1 + t2), S(s2) · S(s1) = S(s1 s2).
  EXPECT_EQ(difference(Translation2d{{1, 2}}.matrix() * Translation2d{{5, 7}}.matrix(), Translation2d{{6, 9}}.matrix()),
            kExact);
  EXPECT_EQ(
      difference(Scaling2d{{2, 3}, {}}.matrix() * Scaling2d{{5, 7}, {}}.matrix(), Scaling2d{{10, 21}, {}}.matrix()),
      kExact);
  const glm::dmat3 a = elementary(random, 1);
  const glm::dmat3 b = elementary(random, 2);
  const glm::dmat3 c = elementary(random, 3);
  EXPECT_LE(difference((a * b) * c, a * (b * c)), 1e-12);
}

TEST(Transform2d, SingularOnesSaySo) {
  EXPECT_THROW(Scaling2d({{0, 1}, {}}).inverse(), Error);
  EXPECT_THROW(Scaling2d({{1, 0}, {}}).inverse(), Error);
  EXPECT_THROW(Shear2d({{2, 0.5}, {}}).inverse(), Error);
  EXPECT_THROW(Reflection2d({{1, 1}, {0, 0}}).matrix(), Error);
  EXPECT_FALSE(inverse(Scaling2d{{0, 1}, {2, 3}}.matrix()));
  EXPECT_FALSE(inverse(rows(1, 2, 0, 2, 4, 0)));
  EXPECT_FALSE(inverse(rows(0.1, 0.3, 7, 0.3, 0.9, 7)));  // only rounding makes its determinant other than 0
  EXPECT_FALSE(inverse(glm::dmat3(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_FALSE(inverse(rows(1, 2, 3, 4, 5, 6, 7, 8, 9)));
  EXPECT_TRUE(inverse(Scaling2d{{1e-9, 1e9}, {}}.matrix())) << "sizes are not what makes it singular";
  const glm::dmat3 projective = rows(2, 0.5, 1, 0.1, 3, -2, 0.01, 0.02, 1);
  ASSERT_TRUE(inverse(projective));
  EXPECT_LE(difference(*inverse(projective) * projective, glm::dmat3(1)), kRounding);
}

TEST(Transform2d, HomogeneousPoints) {
  EXPECT_EQ(homogeneous({2, 3}, 4), glm::vec3(8, 12, 4));
  EXPECT_EQ(point_of({8, 12, 4}), glm::vec2(2, 3));
  EXPECT_FALSE(point_of({8, 12, 0}));
  const glm::mat3 m(rows(1, 0, 2, 0, 1, 3, 0.5, 0, 1));
  const glm::vec2 p = transform_point(m, {2, 5});
  EXPECT_EQ(p, glm::vec2(2, 4));
  EXPECT_EQ(transform_direction(glm::mat3(Translation2d{{7, 7}}.matrix()), {2, 5}), glm::vec2(2, 5));
  EXPECT_TRUE(std::isinf(transform_point(m, {-2, 5}).y)) << "h = 0";
  const glm::dmat3 column = Rotation2d(0.3, {1, 2}).matrix();
  const glm::dvec3 row = glm::dvec3(4, 5, 1) * other_convention(column);
  EXPECT_EQ(row, column * glm::dvec3(4, 5, 1));
  EXPECT_EQ(difference(other_convention(other_convention(column)), column), kExact);
}

TEST(Transform2d, NormalsStayNormal) {
  Random random(5);
  for (unsigned i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    const glm::mat3 m(elementary(random, i));
    const glm::vec2 tangent(random.point2());
    const glm::vec2 normal(-tangent.y, tangent.x);  // left of the curve
    const glm::vec2 turned = transform_normal(m, normal);
    EXPECT_NEAR(glm::length(turned), 1, 1e-6);
    const glm::vec2 along = transform_direction(m, tangent);
    EXPECT_NEAR(glm::dot(turned, along) / glm::length(along), 0, 2e-6);
    EXPECT_GT(glm::dot(turned, transform_direction(m, normal)), 0) << "it stays on its side";
  }
  EXPECT_EQ(transform_normal(glm::mat3(0), {1, 0}), glm::vec2(0));
}

TEST(Transform2d, ArraysAreTheSameAsPointsOneByOne) {
  const glm::dmat3 affine = Rotation2d(0.3, {1, 2}).matrix() * Scaling2d{{3, -0.2}, {5, 5}}.matrix();
  const glm::dmat3 projective = rows(2, 0.5, 1, 0.1, 3, -2, 0.01, 0.02, 1);
  Random random(3);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    for (std::size_t count = 0; count <= 40; ++count) {
      for (const glm::dmat3& each : {affine, projective}) {
        const glm::mat3 m(each);
        std::vector<glm::vec2> points(count);
        for (glm::vec2& p : points) p = glm::vec2(random.point2());
        std::vector<glm::vec2> result(count + 1, glm::vec2(77));
        transform_points(m, points, std::span(result).first(count));
        for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(result[i], transform_point(m, points[i])) << count;
        ASSERT_EQ(result[count], glm::vec2(77)) << "wrote behind the end";
        transform_points(m, points, points);
        for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(result[i], points[i]) << "in place";
      }
    }
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}

TEST(Transform2d, Classes) {
  using enum TransformClass;
  EXPECT_EQ(classify(glm::dmat3(1)), Identity);
  EXPECT_EQ(classify(3.0 * glm::dmat3(1)), Identity) << "h = 3";
  EXPECT_EQ(classify(Translation2d{{0, 1e-3}}.matrix()), Translation);
  EXPECT_EQ(classify(Rotation2d(1, {4, 5}).matrix()), Rigid);
  EXPECT_EQ(classify(Reflection2d{{1, 2}, {3, 4}}.matrix()), Rigid);
  EXPECT_EQ(classify(Rotation2d(1).matrix() * Scaling2d{{-3, -3}, {}}.matrix()), Similarity);
  EXPECT_EQ(classify(Scaling2d{{3, 2}, {}}.matrix()), Affine);
  EXPECT_EQ(classify(Shear2d{{0.1, 0}, {}}.matrix()), Affine);
  EXPECT_EQ(classify(rows(1, 0, 0, 0, 1, 0, 0.01, 0, 1)), Projective);
  EXPECT_EQ(classify(rows(1, 0, 0, 0, 1, 0, 0, 0, 0)), Projective);
  EXPECT_EQ(classify(glm::dmat3(std::numeric_limits<double>::quiet_NaN())), Projective);
  EXPECT_EQ(classify(glm::dmat3(glm::mat3(Rotation2d(1).matrix()))), Rigid) << "f32's rounding is tolerated";
  EXPECT_EQ(classify(Scaling2d{{1.01, 1.01}, {}}.matrix(), 0.05), Identity);
  EXPECT_TRUE(is_mirroring(Reflection2d{{1, 2}, {3, 4}}.matrix()));
  EXPECT_FALSE(is_mirroring(Scaling2d{{-1, -1}, {}}.matrix()));
}

TEST(Transform2d, DecomposesAndComposes) {
  Random random(13);
  for (unsigned i = 0; i < 1000; ++i) {
    SCOPED_TRACE(i);
    const glm::dmat3 m = elementary(random, i) * elementary(random, i / 5);
    const std::optional<Decomposition2d> parts = decompose(m);
    ASSERT_TRUE(parts);
    EXPECT_LE(difference(compose(*parts), m), 1e-12);
    if (is_mirroring(m)) {
      EXPECT_LE(std::fabs(parts->rotation), kPi / 2);
    } else {
      EXPECT_GT(parts->scale.x, 0);
      EXPECT_GT(parts->scale.y, 0);
    }
  }
  const Decomposition2d mirror = *decompose(Reflection2d{{0, 0}, {0, 1}}.matrix());
  EXPECT_EQ(mirror.scale, glm::dvec2(-1, 1));
  EXPECT_EQ(mirror.rotation, 0);
  const Decomposition2d known =
      *decompose(Translation2d{{3, 4}}.matrix() * Rotation2d(0.5).matrix() * Scaling2d{{2, 5}, {}}.matrix());
  EXPECT_NEAR(known.rotation, 0.5, 1e-15);
  EXPECT_NEAR(known.shear, 0, 1e-15);
  EXPECT_NEAR(known.scale.y, 5, 1e-14);
  EXPECT_FALSE(decompose(Scaling2d{{0, 1}, {}}.matrix()));
  EXPECT_FALSE(decompose(rows(1, 0, 0, 0, 1, 0, 0.01, 0, 1)));
}

}  // namespace
}  // namespace azulejo
