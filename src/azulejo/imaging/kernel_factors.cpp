#include "azulejo/imaging/kernel_factors.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace azulejo {
namespace {

/// Above this, sums and products of whole numbers could be rounded.
constexpr double kLargestWhole = 0x1p24;

std::size_t place_of_largest(const NumberGrid& kernel) {
  const auto largest = std::max_element(kernel.values.begin(), kernel.values.end(),
                                        [](float a, float b) { return std::fabs(a) < std::fabs(b); });
  return static_cast<std::size_t>(largest - kernel.values.begin());
}

}  // namespace

bool is_whole(const NumberGrid& kernel) {
  return std::all_of(kernel.values.begin(), kernel.values.end(),
                     [](float weight) { return weight == std::floor(weight) && std::fabs(weight) <= kLargestWhole; });
}

std::optional<KernelFactors> kernel_factors(const NumberGrid& kernel) {
  if (kernel.rows < 2 || kernel.columns < 2) return std::nullopt;
  const std::size_t place = place_of_largest(kernel);
  const float pivot = kernel.values[place];
  if (pivot == 0) return std::nullopt;
  const int pivot_row = static_cast<int>(place) / kernel.columns;
  const int pivot_column = static_cast<int>(place) % kernel.columns;

  // Of a whole kernel, the column through the pivot divided by its greatest common divisor leaves a whole row.
  float divisor = pivot;
  const bool whole = is_whole(kernel);
  if (whole) {
    std::int64_t common = 0;
    for (int r = 0; r < kernel.rows; ++r) common = std::gcd(common, static_cast<std::int64_t>(kernel(r, pivot_column)));
    divisor = static_cast<float>(common);
  }
  KernelFactors factors;
  for (int r = 0; r < kernel.rows; ++r) factors.column.push_back(kernel(r, pivot_column) / divisor);
  const float share = factors.column[static_cast<std::size_t>(pivot_row)];
  for (int c = 0; c < kernel.columns; ++c) factors.row.push_back(kernel(pivot_row, c) / share);

  const double allowed = whole ? 0 : kKernelTolerance * std::fabs(double{pivot});
  for (int r = 0; r < kernel.rows; ++r) {
    for (int c = 0; c < kernel.columns; ++c) {
      const double product =
          double{factors.column[static_cast<std::size_t>(r)]} * double{factors.row[static_cast<std::size_t>(c)]};
      if (std::fabs(product - double{kernel(r, c)}) > allowed) return std::nullopt;
    }
  }
  return factors;
}

bool KernelSum::is(double value) const { return std::fabs(sum - value) <= kKernelTolerance * magnitude; }

KernelSum kernel_sum(const std::vector<float>& weights) {
  KernelSum total;
  for (const float weight : weights) {
    total.sum += weight;
    total.magnitude += std::fabs(weight);
  }
  return total;
}

NumberGrid turned(const NumberGrid& kernel) {
  NumberGrid result = kernel;
  std::reverse(result.values.begin(), result.values.end());
  return result;
}

}  // namespace azulejo
