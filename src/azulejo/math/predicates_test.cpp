#include "azulejo/math/predicates.h"

#include <array>
#include <cstdint>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace azulejo {
namespace {

__extension__ using Wide = __int128;

/// An integer of up to some 600 bits, for the truth: signed limbs of 32 bits, the lowest first.
class Integer {
 public:
  Integer() = default;
  /// value · 2^shift, which must be an integer.
  Integer(double value, int shift) {
    int exponent = 0;
    auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
    exponent += shift - 53;
    for (; exponent < 0; ++exponent) mantissa /= 2;
    const Wide shifted = static_cast<Wide>(mantissa) << (exponent % 32);
    limbs_[static_cast<std::size_t>(exponent / 32)] = shifted;
    carry();
  }
  friend Integer operator+(Integer a, const Integer& b) {
    for (std::size_t i = 0; i < kLimbs; ++i) a.limbs_[i] += b.limbs_[i];
    a.carry();
    return a;
  }
  friend Integer operator-(Integer a, const Integer& b) {
    for (std::size_t i = 0; i < kLimbs; ++i) a.limbs_[i] -= b.limbs_[i];
    a.carry();
    return a;
  }
  friend Integer operator*(const Integer& a, const Integer& b) {
    Integer product;
    for (std::size_t i = 0; i < kLimbs; ++i) {
      for (std::size_t j = 0; i + j < kLimbs; ++j) product.limbs_[i + j] += a.limbs_[i] * b.limbs_[j];
    }
    product.carry();
    return product;
  }
  int sign() const {
    for (std::size_t i = kLimbs; i-- > 0;) {
      if (limbs_[i] != 0) return limbs_[i] > 0 ? 1 : -1;
    }
    return 0;
  }

 private:
  static constexpr std::size_t kLimbs = 20;
  /// All limbs in 0 … 2³² − 1 but the highest, which has the sign.
  void carry() {
    for (std::size_t i = 0; i + 1 < kLimbs; ++i) {
      const Wide up = limbs_[i] >> 32;
      limbs_[i + 1] += up;
      limbs_[i] -= up << 32;
    }
    limbs_.back() = static_cast<std::int32_t>(static_cast<std::uint32_t>(limbs_.back()));  // products, modulo 2⁶⁴⁰
  }
  std::array<Wide, kLimbs> limbs_{};
};

constexpr int kShift = 90;  // coordinates of the tests are multiples of 2⁻⁹⁰

Integer whole(double value) { return {value, kShift}; }
int sign(double value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

Integer true_cross(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& o) {
  return (whole(a.x) - whole(o.x)) * (whole(b.y) - whole(o.y)) - (whole(b.x) - whole(o.x)) * (whole(a.y) - whole(o.y));
}
int true_orient2d(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) { return true_cross(a, b, c).sign(); }
int true_orient3d(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  const auto flat = [](const glm::dvec3& p) { return glm::dvec2(p.x, p.y); };
  const auto term = [&](const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r) {
    return (whole(p.z) - whole(d.z)) * true_cross(flat(q), flat(r), flat(d));
  };
  return (term(a, b, c) + term(b, c, a) + term(c, a, b)).sign();
}
int true_incircle(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d) {
  const auto term = [&](const glm::dvec2& p, const glm::dvec2& q, const glm::dvec2& r) {
    const Integer x = whole(p.x) - whole(d.x);
    const Integer y = whole(p.y) - whole(d.y);
    return (x * x + y * y) * true_cross(q, r, d);
  };
  return (term(a, b, c) + term(b, c, a) + term(c, a, b)).sign();
}

/// Now and then the next double up or down.
double nudged(double value, std::mt19937& random) {
  const unsigned which = random() % 4;
  return which == 0 ? std::nextafter(value, 1e9) : which == 1 ? std::nextafter(value, -1e9) : value;
}

TEST(Predicates, HaveTheSignsOfTheirDefinitions) {
  EXPECT_GT(orient2d({0, 0}, {1, 0}, {0, 1}), 0);
  EXPECT_EQ(orient2d({0, 0}, {1, 0}, {0, 1}), 1);
  EXPECT_GT(incircle({1, 0}, {0, 1}, {-1, 0}, {0, 0}), 0);
  EXPECT_EQ(incircle({1, 0}, {0, 1}, {-1, 0}, {0, -1}), 0);
  EXPECT_LT(incircle({1, 0}, {0, 1}, {-1, 0}, {0, -2}), 0);
  // Seen from above, z up, a, b, c turn counter-clockwise: from below, clockwise.
  EXPECT_GT(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}), 0);
  EXPECT_EQ(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 7, 0}), 0);
}

