#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace azulejo {

/// 2^p for −126 < p < 127.5. Within 3·10⁻⁷ of the value; additions and multiplications only, so the same bytes everywhere.
/// Source: Taylor series of exp(f ln 2) to the seventh power, |f| ≤ 1/2.
inline float exp2_deterministic(float p) {
  const float whole = std::floor(p + 0.5F);
  const float f = p - whole;
  float sum = 1.5252734e-5F;
  sum = sum * f + 1.5403530e-4F;
  sum = sum * f + 1.3333558e-3F;
  sum = sum * f + 9.6181291e-3F;
  sum = sum * f + 5.5504109e-2F;
  sum = sum * f + 2.4022651e-1F;
  sum = sum * f + 6.9314718e-1F;
  sum = sum * f + 1.0F;
  const auto exponent = static_cast<std::int32_t>(whole) + 127;
  return sum * std::bit_cast<float>(exponent << 23);
}

/// log2(x) for normal x > 0. Within 3·10⁻⁷ absolutely for x in [1/2, 2], relatively beyond.
/// Source: log2 m = 2/ln 2 · artanh((m − 1)/(m + 1)), m in [√½, √2), to the ninth power.
inline float log2_deterministic(float x) {
  const auto bits = std::bit_cast<std::int32_t>(x);
  // The exponent that leaves m in [√½, √2).
  const std::int32_t exponent = (bits - 0x3F3504F3) >> 23;
  const float m = std::bit_cast<float>(bits - (exponent << 23));
  const float s = (m - 1.0F) / (m + 1.0F);
  const float square = s * s;
  float sum = 0.32059889F;
  sum = sum * square + 0.41219858F;
  sum = sum * square + 0.57707802F;
  sum = sum * square + 0.96179669F;
  sum = sum * square + 2.8853901F;
  return static_cast<float>(exponent) + s * sum;
}

/// x^exponent for x ≥ 0 and exponent > 0. Relatively within 10⁻⁶ · (1 + |log2 of the result|) of the value, up to 2·10³⁸,
/// where it stays; what is below 2⁻¹²⁵ is 0. 0, 1, infinity and NaN stay as they are.
inline float power_deterministic(float x, float exponent) {
  constexpr float kSmallestNormal = 0x1p-126F;
  if (x < kSmallestNormal) return 0;
  if (!(x < 3e38F)) return x;
  const float p = exponent * log2_deterministic(x);
  if (p < -125.0F) return 0;
  return exp2_deterministic(p < 127.4F ? p : 127.4F);
}

/// An sRGB-encoded intensity as linear light (IEC 61966-2-1). Beyond 0–1 the curve goes on, odd around 0.
/// Within 10⁻⁶ of the value; NaN stays NaN.
inline float srgb_to_linear(float encoded) {
  const float x = std::fabs(encoded);
  if (!(x > 0.04045F)) return encoded / 12.92F;
  if (!(x < 1e9F)) return encoded;
  const float power = exp2_deterministic(2.4F * log2_deterministic((x + 0.055F) / 1.055F));
  return std::copysign(power, encoded);
}

/// Linear light as an sRGB-encoded intensity: the inverse.
inline float linear_to_srgb(float linear) {
  const float x = std::fabs(linear);
  if (!(x > 0.0031308F)) return linear * 12.92F;
  if (!(x < 1e9F)) return linear;
  const float power = exp2_deterministic((1.0F / 2.4F) * log2_deterministic(x));
  return std::copysign(1.055F * power - 0.055F, linear);
}

}  // namespace azulejo
