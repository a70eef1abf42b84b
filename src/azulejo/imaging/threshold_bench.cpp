#include "azulejo/imaging/threshold.h"

#include <opencv2/imgproc.hpp>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

void add(Bench& bench, PixelType type, int channels) {
  // Ours marks v > ⌊0.5 · full range⌋ with full range; so does the peer with these two numbers.
  const double top = full_range(type);
  const double level = type == PixelType::F32 ? 0.5 : static_cast<double>(static_cast<int>(top * 0.5));
  bench.image_row({.name = "threshold",
                   .source = photo(type, channels, k24Megapixels),
                   .ours = [](const ConstAnyView& source, const AnyView& result,
                              const Run& run) { threshold(source, result, {}, run); },
                   .peer =
                       [level, top](const ConstAnyView& source, const AnyView& result) {
                         cv::threshold(mat(source), mat(result), level, top, cv::THRESH_BINARY);
                       },
                   .aim = 0.9});
}

const Rows kRows([](Bench& bench) {
  add(bench, PixelType::U8, 1);
  add(bench, PixelType::U16, 1);
  add(bench, PixelType::F32, 1);
  add(bench, PixelType::U8, 3);
});

}  // namespace
}  // namespace azulejo::bench
