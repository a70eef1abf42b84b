#include "azulejo/imaging/filter_pass.h"

#include "azulejo/imaging/kernel_factors.h"

namespace azulejo {
namespace {

using kernels::ConvolveStep;

/// A weight of the source row that `row` counts from the first one that a result row reads.
struct Tap {
  int row;
  int column;
  int mirror;  ///< a column with the same weight; as `column`: none
  float weight;
};

bool is_symmetric(const NumberGrid& kernel, int center_column) {
  if (kernel.columns != 2 * center_column + 1) return false;
  for (int r = 0; r < kernel.rows; ++r) {
    for (int c = 0; c < center_column; ++c) {
      if (kernel(r, c) != kernel(r, kernel.columns - 1 - c)) return false;
    }
  }
  return true;
}

/// The weights of differences between neighbors in a line whose values have these weights.
std::vector<double> of_differences(const std::vector<double>& weights, std::size_t center) {
  std::vector<double> result(weights.size() - 1);
  double sum = 0;
  for (std::size_t i = 0; i < center; ++i) result[i] = -(sum += weights[i]);
  sum = 0;
  for (std::size_t i = weights.size() - 1; i > center; --i) result[i - 1] = sum += weights[i];
  return result;
}

std::vector<Tap> difference_taps(const NumberGrid& kernel, int center_row, int center_column) {
  const bool symmetric = is_symmetric(kernel, center_column);
  std::vector<Tap> taps;
  std::vector<double> row_sums;
  for (int r = 0; r < kernel.rows; ++r) {
    std::vector<double> row;
    double sum = 0;
    for (int c = 0; c < kernel.columns; ++c) sum += row.emplace_back(kernel(r, c));
    row_sums.push_back(sum);
    const std::vector<double> across = of_differences(row, static_cast<std::size_t>(center_column));
    const int last = static_cast<int>(across.size()) - 1;
    for (int c = 0; c <= last; ++c) {
      const int mirror = symmetric ? last - c : c;  // of opposite weight
      if (mirror < c) break;
      taps.push_back({2 * r, c, mirror, static_cast<float>(across[static_cast<std::size_t>(mirror)])});
    }
  }
  const std::vector<double> down = of_differences(row_sums, static_cast<std::size_t>(center_row));
  for (std::size_t r = 0; r < down.size(); ++r) {
    taps.push_back({2 * static_cast<int>(r) + 1, center_column, center_column, static_cast<float>(down[r])});
  }
  return taps;
}

std::vector<Tap> plain_taps(const NumberGrid& kernel, int center_column) {
  const bool symmetric = is_symmetric(kernel, center_column);
  std::vector<Tap> taps;
  for (int r = 0; r < kernel.rows; ++r) {
    for (int c = 0; c < (symmetric ? center_column + 1 : kernel.columns); ++c) {
      taps.push_back({r, c, symmetric ? kernel.columns - 1 - c : c, kernel(r, c)});
    }
  }
  return taps;
}

/// For each source row and column that result rows read, one step. `per_row`: source rows to a row of the image.
std::vector<ConvolveStep> make_steps(const std::vector<Tap>& taps, const NumberGrid& kernel, int center_column,
                                     int channels, int rows, int per_row) {
  const int source_rows = per_row * (kernel.rows + rows - 1);
  std::vector<ConvolveStep> all(static_cast<std::size_t>(source_rows) * static_cast<std::size_t>(kernel.columns));
  for (int r = 0; r < rows; ++r) {
    for (const Tap& tap : taps) {
      if (tap.weight == 0) continue;
      const int row = tap.row + per_row * r;
      ConvolveStep& step = all[static_cast<std::size_t>(row * kernel.columns + tap.column)];
      step.offset = std::ptrdiff_t{tap.column - center_column} * channels;
      step.mirror = std::ptrdiff_t{tap.mirror - center_column} * channels;
      step.row = row;
      step.outputs |= 1U << r;
      step.weights[r] = tap.weight;
    }
  }
  std::erase_if(all, [](const ConvolveStep& step) { return step.outputs == 0; });
  return all;
}

}  // namespace

FilterPass::FilterPass(const NumberGrid& kernel, int center_row_of, int center_column_of, int channels,
                       bool by_differences)
    : rows(kernel.rows),
      center_row(center_row_of),
      differences(by_differences),
      keeps(by_differences && !kernel_sum(kernel.values).is(0)),
      across(kernel.columns > 1) {
  const std::vector<Tap> taps =
      by_differences ? difference_taps(kernel, center_row_of, center_column_of) : plain_taps(kernel, center_column_of);
  const int per_row = by_differences ? 2 : 1;
  group = make_steps(taps, kernel, center_column_of, channels, kernels::kConvolveRows, per_row);
  single = make_steps(taps, kernel, center_column_of, channels, 1, per_row);
}

}  // namespace azulejo
