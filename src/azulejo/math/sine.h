#pragma once

#include <cmath>
#include <cstdint>

namespace azulejo {

struct SineCosine {
  float sine;
  float cosine;
};

/// Sine and cosine of an angle in turns, |turns| < 10⁶. Within 2·10⁻⁷ of the values for the float that is given;
/// additions and multiplications only, so the same bytes everywhere. Quarters of a turn give 0 and ±1 exactly.
/// Source: Taylor series on an eighth of a turn to both sides of the nearest quarter.
inline SineCosine sine_cosine_of_turns(float turns) {
  const float quarters = std::floor(4.0F * turns + 0.5F);
  const float f = turns - 0.25F * quarters;
  const float square = f * f;
  float sine = 42.0586940F;
  sine = sine * square + -76.7058597F;
  sine = sine * square + 81.6052493F;
  sine = sine * square + -41.3417022F;
  sine = sine * square + 6.28318531F;
  sine = sine * f;
  float cosine = 60.2446414F;
  cosine = cosine * square + -85.4568172F;
  cosine = cosine * square + 64.9393940F;
  cosine = cosine * square + -19.7392088F;
  cosine = cosine * square + 1.0F;
  const auto quadrant = static_cast<std::int32_t>(quarters);
  const bool swap = (quadrant & 1) != 0;
  const float s = swap ? cosine : sine;
  const float c = swap ? sine : cosine;
  return {(quadrant & 2) != 0 ? -s : s, ((quadrant + 1) & 2) != 0 ? -c : c};
}

}  // namespace azulejo
