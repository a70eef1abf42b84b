#pragma once

#include <algorithm>

// How much a pixel counts at a distance of x pixels.
namespace azulejo {

/// sin(πu) for u in [0, 1], by its Taylor series: the same bytes everywhere.
inline double sine_of_half_turn(double u) {
  const double x = 3.14159265358979323846 * std::min(u, 1 - u);
  const double square = x * x;
  double term = x;
  double sum = x;
  for (int n = 1; n <= 10; ++n) {
    term *= -square / ((2 * n) * (2 * n + 1));
    sum += term;
  }
  return sum;
}

/// 3 sin(πx) sin(πx/3) / (πx)² for 0 < x < 3, x no whole number.
inline double lanczos3(double x) {
  const double third = sine_of_half_turn(x / 3);
  const double whole = third * (3 - 4 * third * third);  // sin 3a = 3 sin a − 4 sin³ a
  const double pi_x = 3.14159265358979323846 * x;
  return 3 * whole * third / (pi_x * pi_x);
}

/// Catmull–Rom: Keys' cubic convolution with a = −1/2; 0 ≤ x < 2.
inline double catmull_rom(double x) { return x < 1 ? (1.5 * x - 2.5) * x * x + 1 : ((-0.5 * x + 2.5) * x - 4) * x + 2; }

}  // namespace azulejo
