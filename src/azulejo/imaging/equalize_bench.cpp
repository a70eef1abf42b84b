#include "azulejo/imaging/equalize.h"

#include <opencv2/imgproc.hpp>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

void add(Bench& bench, Size size) {
  bench.image_row(
      {.name = "equalize",
       .source = photo(PixelType::U8, 1, size),
       .ours = [](const ConstAnyView& source, const AnyView& result,
                  const Run& run) { equalize(source, result, {}, run); },
       .peer = [](const ConstAnyView& source, const AnyView& result) { cv::equalizeHist(mat(source), mat(result)); },
       .tolerance = 1,  // the peer rounds a float quotient
       .aim = 1.5});
}

const Rows kRows([](Bench& bench) {
  add(bench, kFullHd);
  add(bench, k24Megapixels);
});

}  // namespace
}  // namespace azulejo::bench
