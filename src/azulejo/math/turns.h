#pragma once

#include <cstdint>

namespace azulejo {

struct Turn {
  double cosine;
  double sine;
};

/// Cosine and sine of 2π · part / whole, within 2⁻⁵²; additions, multiplications and divisions only. Quarters of
/// a turn give 0 and ±1 exactly.
/// Source: Taylor series on an eighth of a turn to both sides of the nearest quarter.
inline Turn turn_of(std::int64_t part, std::int64_t whole) {
  part = (part % whole + whole) % whole;
  const std::int64_t quarter = (4 * part + whole / 2) / whole;  // the nearest one
  const double f =
      6.283185307179586 * static_cast<double>(4 * part - quarter * whole) / (4.0 * static_cast<double>(whole));
  double cosine = 1;
  double sine = 1;
  for (int k = 18; k >= 2; k -= 2) {
    cosine = 1 - cosine * f * f / (k * (k - 1));
    sine = 1 - sine * f * f / (k * (k + 1));
  }
  sine *= f;
  switch (quarter % 4) {
    case 0: return {cosine, sine};
    case 1: return {-sine, cosine};
    case 2: return {-cosine, -sine};
    default: return {sine, -cosine};
  }
}

}  // namespace azulejo
