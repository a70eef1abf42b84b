#include "azulejo/modelling/flatten_path.h"

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "azulejo/modelling/path_testing.h"

namespace azulejo {
namespace {

constexpr glm::mat3x2 kSame{1, 0, 0, 1, 0, 0};
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

FlatPath flat(const Path& path, float tolerance = 0.1F, const glm::mat3x2& matrix = kSame) {
  FlatPath result;
  flatten_path(view_of(path), matrix, {tolerance}, result);
  return result;
}

/// By de Casteljau in double.
glm::dvec2 on_curve(std::array<glm::dvec2, 4> p, std::size_t order, double t) {
  for (std::size_t n = order; n > 0; --n) {
    for (std::size_t i = 0; i < n; ++i) p[i] = (1 - t) * p[i] + t * p[i + 1];
  }
  return p[0];
}

/// Farthest of many points of the curve from the chord of their part.
double deviation(const std::array<glm::dvec2, 4>& p, std::size_t order, const FlatPath& path) {
  const auto contour = path.contour(0);
  const std::size_t pieces = contour.size() - 1;
  double farthest = 0;
  for (std::size_t i = 0; i < pieces; ++i) {
    for (int k = 1; k < 16; ++k) {
      const double t = (static_cast<double>(i) + k / 16.0) / static_cast<double>(pieces);
      farthest = std::max(farthest, distance_to_segment(on_curve(p, order, t), contour[i], contour[i + 1]));
    }
  }
  return farthest;
}

/// The fewest chords: each as long as the tolerance lets it.
int fewest_chords(const std::array<glm::dvec2, 4>& p, std::size_t order, double tolerance) {
  constexpr int kSteps = 4000;
  const auto at = [&](int k) { return on_curve(p, order, static_cast<double>(k) / kSteps); };
  int chords = 0;
  for (int from = 0; from < kSteps; ++chords) {
    const auto fits = [&](int to) {
      for (int k = from + 1; k < to; ++k) {
        if (distance_to_segment(at(k), at(from), at(to)) > tolerance) return false;
      }
      return true;
    };
    int low = from + 1;
    int high = kSteps + 1;
    while (high - low > 1) (fits((low + high) / 2) ? low : high) = (low + high) / 2;
    from = low;
  }
  return chords;
}

TEST(FlattenPath, StaysWithinTheToleranceAndEndsExactly) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-300, 300);
  const auto point = [&] { return glm::vec2(place(random), place(random)); };
  for (int i = 0; i < 500; ++i) {
    const std::array<glm::vec2, 4> p = {point(), point(), point(), point()};
    const float tolerance = std::array{0.01F, 0.1F, 0.25F, 3.0F}[static_cast<std::size_t>(i % 4)];
    const std::size_t order = i % 2 == 0 ? 2 : 3;
    Path path = Path().move_to(p[0]);
    order == 2 ? path.quadratic_to(p[1], p[2]) : path.cubic_to(p[1], p[2], p[3]);
    const FlatPath result = flat(path, tolerance);
    ASSERT_EQ(result.contour_count(), 1U);
    EXPECT_EQ(result.points.front(), p[0]);
    EXPECT_EQ(result.points.back(), p[order]);
    // Floats of up to 2000 (the coefficients) are within 2⁻¹³ of what is meant; five operations.
    EXPECT_LE(deviation({p[0], p[1], p[2], p[3]}, order, result), tolerance + 6e-4) << i;
  }
}

TEST(FlattenPath, TakesFewChords) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> place(0, 400);
  const auto point = [&] { return glm::vec2(place(random), place(random)); };
  for (const std::size_t order : {std::size_t{2}, std::size_t{3}}) {
    double ours = 0;
    double fewest = 0;
    for (int i = 0; i < 40; ++i) {
      const std::array<glm::vec2, 4> p = {point(), point(), point(), point()};
      Path path = Path().move_to(p[0]);
      order == 2 ? path.quadratic_to(p[1], p[2]) : path.cubic_to(p[1], p[2], p[3]);
      ours += static_cast<double>(flat(path, 0.1F).points.size() - 1);
      fewest += fewest_chords({p[0], p[1], p[2], p[3]}, order, 0.1);
    }
    // Loops and spikes of random points are the bound's worst; arcs are near the fewest.
    EXPECT_LT(ours, (order == 2 ? 1.6 : 2.3) * fewest) << order;
  }
  // A quarter of a circle of radius 50: chords of angle a leave it by 50 (1 − cos(a / 2)): 12.4 of them.
  const float k = 50 * 0.5522847F;
  EXPECT_LE(flat(Path().move_to({50, 0}).cubic_to({50, k}, {k, 50}, {0, 50})).points.size() - 1, 14U);
  EXPECT_EQ(flat(Path().move_to({0, 0}).cubic_to({1, 1}, {2, 2}, {3, 3})).points.size(), 2U);
}

