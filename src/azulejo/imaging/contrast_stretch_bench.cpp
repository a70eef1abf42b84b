#include "azulejo/imaging/contrast_stretch.h"

#include <opencv2/core.hpp>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

/// From the smallest to the largest value, which the peer can do.
constexpr ContrastStretchOptions kOptions{.low = 0, .high = 100};

void add(Bench& bench, PixelType type, int channels, Size size) {
  bench.image_row({.name = "contrast_stretch low=0 high=100",
                   .source = photo(type, channels, size),
                   .ours = [](const ConstAnyView& source, const AnyView& result,
                              const Run& run) { contrast_stretch(source, result, kOptions, run); },
                   .peer =
                       [](const ConstAnyView& source, const AnyView& result) {
                         cv::normalize(mat(source), mat(result), static_cast<double>(full_range(result.info.type)), 0,
                                       cv::NORM_MINMAX);
                       },
                   .tolerance = 1,
                   .aim = 0.9});
}

const Rows kRows([](Bench& bench) {
  add(bench, PixelType::U8, 1, kFullHd);
  add(bench, PixelType::U8, 1, k24Megapixels);
});

}  // namespace
}  // namespace azulejo::bench
