#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

namespace azulejo {

struct Turn {
  double cosine;
  double sine;
};

/// Cosine and sine of `quarter` quarters of a turn and f radians, |f| ≤ π / 4.
/// Source: Taylor series on an eighth of a turn to both sides of the quarter.
inline Turn turn_from(std::int64_t quarter, double f) {
  double cosine = 1;
  double sine = 1;
  for (int k = 18; k >= 2; k -= 2) {
    cosine = 1 - cosine * f * f / (k * (k - 1));
    sine = 1 - sine * f * f / (k * (k + 1));
  }
  sine *= f;
  switch (quarter & 3) {
    case 0: return {cosine, sine};
    case 1: return {-sine, cosine};
    case 2: return {-cosine, -sine};
    default: return {sine, -cosine};
  }
}

/// Cosine and sine of 2π · part / whole, within 2⁻⁵²; additions, multiplications and divisions only. Quarters of
/// a turn give 0 and ±1 exactly.
inline Turn turn_of(std::int64_t part, std::int64_t whole) {
  part = (part % whole + whole) % whole;
  const std::int64_t quarter = (4 * part + whole / 2) / whole;  // the nearest one
  return turn_from(quarter, 6.283185307179586 * static_cast<double>(4 * part - quarter * whole) /
                                (4.0 * static_cast<double>(whole)));
}

/// The same of an angle in degrees. NaN of one that is not finite, or of more than 10¹² degrees.
inline Turn turn_of_degrees(double degrees) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  if (!(std::fabs(degrees) <= 1e12)) return {kNaN, kNaN};
  const double quarter = std::floor(degrees / 90 + 0.5);
  return turn_from(static_cast<std::int64_t>(quarter), (degrees - 90 * quarter) * 0.017453292519943295);
}

/// The same of an angle in radians. What a multiple of π / 2 is rounded to counts as that quarter of a turn.
/// NaN of one that is not finite, or of more than 10⁹ radians.
inline Turn turn_of_radians(double radians) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kQuarter = 1.5707963267948966;  // π / 2, rounded
  if (!(std::fabs(radians) <= 1e9)) return {kNaN, kNaN};
  const double quarter = std::floor(radians / kQuarter + 0.5);
  constexpr double kHigh = 1.5707963267341256;  // its first 33 bits: products with whole numbers below 2²⁰ are exact
  constexpr double kLow = 6.077100506506192e-11;
  const double f = radians == quarter * kQuarter ? 0 : ((radians - quarter * kHigh) - quarter * kLow);
  return turn_from(static_cast<std::int64_t>(quarter), f);
}

}  // namespace azulejo
