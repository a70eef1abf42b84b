#include "azulejo/imaging/invert.h"

#include <opencv2/core.hpp>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

void add(Bench& bench, PixelType type, int channels, Size size) {
  const bool real = type == PixelType::F32;
  bench.image_row({.name = "invert",
                   .source = photo(type, channels, size),
                   .ours = [](const ConstAnyView& source, const AnyView& result,
                              const Run& run) { invert(source, result, {}, run); },
                   .peer =
                       [real](const ConstAnyView& source, const AnyView& result) {
                         if (real) return cv::subtract(cv::Scalar::all(1), mat(source), mat(result));
                         cv::bitwise_not(mat(source), mat(result));
                       },
                   .aim = 0.9});
}

const Rows kRows([](Bench& bench) {
  add(bench, PixelType::U8, 1, kFullHd);
  add(bench, PixelType::U8, 1, k24Megapixels);
  add(bench, PixelType::U16, 1, kFullHd);
  add(bench, PixelType::F32, 1, kFullHd);
});

}  // namespace
}  // namespace azulejo::bench
