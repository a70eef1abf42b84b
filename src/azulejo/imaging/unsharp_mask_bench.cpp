#include "azulejo/imaging/unsharp_mask.h"

#include <opencv2/imgproc.hpp>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

/// The peer smooths into the image's type and weighs that: its mask is rounded to levels.
void add(Bench& bench, PixelType type, int channels, Size size) {
  const auto held = std::make_shared<cv::Mat>();
  bench.image_row({.name = "unsharp_mask sigma=1.5",
                   .source = photo(type, channels, size),
                   .ours = [](const ConstAnyView& source, const AnyView& result,
                              const Run& run) { unsharp_mask(source, result, {.sigma = 1.5F}, run); },
                   .peer =
                       [held](const ConstAnyView& source, const AnyView& result) {
                         cv::GaussianBlur(mat(source), *held, {13, 13}, 1.5, 1.5, cv::BORDER_REFLECT_101);
                         cv::addWeighted(mat(source), 2, *held, -1, 0, mat(result));
                       },
                   .tolerance = type == PixelType::F32 ? 1e-4 : 1.0});
}

const Rows kRows([](Bench& bench) {
  add(bench, PixelType::U8, 1, kFullHd);
  add(bench, PixelType::U8, 1, k24Megapixels);
  add(bench, PixelType::U8, 3, k24Megapixels);
  add(bench, PixelType::U16, 1, kFullHd);
  add(bench, PixelType::F32, 1, kFullHd);
});

}  // namespace
}  // namespace azulejo::bench
