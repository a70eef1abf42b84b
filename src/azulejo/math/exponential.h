#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace azulejo {

/// e^x for x ≤ 700, within 10⁻¹⁵ of the value, relatively; 0 below −700. Additions, multiplications and divisions
/// only, so the same bytes everywhere. NaN stays NaN.
/// Source: x = n ln 2 + f, |f| ≤ ½ ln 2, with ln 2 in two parts; Taylor series of e^f to the thirteenth power.
inline double exp_deterministic(double x) {
  if (x < -700.0) return 0;
  if (x != x) return x;
  constexpr double kLog2E = 1.4426950408889634;
  constexpr double kLn2High = 0x1.62e42feep-1;  // 32 bits: n · kLn2High is exact
  constexpr double kLn2Low = 1.90821492927058770e-10;
  const double n = std::floor(x * kLog2E + 0.5);
  const double f = (x - n * kLn2High) - n * kLn2Low;
  double sum = 1.0;
  for (int k = 13; k >= 1; --k) sum = 1.0 + sum * f / k;
  return sum * std::bit_cast<double>((static_cast<std::int64_t>(n) + 1023) << 52);
}

}  // namespace azulejo
