#include "azulejo/imaging/crop.h"

#include <opencv2/core.hpp>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

void add(Bench& bench, int channels) {
  ImageInfo result = photo(PixelType::U8, channels, kFullHd);
  result.width = 1600;
  result.height = 900;
  bench.image_row({.name = "crop 1600×900",
                   .source = photo(PixelType::U8, channels, kFullHd),
                   .result = result,
                   .ours =
                       [](const ConstAnyView& source, const AnyView& to, const Run& run) {
                         crop(source, to, {.rect = {{101, 50, 1600, 900}}}, run);
                       },
                   .peer = [](const ConstAnyView& source,
                              const AnyView& to) { mat(source)(cv::Rect(101, 50, 1600, 900)).copyTo(mat(to)); },
                   .aim = 0.9});
}

const Rows kRows([](Bench& bench) {
  add(bench, 1);
  add(bench, 3);
});

}  // namespace
}  // namespace azulejo::bench
