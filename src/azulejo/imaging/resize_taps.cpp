#include "azulejo/imaging/resize_taps.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "azulejo/imaging/resampling_kernels.h"

namespace azulejo {
namespace {

std::int64_t floor_divide(std::int64_t a, std::int64_t b) { return a >= 0 ? a / b : -((-a + b - 1) / b); }

/// Half the width of a filter, in pixels of the coarser of both grids.
int support(ResizeFilter filter) {
  switch (filter) {
    case ResizeFilter::Bilinear: return 1;
    case ResizeFilter::Bicubic: return 2;
    case ResizeFilter::Lanczos: return 3;
    default: return 0;
  }
}

}  // namespace

Axis::Axis(int source, int result, ResizeFilter filter) : source_(source), result_(result), filter_(filter) {
  const std::int64_t divisor = std::gcd(source, result);
  const std::int64_t p = source / divisor;
  const std::int64_t q = result / divisor;
  std::int64_t count = 1;
  if (filter == ResizeFilter::Area) {
    count = (p + 2 * q - 2) / q;  // of intervals [m/q, (m + p)/q): the most unit cells that one touches
  } else if (filter != ResizeFilter::Nearest) {
    const int a = support(filter);
    count = p > q ? (2 * a * p + q - 1) / q : 2 * a;  // whole numbers in an open interval of that length, at most
  }
  if (identity()) count = 1;
  taps_ = static_cast<int>(std::min<std::int64_t>(count, source));
  period_ = static_cast<int>(q);
}

std::int64_t Axis::uncut_first(int j) const {
  const std::int64_t source = source_;
  const std::int64_t result = result_;
  if (identity()) return j;
  if (filter_ == ResizeFilter::Nearest) return (2 * std::int64_t{j} + 1) * source / (2 * result);
  if (filter_ == ResizeFilter::Area) return std::int64_t{j} * source / result;
  // The first k with k + ½ > (j + ½) source/result − support · max(1, source/result).
  const std::int64_t reach = support(filter_) * std::max(source, result);
  return floor_divide((2 * std::int64_t{j} + 1) * source - 2 * reach - result, 2 * result) + 1;
}

int Axis::first(int j) const { return static_cast<int>(std::clamp<std::int64_t>(uncut_first(j), 0, source_ - taps_)); }

bool Axis::cut(int j) const {
  const std::int64_t at = uncut_first(j);
  return at < 0 || at > source_ - taps_;
}

/// The filter's value at a source pixel, which may lie outside the source.
double Axis::kernel(std::int64_t pixel, int j) const {
  const std::int64_t source = source_;
  const std::int64_t result = result_;
  if (filter_ == ResizeFilter::Area) {
    const std::int64_t low = std::max(pixel * result, j * source);
    const std::int64_t high = std::min((pixel + 1) * result, (std::int64_t{j} + 1) * source);
    return static_cast<double>(std::max<std::int64_t>(high - low, 0));
  }
  // Distance of the centres = numerator / denominator, in pixels of the coarser grid.
  const std::int64_t numerator = std::abs((2 * pixel + 1) * result - (2 * std::int64_t{j} + 1) * source);
  const std::int64_t denominator = 2 * std::max(source, result);
  if (numerator == 0) return 1;
  if (numerator >= support(filter_) * denominator) return 0;
  const double x = static_cast<double>(numerator) / static_cast<double>(denominator);
  if (filter_ == ResizeFilter::Bilinear) return 1 - x;
  if (numerator % denominator == 0) return 0;
  return filter_ == ResizeFilter::Bicubic ? catmull_rom(x) : lanczos3(x);
}

void Axis::weights(int j, float* out) const {
  if (taps_ == 1) {
    out[0] = 1;
    return;
  }
  // Weights of pixels outside go to the pixel at the end: the source goes on as that pixel.
  std::vector<double> exact(static_cast<std::size_t>(taps_), 0.0);
  const std::int64_t from = uncut_first(j);
  const int window = first(j);
  const std::int64_t length = std::max<std::int64_t>(
      taps_, filter_ == ResizeFilter::Area
                 ? taps_
                 : 2 * support(filter_) * std::max<std::int64_t>(1, (source_ + result_ - 1) / result_));
  double sum = 0;
  for (std::int64_t k = from; k < from + length; ++k) {
    const double weight = kernel(k, j);
    const std::int64_t inside = std::clamp<std::int64_t>(k, 0, source_ - 1) - window;
    if (weight == 0) continue;
    exact[static_cast<std::size_t>(inside)] += weight;
    sum += weight;
  }
  double rest = 1;
  int largest = 0;
  for (int t = 0; t < taps_; ++t) {
    out[t] = static_cast<float>(exact[static_cast<std::size_t>(t)] / sum);
    rest -= static_cast<double>(out[t]);
    if (out[t] > out[largest]) largest = t;
  }
  out[largest] = static_cast<float>(static_cast<double>(out[largest]) + rest);
}

TapTable::TapTable(const Axis& axis, int begin_pixel, int end_pixel, bool want_by_tap)
    : begin(begin_pixel), end(end_pixel), taps(axis.taps()) {
  const auto count = static_cast<std::size_t>(end - begin);
  const auto window = static_cast<std::size_t>(taps);
  first.resize(count + kPadding);
  weights.resize(count * window + kPadding);
  for (int j = begin; j < end; ++j) {
    const auto at = static_cast<std::size_t>(j - begin);
    first[at] = axis.first(j);
    const int before = j - axis.period();
    if (before >= begin && !axis.cut(before) && !axis.cut(j)) {
      std::copy_n(weights_of(before), taps, weights.data() + at * window);
    } else {
      axis.weights(j, weights.data() + at * window);
    }
  }
  std::fill_n(first.begin() + static_cast<std::ptrdiff_t>(count), kPadding, first[count - 1]);
  if (!want_by_tap) return;
  stride = static_cast<std::ptrdiff_t>(count + kPadding);
  by_tap.resize(window * (count + kPadding));
  for (std::size_t j = 0; j < count; ++j) {
    for (std::size_t t = 0; t < window; ++t) by_tap[t * static_cast<std::size_t>(stride) + j] = weights[j * window + t];
  }
}

}  // namespace azulejo
