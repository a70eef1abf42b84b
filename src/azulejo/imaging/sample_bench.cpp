#include "azulejo/imaging/sample.h"

#include <opencv2/imgproc.hpp>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

void add(Bench& bench, PixelType type, int channels, Size size) {
  constexpr int kStep = 8;
  ImageInfo result = photo(type, channels, size);
  result.width /= kStep;
  result.height /= kStep;
  bench.image_row(
      {.name = "sample prefilter=box light=encoded",
       .source = photo(type, channels, size),
       .result = result,
       .ours =
           [](const ConstAnyView& source, const AnyView& samples, const Run& run) {
             sample(source, samples, {kStep, Prefilter::Box, false, Light::Encoded}, run);
           },
       .peer =
           [](const ConstAnyView& source, const AnyView& samples) {
             cv::resize(mat(source), mat(samples), {samples.width(), samples.height()}, 0, 0, cv::INTER_AREA);
           },
       .tolerance = 1});
}

const Rows kRows([](Bench& bench) {
  add(bench, PixelType::U8, 1, kFullHd);
  add(bench, PixelType::U8, 1, {6000, 4000});
  add(bench, PixelType::U8, 3, kFullHd);
  add(bench, PixelType::F32, 1, kFullHd);
});

}  // namespace
}  // namespace azulejo::bench
