#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace azulejo {

/// The sum of up to 2³⁹ floats, the same in whatever order they come: mantissas are added as integers, for each exponent
/// apart. NaN and infinities are not taken in.
class ExactSum {
 public:
  void add(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t exponent = bits >> 23 & 0xFF;
    const std::int64_t mantissa = static_cast<std::int64_t>(bits & 0x7FFFFF) + (exponent > 0 ? 0x800000 : 0);
    if (exponent == 0xFF) return;
    sums_[exponent] += bits >> 31 != 0 ? -mantissa : mantissa;
  }
  void merge(const ExactSum& other) {
    for (std::size_t e = 0; e < sums_.size(); ++e) sums_[e] += other.sums_[e];
  }
  /// Rounded, at each exponent, to a double: within 10⁻¹⁴ of the sum of absolute values.
  double value() const {
    double sum = 0;
    for (std::size_t e = 0; e < sums_.size(); ++e) {
      sum += std::ldexp(static_cast<double>(sums_[e]), std::max(1, static_cast<int>(e)) - 150);
    }
    return sum;
  }

 private:
  std::array<std::int64_t, 255> sums_{};
};

}  // namespace azulejo
