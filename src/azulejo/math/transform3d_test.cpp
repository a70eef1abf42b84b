#include "azulejo/math/transform3d.h"

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
constexpr glm::dvec3 kX{1, 0, 0};
constexpr glm::dvec3 kY{0, 1, 0};
constexpr glm::dvec3 kZ{0, 0, 1};

/// The upper three rows as they are written; the last is 0, 0, 0, 1.
glm::dmat4 rows(const glm::dvec4& x, const glm::dvec4& y, const glm::dvec4& z, const glm::dvec4& h = {0, 0, 0, 1}) {
  return glm::transpose(glm::dmat4(x, y, z, h));
}

glm::dvec3 applied(const glm::dmat4& m, const glm::dvec3& p) { return glm::dvec3(m * glm::dvec4(p, 1)); }

/// An elementary transformation of each kind by turns.
glm::dmat4 elementary(Random& random, unsigned kind, glm::dmat4* inverse = nullptr) {
  const auto give = [&](const auto& each) {
    if (inverse != nullptr) *inverse = each.inverse();
    return each.matrix();
  };
  const glm::dvec3 about = random.point3();
  switch (kind % 6) {
    case 0: return give(Translation3d{about});
    case 1: return give(Rotation3d(random(-7, 7), random.point3(), about));
    case 2: return give(Rotation3d(random(-7, 7), static_cast<CoordinateAxis>(random.below(3)), about));
    case 3: return give(Scaling3d{{random.factor(), random.factor(), random.factor()}, about});
    case 4:
      return give(Shear3d{.x = random.point2(0.4), .y = random.point2(0.4), .z = random.point2(0.4), .about = about});
    default: return give(Reflection3d{about, random.point3()});
  }
}

TEST(Transform3d, FormulasOfTheElementaryOnes) {
  const double c = std::cos(0.7);
  const double s = std::sin(0.7);
  EXPECT_EQ(difference(Translation3d{{3, -4, 5}}.matrix(), rows({1, 0, 0, 3}, {0, 1, 0, -4}, {0, 0, 1, 5})), kExact);
  EXPECT_LE(difference(Rotation3d(0.7, kX).matrix(), rows({1, 0, 0, 0}, {0, c, -s, 0}, {0, s, c, 0})), 4e-16);
  EXPECT_LE(difference(Rotation3d(0.7, kY).matrix(), rows({c, 0, s, 0}, {0, 1, 0, 0}, {-s, 0, c, 0})), 4e-16);
  EXPECT_LE(difference(Rotation3d(0.7, kZ).matrix(), rows({c, -s, 0, 0}, {s, c, 0, 0}, {0, 0, 1, 0})), 4e-16);
  EXPECT_EQ(difference(Scaling3d{{2, 3, -4}, {}}.matrix(), rows({2, 0, 0, 0}, {0, 3, 0, 0}, {0, 0, -4, 0})), kExact);
  const Shear3d shear{.x = {1, 2}, .y = {3, 4}, .z = {5, 6}};
  EXPECT_EQ(difference(shear.matrix(), rows({1, 1, 2, 0}, {3, 1, 4, 0}, {5, 6, 1, 0})), kExact);
  EXPECT_EQ(difference(Reflection3d{{0, 0, 0}, {0, 7, 0}}.matrix(), Scaling3d{{1, -1, 1}, {}}.matrix()), kExact);
  EXPECT_EQ(applied(Reflection3d{{1, 1, 1}, {1, 1, 0}}.matrix(), {1, 2, 3}), glm::dvec3(0, 1, 3));
}

TEST(Transform3d, FormulasOfTheInverses) {
  EXPECT_EQ(difference(Translation3d{{3, -4, 5}}.inverse(), Translation3d{{-3, 4, -5}}.matrix()), kExact);
  EXPECT_EQ(difference(Scaling3d{{2, 4, -8}, {}}.inverse(), Scaling3d{{0.5, 0.25, -0.125}, {}}.matrix()), kExact);
  for (const glm::dvec3& axis : {kX, kY, kZ, glm::dvec3(1, -2, 3)}) {
    const Rotation3d rotation(0.7, axis);
    EXPECT_LE(difference(rotation.inverse(), glm::transpose(rotation.matrix())), 3e-16);
    EXPECT_EQ(difference(rotation.inverse(), Rotation3d(-0.7, axis).matrix()), kExact);
  }
}

