#include "azulejo/imaging/bilateral.h"

#include <opencv2/imgproc.hpp>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

void add(Bench& bench, PixelType type, int channels, Size size) {
  bench.image_row({.name = "bilateral radius=4",
                   .source = photo(type, channels, size),
                   .ours =
                       [](const ConstAnyView& source, const AnyView& result, const Run& run) {
                         bilateral(source, result, {.sigma_space = 3, .sigma_range = 0.1F, .radius = 4}, run);
                       },
                   .peer =
                       [](const ConstAnyView& source, const AnyView& result) {
                         const double full = source.info.type == PixelType::F32 ? 1 : 255;
                         cv::Mat to = mat(result);
                         cv::bilateralFilter(mat(source), to, 9, 0.1 * full, 3, cv::BORDER_REFLECT_101);
                       },
                   // The peer adds up the differences of the channels: no result to compare with.
                   .tolerance = channels > 1             ? 255
                                : type == PixelType::F32 ? 2e-4
                                                         : 1,
                   .aim = 2.5});
}

const Rows kRows([](Bench& bench) {
  add(bench, PixelType::U8, 1, kFullHd);
  add(bench, PixelType::U8, 3, kFullHd);
  add(bench, PixelType::F32, 1, kFullHd);
  add(bench, PixelType::U8, 1, k24Megapixels);
});

}  // namespace
}  // namespace azulejo::bench
