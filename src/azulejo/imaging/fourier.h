#pragma once

#include <functional>
#include <vector>

#include "azulejo/core/run.h"

namespace azulejo {

/// Discrete Fourier transforms of kLanes sequences of complex f32 numbers side by side: X(k) = Σ x(j) e^(−2πi jk/n).
///
/// Value j of sequence l is re[j · kLanes + l], im[j · kLanes + l]. Additions, subtractions and multiplications in one
/// order, by factors that are rounded once: the same bytes everywhere. Within about 10⁻⁷ · log₂ n of the root of the
/// sum of squares.
/// Sizes   any; those without other prime factors than 2, 3 and 5 in O(n log n), others by way of a convolution of such a size
///         (Bluestein)
/// Source  Stockham's order of Cooley and Tukey's factors, as in Van Loan, Computational Frameworks for the Fast Fourier
///         Transform, 1992, 1.7; Bluestein 1970
class FourierPlan {
 public:
  static constexpr int kLanes = 16;

  explicit FourierPlan(int n);

  int size() const { return n_; }
  /// The smallest size of at least `least` that is a power of two times 1, 3, 5, 9 or 15.
  static int fast_size(int least);
  /// Values of `work` that the transforms need.
  std::size_t work_values() const;
  void forward(float* re, float* im, float* work) const;
  /// n times the inverse.
  void inverse(float* re, float* im, float* work) const { forward(im, re, work); }

 private:
  void transform(float* re, float* im, float* work) const;
  void transform_by_chirp(float* re, float* im, float* work) const;

  int n_;
  std::vector<int> radices_;
  std::vector<float> factors_;       ///< of each stage: cosine and −sine for each place and output but the first
  std::vector<FourierPlan> padded_;  ///< of the convolution's size; none where the size is fast
  std::vector<float> chirp_;         ///< cosine, −sine of πk²/n
  std::vector<float> chirp_transform_;
};

/// The transform of a real image: columns 0 … width / 2 of it, the others are their conjugates mirrored.
struct HalfSpectrum {
  HalfSpectrum(int width_of, int height_of);

  int width;
  int height;
  int columns;
  std::size_t stride;
  std::vector<float> re;
  std::vector<float> im;
};

/// The transform along rows: read(y, row) gives the values of a row. Called from several threads.
void fourier_rows(HalfSpectrum& spectrum, const Run& run, const std::function<void(int y, float* row)>& read);
/// The way back for the first `rows` rows, times the width: write(y, row).
void inverse_fourier_rows(const HalfSpectrum& spectrum, const Run& run, int rows,
                          const std::function<void(int y, const float* row)>& write);
/// The transform along columns; with `change`, which is called with kLanes values from column u on in row v, then
/// transformed back, times the height.
void fourier_columns(HalfSpectrum& spectrum, const Run& run,
                     const std::function<void(int v, int u, float* re, float* im)>& change = {});

}  // namespace azulejo
