#pragma once

#include <cmath>

namespace azulejo {

/// The angle of (x, y) in (−π, π], counter-clockwise where y points up; 0 for (0, 0). Within 4·10⁻⁷ of the value.
/// Additions, multiplications and one division only, so the same bytes everywhere; -0 counts as 0. NaN if a value is
/// NaN or both are infinite.
/// Source: arctan t ÷ t on [0, 1] interpolated in t² at Chebyshev's nodes, to the eighth power.
inline float atan2_deterministic(float y, float x) {
  const float across = std::fabs(x);
  const float up = std::fabs(y);
  const bool steep = up > across;
  const float large = steep ? up : across;
  const float small = steep ? across : up;
  if (large == 0) return 0;
  const float t = small / large;
  const float square = t * t;
  float sum = 0.00283406419F;
  sum = sum * square + -0.0160050299F;
  sum = sum * square + 0.0425876081F;
  sum = sum * square + -0.0749544576F;
  sum = sum * square + 0.106367543F;
  sum = sum * square + -0.142025709F;
  sum = sum * square + 0.199924842F;
  sum = sum * square + -0.333330661F;
  float angle = (sum * square) * t + t;
  if (steep) angle = 1.57079633F - angle;
  if (x < 0) angle = 3.14159265F - angle;
  return y < 0 ? -angle : angle;
}

}  // namespace azulejo
