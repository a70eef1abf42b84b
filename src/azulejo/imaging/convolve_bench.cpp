#include "azulejo/imaging/convolve.h"

#include <opencv2/imgproc.hpp>
#include <string>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

/// A kernel that is no column times a row: a disk, a little lighter on one side.
NumberGrid disk(int side, bool whole, bool even = false) {
  NumberGrid kernel{side, side, {}};
  for (int r = 0; r < side; ++r) {
    for (int c = 0; c < side; ++c) {
      const int x = 2 * c - side + 1;
      const int y = 2 * r - side + 1;
      const int weight = 1 + (x * x + y * y < side * side ? 7 : 0) + (even ? x * x * y % 3 : (x + 2 * y) % 3);
      kernel.values.push_back(static_cast<float>(weight) * (whole ? 1.0F : 0.0051F));
    }
  }
  return kernel;
}

NumberGrid tent(int side) {
  NumberGrid kernel{side, side, {}};
  const auto weight = [&](int i) { return std::min(i + 1, side - i); };
  for (int r = 0; r < side; ++r) {
    for (int c = 0; c < side; ++c) kernel.values.push_back(static_cast<float>(weight(r) * weight(c)));
  }
  return kernel;
}

struct Kernel {
  std::string name;
  NumberGrid grid;
  bool separable = false;
  float scale = 1;
};

/// The peer correlates with the kernel, multiplied by the scale; a separable one by its factors.
void add(Bench& bench, const Kernel& kernel, PixelType type, int channels, Size size, double aim = 2.5) {
  const ConvolveOptions options{.kernel = kernel.grid, .correlate = true, .scale = kernel.scale};
  cv::Mat weights(kernel.grid.rows, kernel.grid.columns, CV_32F);
  std::copy(kernel.grid.values.begin(), kernel.grid.values.end(), weights.ptr<float>());
  weights *= kernel.scale;
  const int side = kernel.grid.rows;
  const float corner = weights.at<float>(side / 2, side / 2);
  const cv::Mat column = weights.col(side / 2).clone();
  const cv::Mat row = weights.row(side / 2) / corner;
  ImageInfo source = photo(type, channels, size);
  source.alpha = AlphaState::None;
  bench.image_row({.name = "convolve " + kernel.name,
                   .source = source,
                   .ours = [options](const ConstAnyView& from, const AnyView& to,
                                     const Run& run) { convolve(from, to, options, run); },
                   .peer =
                       [=](const ConstAnyView& from, const AnyView& to) {
                         cv::Mat result = mat(to);
                         if (kernel.separable) {
                           cv::sepFilter2D(mat(from), result, -1, row, column, {-1, -1}, 0, cv::BORDER_REFLECT_101);
                         } else {
                           cv::filter2D(mat(from), result, -1, weights, {-1, -1}, 0, cv::BORDER_REFLECT_101);
                         }
                       },
                   .tolerance = type == PixelType::F32 ? 1e-4 : 1,
                   .aim = aim});
}

const Rows kRows([](Bench& bench) {
  const Kernel any{"5×5", disk(5, false)};
  const Kernel symmetric{"5×5 symmetric", disk(5, false, true)};
  const Kernel whole{"5×5 whole", disk(5, true), false, 1.0F / 200};
  NumberGrid normal = disk(5, true, true);
  float sum = 0;
  for (const float weight : normal.values) sum += weight;
  const Kernel average{"5×5 average", normal, false, 1 / sum};
  for (const Size size : {kFullHd, k24Megapixels}) {
    add(bench, any, PixelType::F32, 1, size);
    add(bench, any, PixelType::U8, 1, size);
  }
  add(bench, symmetric, PixelType::F32, 1, kFullHd);
  add(bench, average, PixelType::F32, 1, kFullHd);
  add(bench, whole, PixelType::U8, 1, kFullHd);
  add(bench, any, PixelType::U16, 1, kFullHd);
  add(bench, any, PixelType::U8, 3, kFullHd);
  for (const int side : {3, 9, 15, 31}) {
    add(bench,
        {std::to_string(side) + "×" + std::to_string(side), disk(side, false), false,
         0.25F / static_cast<float>(side * side)},
        PixelType::U8, 1, kFullHd);
  }
  for (const int side : {31, 35, 63}) {
    const float scale = 0.25F / static_cast<float>(side * side);
    const std::string name = std::to_string(side) + "×" + std::to_string(side);
    add(bench, {name, disk(side, false), false, scale}, PixelType::F32, 1, kFullHd);
    if (side > 31) add(bench, {name, disk(side, false), false, scale}, PixelType::U8, 1, kFullHd);
  }
  add(bench, {"3×3 separable", tent(3), true, 1.0F / 16}, PixelType::U8, 1, kFullHd);
  add(bench, {"5×5 separable", tent(5), true, 1.0F / 81}, PixelType::U8, 1, kFullHd);
  add(bench, {"15×15 separable", tent(15), true, 1.0F / 4096}, PixelType::U8, 1, kFullHd);
  add(bench, {"15×15 separable", tent(15), true, 1.0F / 4096}, PixelType::F32, 1, kFullHd);
});

}  // namespace
}  // namespace azulejo::bench