TEST(Transform3d, FormulasAboutAPointAndAnAxis) {
  const glm::dvec3 f(3, -2, 5);
  EXPECT_EQ(difference(Scaling3d{{2, 3, 4}, f}.matrix(),
                       rows({2, 0, 0, (1 - 2) * f.x}, {0, 3, 0, (1 - 3) * f.y}, {0, 0, 4, (1 - 4) * f.z})),
            kExact);
  // Around an axis parallel to X: T⁻¹ · Rx · T, where T moves the axis onto X.
  const glm::dmat4 in_steps =
      Translation3d{{0, f.y, f.z}}.matrix() * Rotation3d(0.7, kX).matrix() * Translation3d{{0, -f.y, -f.z}}.matrix();
  EXPECT_LE(difference(Rotation3d(0.7, CoordinateAxis::X, f).matrix(), in_steps), 2e-15);
  // Around any axis: the axis is turned onto Z first. Its tilt is undone by two rotations.
  const glm::dvec3 axis(1, 2, 2);
  const double around_z = std::atan2(axis.y, axis.x);
  const double around_y = std::acos(axis.z / 3);
  const glm::dmat4 axis_from_z = Rotation3d(around_z, kZ).matrix() * Rotation3d(around_y, kY).matrix();
  const glm::dmat4 expected = Translation3d{f}.matrix() * axis_from_z * Rotation3d(0.7, kZ).matrix() *
                              glm::transpose(axis_from_z) * Translation3d{-f}.matrix();
  EXPECT_LE(difference(Rotation3d(0.7, axis, f).matrix(), expected), 5e-15);
  EXPECT_LE(glm::length(applied(Rotation3d(2, axis, f).matrix(), f + 5.0 * axis) - (f + 5.0 * axis)), 1e-14);
}

TEST(Transform3d, PositiveAnglesTurnXToYToZToX) {
  EXPECT_EQ(applied(Rotation3d(kPi / 2, CoordinateAxis::X).matrix(), kY), kZ);
  EXPECT_EQ(applied(Rotation3d(kPi / 2, CoordinateAxis::Y).matrix(), kZ), kX);
  EXPECT_EQ(applied(Rotation3d(kPi / 2, CoordinateAxis::Z).matrix(), kX), kY);
  EXPECT_EQ(applied(Rotation3d(turn_of_degrees(-90), -5.0 * kZ).matrix(), kX), kY);
  EXPECT_THROW(Rotation3d(1, glm::dvec3(0)).matrix(), Error);
}

TEST(Transform3d, QuaternionsAreRotations) {
  Random random(17);
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    const glm::dvec3 axis = random.point3();
    const double angle = random(-3, 3);
    const glm::dmat4 expected = Rotation3d(angle, axis).matrix();
    const glm::dquat q = quaternion_about(axis, angle);
    EXPECT_LE(difference(rotation(q), expected), 2e-15);
    EXPECT_LE(difference(rotation(q * 7.0), expected), 2e-15) << "its length doesn't matter";
    const glm::dquat back = quaternion_of(glm::dmat3(expected));
    EXPECT_GE(back.w, 0);
    EXPECT_LE(difference(rotation(back), expected), 4e-15);
    const glm::dquat other = quaternion_about(random.point3(), random(-3, 3));
    EXPECT_LE(difference(rotation(q * other), rotation(q) * rotation(other)), 4e-15);
  }
  EXPECT_EQ(difference(rotation(glm::dquat(0, 0, 1, 0)), Scaling3d{{-1, 1, -1}, {}}.matrix()), kExact);
  EXPECT_THROW(rotation(glm::dquat(0, 0, 0, 0)), Error);
  EXPECT_THROW(quaternion_about({0, 0, 0}, 1), Error);
}

TEST(Transform3d, EachTimesItsInverseIsTheIdentity) {
  Random random(31);
  for (unsigned i = 0; i < 1200; ++i) {
    SCOPED_TRACE(i);
    glm::dmat4 closed;
    const glm::dmat4 m = elementary(random, i, &closed);
    EXPECT_LE(difference(m * closed, glm::dmat4(1)), 1e-12);
    const std::optional<glm::dmat4> general = inverse(m);
    ASSERT_TRUE(general);
    EXPECT_LE(difference(closed, *general), 1e-12);
  }
}

