#pragma once

#include <cmath>
#include <cstdint>

#include "azulejo/math/transfer.h"

namespace azulejo {

/// The normal deviate (mean 0, variance 1) of which a share of (bits + ½) / 2³² is below: equally distributed bits give
/// normally distributed numbers, up to ±6.3. Within 2·10⁻⁶ as far as ±5.4, which one in 15 million is beyond, within
/// 0.003 there; additions, multiplications, divisions and square roots only, so the same bytes everywhere. The deviate
/// of ~bits is the negative one.
/// Source: Giles, Approximating the erfinv function, GPU Computing Gems, 2011.
inline float normal_deviate(std::uint32_t bits) {
  const bool below = bits < 0x80000000U;
  // The share on this side, up to ½: near 0 it has all its digits.
  const float share = (static_cast<float>(static_cast<std::int32_t>(below ? bits : ~bits)) + 0.5F) * 0x1p-32F;
  const float x = 1.0F - 2.0F * share;
  const float w = -0.693147181F * log2_deterministic(4.0F * share * (1.0F - share));
  float p = 0;
  if (w < 5.0F) {
    const float v = w - 2.5F;
    p = 2.81022636e-08F;
    p = p * v + 3.43273939e-07F;
    p = p * v + -3.5233877e-06F;
    p = p * v + -4.39150654e-06F;
    p = p * v + 0.00021858087F;
    p = p * v + -0.00125372503F;
    p = p * v + -0.00417768164F;
    p = p * v + 0.246640727F;
    p = p * v + 1.50140941F;
  } else {
    const float v = std::sqrt(w) - 3.0F;
    p = -0.000200214257F;
    p = p * v + 0.000100950558F;
    p = p * v + 0.00134934322F;
    p = p * v + -0.00367342844F;
    p = p * v + 0.00573950773F;
    p = p * v + -0.0076224613F;
    p = p * v + 0.00943887047F;
    p = p * v + 1.00167406F;
    p = p * v + 2.83297682F;
  }
  const float deviate = 1.41421356F * x * p;
  return below ? -deviate : deviate;
}

}  // namespace azulejo
