#include "azulejo/imaging/block_convolution.h"

#include <algorithm>

namespace azulejo {
namespace {

Run one_thread() {
  Run run;
  run.threads = 1;
  return run;
}

}  // namespace

BlockConvolution::BlockConvolution(const NumberGrid& kernel, float sum)
    : rows_(kernel.rows),
      columns_(kernel.columns),
      sum_(sum),
      kernel_(FourierPlan::fast_size(kBlock + kernel.columns - 1), FourierPlan::fast_size(kBlock + kernel.rows - 1)) {
  const float scale = 1.0F / (static_cast<float>(kernel_.width) * static_cast<float>(kernel_.height));
  const Run run = one_thread();
  fourier_rows(kernel_, run, [&](int y, float* row) {
    std::fill_n(row, kernel_.width, 0.0F);
    if (y >= kernel.rows) return;
    for (int c = 0; c < kernel.columns; ++c) row[c] = kernel(y, c) * scale;
  });
  fourier_columns(kernel_, run);
}

Rect BlockConvolution::blocks(const Rect& part, const Rect& image) {
  const auto down = [](int value) { return value / kBlock * kBlock; };
  const int x = down(part.x);
  const int y = down(part.y);
  const int right = std::min(down(part.right() + kBlock - 1), image.right());
  const int bottom = std::min(down(part.bottom() + kBlock - 1), image.bottom());
  return {x, y, right - x, bottom - y};
}

void BlockConvolution::run(const float* source, std::ptrdiff_t source_stride, int width, int height, int step,
                           float* results, std::ptrdiff_t stride) const {
  const Run run = one_thread();
  const float first = source[0];
  HalfSpectrum spectrum(kernel_.width, kernel_.height);
  const int read_width = width + columns_ - 1;
  const int read_height = height + rows_ - 1;
  fourier_rows(spectrum, run, [&](int y, float* row) {
    std::fill_n(row, kernel_.width, 0.0F);
    if (y >= read_height) return;
    const float* const from = source + y * source_stride;
    for (int x = 0; x < read_width; ++x) row[x] = from[std::ptrdiff_t{x} * step] - first;
  });
  fourier_columns(spectrum, run, [&](int v, int u, float* re, float* im) {
    const std::size_t at = static_cast<std::size_t>(v) * kernel_.stride + static_cast<std::size_t>(u);
    for (std::size_t l = 0; l < FourierPlan::kLanes; ++l) {
      // Times the conjugate: a correlation.
      const float a = kernel_.re[at + l];
      const float b = kernel_.im[at + l];
      const float product = re[l] * a + im[l] * b;
      im[l] = im[l] * a - re[l] * b;
      re[l] = product;
    }
  });
  const float kept = first * sum_;
  inverse_fourier_rows(spectrum, run, height, [&](int y, const float* row) {
    float* const to = results + y * stride;
    for (int x = 0; x < width; ++x) to[std::ptrdiff_t{x} * step] = row[x] + kept;
  });
}

}  // namespace azulejo
