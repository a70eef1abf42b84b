#pragma once

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include "azulejo/modelling/path_segments.h"

namespace azulejo {

inline bool meets(const Box2& window, const glm::vec2& lower, const glm::vec2& upper) {
  return upper.x >= window.lower.x && lower.x <= window.upper.x && upper.y >= window.lower.y &&
         lower.y <= window.upper.y;
}

/// A curve is cut into as many pieces at most, whatever the tolerance: what is so large lies outside of any picture.
constexpr int kMostCurvePieces = 1024;

/// As many pieces of equal parameter length that their chords are within the tolerance of the curve.
/// Source: Wang, Improvement of the termination criterion for subdivision of the rational Bézier curves: a chord is
/// within 1/8 of the largest second derivative times the squared length of its piece.
inline int pieces_of_curve(const CurveSegment& curve, float tolerance) {
  const auto& p = curve.points;
  const auto bend = [](const glm::vec2& a, const glm::vec2& b, const glm::vec2& c) {
    const glm::vec2 v = (a - b) + (c - b);
    return v.x * v.x + v.y * v.y;
  };
  float square = bend(p[0], p[1], p[2]);
  if (curve.order == 3) square = std::max(square, bend(p[1], p[2], p[3]));
  const float pieces = std::sqrt((curve.order == 3 ? 0.75F : 0.25F) / tolerance * std::sqrt(square));
  if (!(pieces < kMostCurvePieces)) return kMostCurvePieces;
  return std::max(1, static_cast<int>(std::ceil(pieces)));
}

/// Whether the hull of a curve's points reaches into all four sides of the window.
inline bool is_seen(const CurveSegment& curve, const Box2& window) {
  glm::vec2 lower = curve.points[0];
  glm::vec2 upper = lower;
  for (std::size_t i = 1; i <= curve.order; ++i) {
    lower = glm::min(lower, curve.points[i]);
    upper = glm::max(upper, curve.points[i]);
  }
  return meets(window, lower, upper);
}

/// The polynomial of a curve: start + t (linear + t (square + t cube)).
class CurvePolynomial {
 public:
  explicit CurvePolynomial(const CurveSegment& curve) : start_(curve.points[0]) {
    const glm::vec2 first = curve.points[1] - curve.points[0];
    const glm::vec2 second = curve.points[2] - curve.points[1];
    if (curve.order == 2) {
      linear_ = 2.0F * first;
      square_ = second - first;
    } else {
      const glm::vec2 third = curve.points[3] - curve.points[2];
      linear_ = 3.0F * first;
      square_ = 3.0F * (second - first);
      cube_ = (third - second) - (second - first);
    }
  }
  glm::vec2 at(float t) const { return start_ + t * (linear_ + t * (square_ + t * cube_)); }
  glm::vec2 tangent_at(float t) const { return linear_ + t * (2.0F * square_ + t * (3.0F * cube_)); }

 private:
  glm::vec2 start_;
  glm::vec2 linear_;
  glm::vec2 square_;
  glm::vec2 cube_{0};
};

}  // namespace azulejo