TEST(Predicates, Orient2dIsExactOnNearlyCollinearPoints) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-1, 1);
  int zeros = 0;
  for (int i = 0; i < 20000; ++i) {
    // On a line through two points, rounded: the paper's own example is the line y = x near 0.5, over steps of 2⁻⁵³.
    const glm::dvec2 a(place(random), place(random));
    const glm::dvec2 b = i % 2 == 0 ? glm::dvec2(place(random), place(random)) : a * (1 + 0x1p-30);
    const double t = i % 3 == 0 ? std::ldexp(1.0, static_cast<int>(random() % 16) - 8) : place(random);
    const glm::dvec2 c(nudged(a.x + t * (b.x - a.x), random), nudged(a.y + t * (b.y - a.y), random));
    const int truth = true_orient2d(a, b, c);
    ASSERT_EQ(sign(orient2d(a, b, c)), truth) << i;
    ASSERT_EQ(sign(orient2d(b, a, c)), -truth) << i;
    ASSERT_EQ(sign(orient2d(c, a, b)), truth) << i;
    zeros += truth == 0;
  }
  EXPECT_GT(zeros, 10);  // among them collinear ones
}

TEST(Predicates, IncircleIsExactOnNearlyCocircularPoints) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> angle(0, 6.3);
  int zeros = 0;
  for (int i = 0; i < 5000; ++i) {
    std::array<glm::dvec2, 4> p;
    if (i % 4 == 0) {  // corners of rectangles lie on circles exactly
      const double x = angle(random);
      const double y = angle(random);
      const double w = std::ldexp(1.0, static_cast<int>(random() % 8));
      p = {glm::dvec2(x, y), glm::dvec2(x + w, y), glm::dvec2(x + w, y + w), glm::dvec2(x, y + w)};
      if (i % 8 == 0) p[2].x = nudged(p[2].x, random);
    } else {
      for (glm::dvec2& each : p) {
        const double at = angle(random);
        each = {nudged(std::cos(at) + 0.25, random), nudged(std::sin(at), random)};
      }
    }
    const int truth = true_incircle(p[0], p[1], p[2], p[3]);
    ASSERT_EQ(sign(incircle(p[0], p[1], p[2], p[3])), truth) << i;
    ASSERT_EQ(sign(incircle(p[1], p[0], p[2], p[3])), -truth) << i;
    ASSERT_EQ(sign(incircle(p[3], p[0], p[1], p[2])), -truth) << i;  // an odd permutation of four
    zeros += truth == 0;
  }
  EXPECT_GT(zeros, 10);
}

TEST(Predicates, Orient3dIsExactOnNearlyCoplanarPoints) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1, 1);
  for (int i = 0; i < 5000; ++i) {
    const auto point = [&] { return glm::dvec3(place(random), place(random), place(random)); };
    const glm::dvec3 a = point();
    const glm::dvec3 b = point();
    const glm::dvec3 c = i % 5 == 0 ? a + (b - a) * 0.5 : point();
    const double s = i % 3 == 0 ? 0.5 : place(random);
    glm::dvec3 d = a + s * (b - a) + 0.25 * (c - a);
    d.z = nudged(d.z, random);
    const int truth = true_orient3d(a, b, c, d);
    ASSERT_EQ(sign(orient3d(a, b, c, d)), truth) << i;
    ASSERT_EQ(sign(orient3d(a, c, b, d)), -truth) << i;
    ASSERT_EQ(sign(orient3d(d, a, b, c)), -truth) << i;
  }
}

TEST(Predicates, AreExactOnAnyFloats) {
  // From the smallest to the largest: nothing under- or overflows.
  EXPECT_GT(orient2d({0, 0}, {0x1p-149, 0}, {0, 0x1p-149}), 0);
  EXPECT_GT(incircle({0x1p-149, 0}, {0, 0x1p-149}, {-0x1p-149, 0}, {0, 0}), 0);
  EXPECT_EQ(incircle({0x1p-149, 0}, {0, 0x1p-149}, {-0x1p-149, 0}, {0, -0x1p-149}), 0);
  const double top = 0x1.fffffep127;
  EXPECT_EQ(incircle({top, top}, {-top, top}, {-top, -top}, {top, -top}), 0);
  EXPECT_GT(incircle({top, top}, {-top, top}, {-top, -top}, {0x1.fffffcp127, -top}), 0);
  EXPECT_LT(orient2d({-top, -top}, {top, top}, {0x1p-149, 0}), 0);
  EXPECT_EQ(orient2d({-top, -top}, {top, top}, {0x1p-149, 0x1p-149}), 0);
  EXPECT_GT(orient3d({top, 0, 0}, {0, top, 0}, {-top, -top, 0}, {0, 0, -0x1p-149}), 0);
}

TEST(Predicates, TakeWhatIsNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double odd : {nan, infinity, -infinity, 1e308}) {
    for (const double other : {nan, infinity, 0.0, 1e308}) {
      EXPECT_NO_FATAL_FAILURE(orient2d({odd, 0}, {1, other}, {odd, odd}));
      EXPECT_NO_FATAL_FAILURE(orient3d({odd, 0, 1}, {1, other, 0}, {0, 0, odd}, {other, odd, other}));
      EXPECT_NO_FATAL_FAILURE(incircle({odd, 0}, {1, other}, {odd, odd}, {other, 0.5}));
    }
  }
}

}  // namespace
}  // namespace azulejo
