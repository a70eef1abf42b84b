#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

namespace azulejo {

/// The largest difference of two matrices' entries.
template <glm::length_t N>
double difference(const glm::mat<N, N, double>& a, const glm::mat<N, N, double>& b) {
  double largest = 0;
  for (glm::length_t column = 0; column < N; ++column) {
    for (glm::length_t row = 0; row < N; ++row) {
      const double d = std::fabs(a[column][row] - b[column][row]);
      largest = std::isnan(d) ? 1e300 : std::max(largest, d);
    }
  }
  return largest;
}

/// Random numbers that the seed tells.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  /// Away from 0, either sign.
  double factor() { return (engine_() % 2 == 0 ? -1 : 1) * (*this)(0.3, 3); }
  glm::dvec2 point2(double size = 10) { return {(*this)(-size, size), (*this)(-size, size)}; }
  glm::dvec3 point3(double size = 10) { return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)}; }
  unsigned below(unsigned count) { return static_cast<unsigned>(engine_() % count); }

 private:
  std::mt19937 engine_;
};

}  // namespace azulejo
