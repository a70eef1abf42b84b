#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "azulejo/imaging/resize.h"

namespace azulejo {

/// Sums of more products than this are divided into blocks, see weighted_sum.
inline constexpr int kTapBlock = 32;

/// Which pixels of a row (or column) of `source` pixels make up the pixels of one that has `result` pixels, and with
/// what weights. Each result pixel has a window of `taps()` neighbouring source pixels, all inside the source; the
/// windows move monotonously. Positions are computed in integers: exact for any size.
class Axis {
 public:
  Axis(int source, int result, ResizeFilter filter);

  int source() const { return source_; }
  int result() const { return result_; }
  int taps() const { return taps_; }
  /// Same size: each pixel is its source pixel.
  bool identity() const { return source_ == result_; }
  bool enlarging() const { return result_ >= source_; }

  /// The first source pixel in the window of result pixel `j`.
  int first(int j) const;
  /// The `taps()` weights of the window of result pixel `j`. Their sum is 1 but for the last bit.
  void weights(int j, float* out) const;
  /// Weights and window of j are those of j − period(), moved, if no window of the two was cut by an end.
  int period() const { return period_; }
  bool cut(int j) const;

 private:
  std::int64_t uncut_first(int j) const;
  double kernel(std::int64_t pixel, int j) const;

  int source_;
  int result_;
  ResizeFilter filter_;
  int taps_;
  int period_;
};

/// Windows and weights of the result pixels [begin, end), ready for kernels.
struct TapTable {
  static constexpr int kPadding = 16;  ///< values behind each array that kernels may read

  TapTable() = default;
  /// by_tap  also the weights tap by tap, which enlarging kernels want
  TapTable(const Axis& axis, int begin, int end, bool by_tap);

  const int* first_of(int j) const { return first.data() + (j - begin); }
  const float* weights_of(int j) const { return weights.data() + static_cast<std::ptrdiff_t>(j - begin) * taps; }

  int begin = 0;
  int end = 0;
  int taps = 0;
  std::vector<int> first;
  std::vector<float> weights;  ///< pixel by pixel
  std::vector<float> by_tap;   ///< tap by tap, `stride` values each
  std::ptrdiff_t stride = 0;
};

/// The sum of weight × value over a window: how every filtered value is defined.
///
/// Up to kTapBlock products are added in their order. Of more, those at the source positions [32 n, 32 n + 32) are
/// added in their order, and the sums of these blocks with Kahan's compensation: rounding stays that of about 32
/// additions for any number of taps.
/// at(k)  the value at source position k
template <class At>
float weighted_sum(const float* weights, int first, int taps, At at) {
  const auto plain = [&](int from, int to) {
    float sum = weights[from - first] * at(from);
    for (int k = from + 1; k < to; ++k) sum = sum + weights[k - first] * at(k);
    return sum;
  };
  const int end = first + taps;
  if (taps <= kTapBlock) return plain(first, end);
  float sum = 0;
  float compensation = 0;
  for (int from = first; from < end;) {
    const int to = from / kTapBlock * kTapBlock + kTapBlock < end ? from / kTapBlock * kTapBlock + kTapBlock : end;
    const float corrected = plain(from, to) - compensation;
    const float total = sum + corrected;
    compensation = (total - sum) - corrected;
    sum = total;
    from = to;
  }
  return sum;
}

}  // namespace azulejo
