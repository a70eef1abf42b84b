#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace azulejo {

/// `v` cut to [low, high]; NaN stays NaN.
inline float cut(float v, float low, float high) { return v < low ? low : v > high ? high : v; }

/// scale · v + offset, cut to [low, high]. NaN stays NaN.
struct LinearFunction {
  float operator()(float v) const { return cut(v * scale + offset, low, high); }
  float scale = 1;
  float offset = 0;
  float low = -HUGE_VALF;
  float high = HUGE_VALF;
};

/// A line for 16-bit values, in their own units: rounded once, half up, saturated.
struct WordLine {
  explicit WordLine(const LinearFunction& line)
      : scale(line.scale),
        offset(line.offset * kTop + 0.5F),
        low(std::clamp(line.low, 0.0F, 1.0F) * kTop + 0.5F),
        high(std::clamp(line.high, 0.0F, 1.0F) * kTop + 0.5F) {}
  std::uint16_t operator()(std::uint16_t v) const {
    return static_cast<std::uint16_t>(static_cast<int>(cut(static_cast<float>(v) * scale + offset, low, high)));
  }

  static constexpr float kTop = 65535;
  float scale;
  float offset;  ///< with the half that rounds
  float low;
  float high;
};

namespace kernels {
/// result[i] = line(source[i]), with vectors. In place is allowed.
void word_line(const WordLine& line, const std::uint16_t* source, std::uint16_t* result, std::size_t count);
}  // namespace kernels

}  // namespace azulejo
