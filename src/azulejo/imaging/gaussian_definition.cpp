#include "azulejo/imaging/gaussian_definition.h"

#include <cmath>

#include "azulejo/imaging/gaussian_kernels.h"
#include "azulejo/math/exponential.h"

namespace azulejo {

std::vector<double> exact_gaussian_weights(float sigma) {
  const int radius = static_cast<int>(std::ceil(4 * double{sigma}));
  std::vector<double> weights(static_cast<std::size_t>(radius) + 1, 1.0);
  double sum = 1;
  for (int k = 1; k <= radius; ++k) {
    const double steps = k / double{sigma};
    sum += 2 * (weights[static_cast<std::size_t>(k)] = exp_deterministic(-0.5 * steps * steps));
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

std::vector<float> float_gaussian_weights(const std::vector<double>& exact) {
  std::vector<float> weights(exact.size());
  double rest = 1;
  for (std::size_t k = exact.size() - 1; k > 0; --k) {
    weights[k] = static_cast<float>(exact[k]);
    rest -= 2 * double{weights[k]};
  }
  weights[0] = static_cast<float>(rest);
  return weights;
}

std::vector<std::int16_t> fixed_gaussian_weights(const std::vector<double>& exact) {
  constexpr int kOne = 1 << kernels::kGaussianWeightBits;
  std::vector<int> half(exact.size());
  double carried = 0;
  half[0] = kOne;
  for (std::size_t k = exact.size() - 1; k > 0; --k) {
    const double wanted = exact[k] * kOne + carried;
    half[k] = static_cast<int>(std::floor(wanted + 0.5));
    carried = wanted - half[k];
    half[0] -= 2 * half[k];
  }
  while (half.back() == 0) half.pop_back();
  const std::size_t radius = half.size() - 1;
  if (radius == 0) return {};
  std::vector<std::int16_t> weights(2 * radius + 3);
  for (std::size_t k = 0; k <= radius; ++k) {
    weights[radius + 1 - k] = weights[radius + 1 + k] = static_cast<std::int16_t>(half[k]);
  }
  return weights;
}

}  // namespace azulejo
