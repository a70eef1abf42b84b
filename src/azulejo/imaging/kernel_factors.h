#pragma once

#include <optional>
#include <vector>

#include "azulejo/math/number_grid.h"

namespace azulejo {

/// A kernel that is a column times a row: weights(r, c) = column[r] · row[c].
struct KernelFactors {
  std::vector<float> column;
  std::vector<float> row;
};

/// Weights that differ by no more than this share of the largest one, or a sum that is so far from 0 or 1 in relation
/// to the sum of magnitudes, are taken for equal.
constexpr double kKernelTolerance = 0x1p-20;

/// The factors of a kernel with more than a row and a column; none if it has no such factors.
/// Whole numbers have whole factors, exactly; others within kKernelTolerance · the largest weight.
std::optional<KernelFactors> kernel_factors(const NumberGrid& kernel);

/// True if all weights are whole numbers.
bool is_whole(const NumberGrid& kernel);

/// The sum of all weights, and that of their magnitudes.
struct KernelSum {
  double sum = 0;
  double magnitude = 0;
  bool is(double value) const;  ///< within kKernelTolerance
};
KernelSum kernel_sum(const std::vector<float>& weights);

/// Turned by 180°: the convolution with it is the correlation with the other.
NumberGrid turned(const NumberGrid& kernel);

}  // namespace azulejo
