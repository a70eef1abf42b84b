#include "azulejo/imaging/grayscale.h"

#include <opencv2/imgproc.hpp>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

void add(Bench& bench, PixelType type, Size size, double tolerance, double aim) {
  bench.image_row({.name = "grayscale",
                   .source = photo(type, 3, size),
                   .result = photo(type, 1, size),
                   .ours = [](const ConstAnyView& source, const AnyView& result,
                              const Run& run) { grayscale(source, result, {}, run); },
                   .peer = [](const ConstAnyView& source,
                              const AnyView& result) { cv::cvtColor(mat(source), mat(result), cv::COLOR_RGB2GRAY); },
                   .tolerance = tolerance,
                   .aim = aim});
}

const Rows kRows([](Bench& bench) {
  add(bench, PixelType::U8, kFullHd, 1, 1.5);  // the peer's weights have 15 bits
  add(bench, PixelType::U8, k24Megapixels, 1, 1.5);
  add(bench, PixelType::U16, kFullHd, 1, 1);
  add(bench, PixelType::F32, kFullHd, 1e-6, 1);
});

}  // namespace
}  // namespace azulejo::bench
