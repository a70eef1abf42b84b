#pragma once

#include <vector>

#include "azulejo/imaging/convolve_kernels.h"
#include "azulejo/math/number_grid.h"

namespace azulejo {

/// The steps of a weighted sum over `kernel`, whose weight in the center is for the result's own place.
///
/// With `differences`, what is weighted is not values but the differences between a value and the next one to the
/// right, and in the center's column between a value and the next one below: Σ w(i) v(i) is the sum of all weights
/// times the center and, on either side, the sums of weights from the end up to there times the differences. If all
/// weights sum to 0 or 1, constants then come out exact, at no more work.
struct FilterPass {
  FilterPass(const NumberGrid& kernel, int center_row_of, int center_column_of, int channels, bool by_differences);

  int rows;  ///< of the kernel
  int center_row;
  bool differences;
  bool keeps;   ///< with differences: the center is added
  bool across;  ///< differences to the right are read: source row 2s; those downwards: row 2s + 1
  std::vector<kernels::ConvolveStep> group;   ///< for kConvolveRows rows at once
  std::vector<kernels::ConvolveStep> single;  ///< for one
  float scale = 1;
  float offset = 0;

  kernels::ConvolveTaps taps(int count) const { return {count == 1 ? single : group, differences, scale, offset}; }
};

}  // namespace azulejo
