#include "azulejo/imaging/weighted_median.h"

#include <opencv2/imgproc.hpp>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

/// Weights of 1 in a square: the only ones that the peer has.
const NumberGrid kSquare = {5, 5, std::vector<float>(25, 1.0F)};

void add(Bench& bench, PixelType type, Size size) {
  bench.image_row({.name = "weighted_median",
                   .source = photo(type, 1, size),
                   .ours = [](const ConstAnyView& source, const AnyView& result, const Run& run) {
                     weighted_median(source, result, {}, run);
                   }});
}

const Rows kRows([](Bench& bench) {
  add(bench, PixelType::U8, kFullHd);
  add(bench, PixelType::U16, kFullHd);
  add(bench, PixelType::F32, kFullHd);
  bench.image_row({.name = "weighted_median of ones, 5 × 5",
                   .source = photo(PixelType::U8, 1, kFullHd),
                   .ours = [](const ConstAnyView& source, const AnyView& result,
                              const Run& run) { weighted_median(source, result, {.weights = kSquare}, run); },
                   .peer =
                       [](const ConstAnyView& source, const AnyView& result) {
                         cv::Mat to = mat(result);
                         cv::medianBlur(mat(source), to, 5);
                       },
                   .margin = 2,
                   .aim = 1});
});

}  // namespace
}  // namespace azulejo::bench
