#pragma once

#include <cstddef>
#include <cstdint>

// Loops of `compare` over rows of f32.
namespace azulejo::kernels {

/// (K₁ · 1)² and (K₂ · 1)² of SSIM.
inline constexpr float kSsimC1 = 0.01F * 0.01F;
inline constexpr float kSsimC2 = 0.03F * 0.03F;

/// row[i] /= unit
void divide_row(float* row, std::size_t count, float unit);

/// result[i] = |a − b| · gain; 0 where both are equal or both are NaN
void difference_row(const float* a, const float* b, std::size_t count, float gain, float* result);

/// result[i] = a[i] · b[i]
void product_row(const float* a, const float* b, std::size_t count, float* result);

/// SSIM of weighted means of x, y, x², y², xy; at most 1.
void similarity_row(const float* const means[5], std::size_t count, float* result);

struct WholeSums {
  float largest = 0;
  std::size_t different = 0;  ///< values that aren't 0
  std::uint64_t sum = 0;
  std::uint64_t squares = 0;
};
/// Sums of row[i] · steps, rounded: whole numbers up to 65535.
WholeSums sum_whole(const float* row, std::size_t count, float steps);

}  // namespace azulejo::kernels
