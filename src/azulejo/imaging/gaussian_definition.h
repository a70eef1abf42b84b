#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

// What a Gaussian is, for everything that smooths with one: weights, and a value of a pass.
namespace azulejo {

/// Up to here bytes are smoothed in integers: the weights' 15 bits are too coarse for wider kernels.
inline constexpr float kFixedGaussianSigma = 16;

/// weights[0 … radius] with weights[0] + 2 · (weights[1] + …) = 1 but for rounding; radius = ceil(4 sigma).
std::vector<double> exact_gaussian_weights(float sigma);

/// The same sum but for the rounding of weights[0].
std::vector<float> float_gaussian_weights(const std::vector<double>& exact);

/// The weights of all taps in 2⁻¹⁵ with a sum of exactly 1, between two zeros. What a rounding leaves goes to the next
/// weight inwards. Ends at the last weight that isn't 0; empty if that is the one in the middle.
std::vector<std::int16_t> fixed_gaussian_weights(const std::vector<double>& exact);

/// One value of one pass: the scalar definition.
template <class T>
float gaussian_value(const float* center, std::ptrdiff_t tap, const std::vector<float>& weights) {
  constexpr bool kAnchored = !std::is_same_v<T, std::uint8_t>;
  float sum = 0;
  for (auto k = static_cast<std::ptrdiff_t>(weights.size()) - 1; k > 0; --k) {
    float pair = center[-k * tap] + center[k * tap];
    if (kAnchored) pair = pair - (center[0] + center[0]);
    sum = sum + weights[static_cast<std::size_t>(k)] * pair;
  }
  return sum + (kAnchored ? center[0] : weights[0] * center[0]);
}

/// The same in integers, with so many bits rounded away, from the first tap on.
template <class T>
int fixed_gaussian_value(const T* first, std::ptrdiff_t tap, const std::vector<std::int16_t>& weights, int shift) {
  std::int32_t sum = 1 << (shift - 1);
  for (std::size_t k = 1; k + 1 < weights.size(); ++k, first += tap) sum += weights[k] * *first;
  return sum >> shift;
}

}  // namespace azulejo