TEST(Transform3d, RandomCompositionsFollowTheReferenceInLongDouble) {
  using Long = long double;
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    glm::dmat4 m(1);
    glm::mat<4, 4, Long> reference(1);
    for (unsigned i = 0; i < 2 + seed % 7; ++i) {
      const glm::dmat4 next = elementary(random, random.below(6));
      m = next * m;
      reference = glm::mat<4, 4, Long>(next) * reference;
    }
    double size = 1;
    for (int column = 0; column < 4; ++column) size = std::max(size, glm::length(m[column]));
    EXPECT_LE(difference(m, glm::dmat4(reference)), 100 * 8 * 4 * 1.2e-16 * size);
    const glm::dvec3 p = random.point3();
    const glm::vec<4, Long> expected = reference * glm::vec<4, Long>(p.x, p.y, p.z, 1);
    const glm::vec3 got = transform_point(glm::mat4(m), glm::vec3(p));
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(got[k], static_cast<double>(expected[k]), 8e-7 * size * 20);
  }
}

TEST(Transform3d, WhatCommutesAndWhatDoesNot) {
  Random random(7);
  const auto apart = [](const glm::dmat4& a, const glm::dmat4& b) { return difference(a * b, b * a); };
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    const glm::dvec3 p = random.point3();
    const glm::dvec3 q = p + glm::dvec3(2, 1, 3);
    const glm::dvec3 axis = random.point3() + glm::dvec3(0, 0, 11);
    const auto turn = [&](const glm::dvec3& around, const glm::dvec3& through) {
      return Rotation3d(random(0.5, 1.2), around, through).matrix();
    };
    const auto scaling = [&](const glm::dvec3& about) {
      return Scaling3d{{random(1.5, 3), random(0.2, 0.6), random(4, 5)}, about}.matrix();
    };
    const auto even = [&](const glm::dvec3& about) { return Scaling3d{glm::dvec3(random(1.5, 3)), about}.matrix(); };
    EXPECT_LE(apart(Translation3d{p}.matrix(), Translation3d{q}.matrix()), 1e-13);
    EXPECT_LE(apart(scaling(p), scaling(p)), 1e-12);
    EXPECT_LE(apart(turn(axis, p), turn(axis, p)), 1e-13);
    EXPECT_LE(apart(even(p), turn(axis, p)), 1e-12);
    EXPECT_GT(apart(turn(axis, p), turn({1, 0, 0}, p)), 0.01) << "around different axes";
    EXPECT_GT(apart(Translation3d{{3, 4, 5}}.matrix(), scaling({})), 0.01);
    EXPECT_GT(apart(scaling(p), scaling(q)), 0.01);
    EXPECT_GT(apart(scaling(p), turn(axis, p)), 0.01);
  }
}

