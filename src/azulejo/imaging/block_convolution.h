#pragma once

#include <vector>

#include "azulejo/imaging/fourier.h"
#include "azulejo/math/number_grid.h"
#include "azulejo/math/rect.h"

namespace azulejo {

/// Correlation with large kernels by Fourier transforms of blocks, which lie at fixed places of the image: a result
/// depends on its block only.
///
/// Exact  differences from the block's first value are transformed, so constants give exactly themselves times `sum`.
///        Else within 2⁻¹⁶ · (kBlock + side) / √(rows + columns) · √(Σ weight²) of the largest value
class BlockConvolution {
 public:
  static constexpr int kBlock = 256;

  /// sum  of the weights, as a constant is to be multiplied with it
  BlockConvolution(const NumberGrid& kernel, float sum);

  /// The blocks' parts of an image that a part of the result lies in.
  static Rect blocks(const Rect& part, const Rect& image);
  /// results(x, y) = Σ weights(r, c) · source(x + c, y + r) for a block of this size. Values lie `step` apart, rows
  /// `source_stride` and `stride`.
  void run(const float* source, std::ptrdiff_t source_stride, int width, int height, int step, float* results,
           std::ptrdiff_t stride) const;

 private:
  int rows_;
  int columns_;
  float sum_;
  HalfSpectrum kernel_;
};

}  // namespace azulejo
