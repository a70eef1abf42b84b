#pragma once

#include <algorithm>
#include <bit>
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

/// A line for 16-bit values, in their own units: rounded half up and saturated. Sums are rounded to 1/128 before.
///
/// A sum lies between 2¹⁶ and 2¹⁷, where a float has seven bits behind the point: those above them are the result.
struct WordLine {
  explicit WordLine(const LinearFunction& line)
      : scale(line.scale),
        offset(line.offset * kTop + (kMoved + 0.5F)),
        low(std::clamp(line.low, 0.0F, 1.0F) * kTop + kMoved),
        high(std::clamp(line.high, 0.0F, 1.0F) * kTop + (kMoved + 0.5F)) {}
  std::uint16_t operator()(std::uint16_t v) const {
    const float moved = cut(static_cast<float>(v) * scale + offset, low, high);
    return static_cast<std::uint16_t>(std::bit_cast<std::uint32_t>(moved) >> kBehindPoint);
  }

  static constexpr float kTop = 65535;
  static constexpr float kMoved = 65536;
  static constexpr int kBehindPoint = 7;
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
