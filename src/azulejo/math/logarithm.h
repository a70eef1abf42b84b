#pragma once

#include <bit>
#include <cstdint>

namespace azulejo {

/// ln x for normal positive x, within 10⁻¹⁵ · max(1, |ln x|). Additions, multiplications and divisions only, so the same
/// bytes everywhere.
/// Source: x = 2ⁿ · m with m in [¾, 1½) and ln m = 2 artanh((m − 1) / (m + 1)), its series to the 33rd power.
inline double log_deterministic(double x) {
  constexpr double kLn2 = 0.6931471805599453;
  const auto bits = std::bit_cast<std::int64_t>(x);
  auto exponent = (bits >> 52) - 1023;
  double m = std::bit_cast<double>((bits & 0xFFFFFFFFFFFFF) | (std::int64_t{1023} << 52));
  if (m >= 1.5) {
    m *= 0.5;
    ++exponent;
  }
  const double t = (m - 1) / (m + 1);
  const double square = t * t;
  double sum = 0;
  for (int k = 33; k >= 1; k -= 2) sum = sum * square + 1.0 / k;
  return static_cast<double>(exponent) * kLn2 + 2 * t * sum;
}

}  // namespace azulejo
