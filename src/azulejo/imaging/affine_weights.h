#pragma once

#include <vector>

#include "azulejo/imaging/affine.h"
#include "azulejo/imaging/affine_kernels.h"

namespace azulejo {

/// The weights of a window, whose first pixel lies `before` pixels before the one that a position is rounded down to.
struct AffineWindow {
  /// widening  how many source pixels stand for one of the result, at least 1
  AffineWindow(AffineFilter filter, double widening);

  kernels::AffineWeights weights() const { return {values.data(), taps, phases}; }

  int taps = 1;
  int before = 0;
  int phases = 0;             ///< 0: nearest and plain bilinear need no table
  std::vector<float> values;  ///< taps for each of phases + 1 rests
};

}  // namespace azulejo
