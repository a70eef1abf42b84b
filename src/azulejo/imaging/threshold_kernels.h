#pragma once

#include <cstddef>
#include <cstdint>

namespace azulejo::kernels {

/// result[i] = source[i] > level ? above : below, for `count` values; with a period of 2 or 4, the last value of
/// each period (alpha) is copied. In place is allowed.
void threshold_row(const std::uint8_t* source, std::uint8_t* result, std::size_t count, int period, std::uint8_t level,
                   std::uint8_t above, std::uint8_t below);
void threshold_row(const std::uint16_t* source, std::uint16_t* result, std::size_t count, int period,
                   std::uint16_t level, std::uint16_t above, std::uint16_t below);
void threshold_row(const float* source, float* result, std::size_t count, int period, float level, float above,
                   float below);

}  // namespace azulejo::kernels