TEST(FlattenPath, TransformsFirst) {
  const glm::mat3x2 matrix(0, 100, -100, 0, 7, 9);
  const FlatPath result = flat(Path().move_to({0, 0}).quadratic_to({1, 0}, {1, 1}).line_to({2, 0}), 0.1F, matrix);
  EXPECT_EQ(result.points.front(), glm::vec2(7, 9));
  EXPECT_EQ(result.points.back(), glm::vec2(7, 209));
  EXPECT_EQ(result.points.size(), 1U + 19U + 1U);  // √(|p₀ − 2 p₁ + p₂| / (4 · 0.1)) = 18.8
}

TEST(FlattenPath, ContoursAreSubpaths) {
  const FlatPath result = flat(Path()
                                   .move_to({0, 0})
                                   .line_to({1, 0})
                                   .line_to({1, 1})
                                   .close()
                                   .line_to({5, 5})
                                   .move_to({9, 9})
                                   .move_to({2, 2})
                                   .line_to({3, 3})
                                   .line_to({2, 2})
                                   .close()
                                   .close()
                                   .move_to({4, 4})
                                   .close());
  const std::vector<std::vector<glm::vec2>> wanted = {
      {{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {5, 5}}, {{2, 2}, {3, 3}}, {{4, 4}}};
  const std::vector<std::uint8_t> closed = {1, 0, 1, 1};
  ASSERT_EQ(result.contour_count(), wanted.size());
  for (std::size_t c = 0; c < wanted.size(); ++c) {
    EXPECT_EQ(std::vector<glm::vec2>(result.contour(c).begin(), result.contour(c).end()), wanted[c]) << c;
    EXPECT_EQ(result.closed[c], closed[c]) << c;
  }
}

TEST(FlattenPath, LeavesOutWhatIsNotFinite) {
  const FlatPath result = flat(Path()
                                   .move_to({0, 0})
                                   .line_to({1, 0})
                                   .line_to({kNan, 0})
                                   .line_to({2, 0})
                                   .line_to({3, 0})
                                   .cubic_to({4, 0}, {kInfinity, 0}, {5, 0})
                                   .line_to({6, 0})
                                   .close()
                                   .move_to({kNan, 1})
                                   .line_to({1, 1})
                                   .close()
                                   .move_to({1, kNan})
                                   .close());
  const std::vector<std::vector<glm::vec2>> wanted = {{{0, 0}, {1, 0}}, {{2, 0}, {3, 0}}, {{5, 0}, {6, 0}, {0, 0}}};
  ASSERT_EQ(result.contour_count(), wanted.size());
  for (std::size_t c = 0; c < wanted.size(); ++c) {
    EXPECT_EQ(std::vector<glm::vec2>(result.contour(c).begin(), result.contour(c).end()), wanted[c]) << c;
    EXPECT_EQ(result.closed[c], 0) << c;
  }
}

TEST(FlattenPath, ManyLinesWithOneThatIsNotFinite) {
  Path path = Path().move_to({0, 0});
  for (int i = 1; i < 2000; ++i) path.line_to({static_cast<float>(i), i == 700 ? kNan : 1.0F});
  const FlatPath result = flat(path);
  ASSERT_EQ(result.contour_count(), 2U);
  EXPECT_EQ(result.contour(0).size(), 700U);
  EXPECT_EQ(result.contour(1).size(), 1299U);
  EXPECT_EQ(result.contour(1).front().x, 701);
}

TEST(FlattenPath, IsBoundedForHugeCurves) {
  EXPECT_EQ(flat(Path().move_to({0, 0}).quadratic_to({1e12F, 1e12F}, {3, 4})).points.size(), 1025U);
  EXPECT_EQ(flat(Path().move_to({0, 0}).cubic_to({3e38F, 1e12F}, {-3e38F, 0}, {3, 4})).points.size(), 2U);
}

TEST(FlattenPath, CurvesBesideTheWindowAreChords) {
  const Path path = Path().move_to({0, 0}).quadratic_to({50, 90}, {100, 0});
  for (const Box2 window : {Box2{{200, 0}, {300, 50}}, Box2{{0, 91}, {99, 99}}, Box2{{-9, -9}, {-1, 99}}}) {
    FlatPath result;
    flatten_path(view_of(path), kSame, {0.1F, window}, result);
    EXPECT_EQ(result.points.size(), 2U);
  }
  FlatPath result;
  flatten_path(view_of(path), kSame, {0.1F, {{99, 89}, {200, 200}}}, result);
  EXPECT_GT(result.points.size(), 10U);
}

}  // namespace
}  // namespace azulejo