TEST(Transform3d, SingularOnesSaySo) {
  EXPECT_THROW(Scaling3d({{1, 0, 1}, {}}).inverse(), Error);
  EXPECT_THROW((Shear3d{.x = {1, 0}, .y = {1, 0}}.inverse()), Error);
  EXPECT_THROW(Reflection3d({{1, 1, 1}, {0, 0, 0}}).matrix(), Error);
  EXPECT_FALSE(inverse(Scaling3d{{1, 0, 1}, {2, 3, 4}}.matrix()));
  EXPECT_FALSE(inverse(rows({1, 2, 3, 1}, {4, 5, 6, 1}, {7, 8, 9, 1})));
  EXPECT_FALSE(inverse(glm::dmat4(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_TRUE(inverse(Scaling3d{{1e-9, 1e9, 1}, {}}.matrix()));
  const glm::dmat4 projective = rows({2, 0.5, 1, 3}, {0.1, 3, -2, 1}, {0, 1, 4, 2}, {0.01, 0.02, 0.5, 1});
  ASSERT_TRUE(inverse(projective));
  EXPECT_LE(difference(*inverse(projective) * projective, glm::dmat4(1)), 1e-13);
}

TEST(Transform3d, HomogeneousPoints) {
  EXPECT_EQ(homogeneous({1, 2, 3}, 2), glm::vec4(2, 4, 6, 2));
  EXPECT_EQ(point_of({2, 4, 6, 2}), glm::vec3(1, 2, 3));
  EXPECT_FALSE(point_of({2, 4, 6, 0}));
  const glm::dmat4 column = Rotation3d(0.3, {1, 2, 3}, {4, 5, 6}).matrix();
  EXPECT_EQ(glm::dvec4(4, 5, 6, 1) * other_convention(column), column * glm::dvec4(4, 5, 6, 1));
  EXPECT_EQ(transform_direction(glm::mat4(Translation3d{{7, 7, 7}}.matrix()), {2, 5, 1}), glm::vec3(2, 5, 1));
}

TEST(Transform3d, NormalsStayNormalAndOutside) {
  Random random(5);
  for (unsigned i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    const glm::mat4 m(elementary(random, i));
    const glm::vec3 a(random.point3());
    const glm::vec3 b(random.point3());
    const glm::vec3 normal = glm::normalize(glm::cross(a, b));
    const glm::vec3 turned = transform_normal(m, normal);
    EXPECT_NEAR(glm::length(turned), 1, 1e-6);
    for (const glm::vec3& side : {a, b}) {
      const glm::vec3 along = transform_direction(m, side);
      EXPECT_NEAR(glm::dot(turned, along) / glm::length(along), 0, 3e-6);
    }
    EXPECT_GT(glm::dot(turned, transform_direction(m, normal)), 0);
  }
  EXPECT_EQ(transform_normal(glm::mat4(0), {1, 0, 0}), glm::vec3(0));
}

TEST(Transform3d, ArraysAreTheSameAsPointsOneByOne) {
  const glm::mat4 affine(Rotation3d(0.3, {1, 2, 3}, {4, 5, 6}).matrix() * Scaling3d{{3, -0.2, 2}, {5, 5, 5}}.matrix());
  const glm::mat4 projective(rows({2, 0.5, 1, 3}, {0.1, 3, -2, 1}, {0, 1, 4, 2}, {0.01, 0.02, 0.5, 1}));
  Random random(3);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    for (std::size_t count = 0; count <= 40; ++count) {
      for (const glm::mat4& m : {affine, projective}) {
        std::vector<glm::vec3> points(count);
        for (glm::vec3& p : points) p = glm::vec3(random.point3());
        std::vector<glm::vec3> result(count + 1, glm::vec3(77));
        const auto to = std::span(result).first(count);
        transform_directions(m, points, to);
        for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(result[i], transform_direction(m, points[i]));
        transform_points(m, points, to);
        for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(result[i], transform_point(m, points[i])) << count;
        ASSERT_EQ(result[count], glm::vec3(77)) << "wrote behind the end";
        transform_points(m, points, points);
        for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(result[i], points[i]) << "in place";
      }
    }
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}

TEST(Transform3d, Classes) {
  using enum TransformClass;
  EXPECT_EQ(classify(glm::dmat4(1)), Identity);
  EXPECT_EQ(classify(Translation3d{{0, 0, 1e-3}}.matrix()), Translation);
  EXPECT_EQ(classify(Rotation3d(1, {1, 2, 3}, {4, 5, 6}).matrix()), Rigid);
  EXPECT_EQ(classify(Reflection3d{{1, 2, 3}, {1, 2, 3}}.matrix()), Rigid);
  EXPECT_EQ(classify(Rotation3d(1, {1, 2, 3}).matrix() * Scaling3d{glm::dvec3(0.1), {}}.matrix()), Similarity);
  EXPECT_EQ(classify(Scaling3d{{3, 3, 2}, {}}.matrix()), Affine);
  EXPECT_EQ(classify(Shear3d{.y = {0, 0.1}}.matrix()), Affine);
  EXPECT_EQ(classify(rows({1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0.1, 1})), Projective);
  EXPECT_EQ(classify(glm::dmat4(std::numeric_limits<double>::quiet_NaN())), Projective);
  EXPECT_EQ(classify(glm::dmat4(glm::mat4(Rotation3d(1, {1, 2, 3}).matrix()))), Rigid);
  EXPECT_TRUE(is_mirroring(Scaling3d{{-1, -1, -1}, {}}.matrix()));
  EXPECT_FALSE(is_mirroring(Scaling3d{{-1, -1, 1}, {}}.matrix()));
}

TEST(Transform3d, DecomposesAndComposes) {
  Random random(13);
  for (unsigned i = 0; i < 1200; ++i) {
    SCOPED_TRACE(i);
    const glm::dmat4 m = elementary(random, i) * elementary(random, i / 6);
    const std::optional<Decomposition3d> parts = decompose(m);
    ASSERT_TRUE(parts);
    EXPECT_LE(difference(compose(*parts), m), 1e-11);
    const int negative = (parts->scale.x < 0) + (parts->scale.y < 0) + (parts->scale.z < 0);
    EXPECT_EQ(negative, is_mirroring(m) ? 1 : 0);
  }
  for (const glm::dvec3& mirror : {glm::dvec3(-1, 1, 1), glm::dvec3(1, -1, 1), glm::dvec3(1, 1, -1)}) {
    const Decomposition3d parts = *decompose(Scaling3d{mirror, {}}.matrix());
    EXPECT_EQ(parts.scale, mirror);
    EXPECT_EQ(parts.rotation.w, 1);
  }
  EXPECT_FALSE(decompose(Scaling3d{{1, 0, 1}, {}}.matrix()));
  EXPECT_FALSE(decompose(rows({1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0.1, 1})));
}

}  // namespace
}  // namespace azulejo
