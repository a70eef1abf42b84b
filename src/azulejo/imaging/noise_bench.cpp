#include "azulejo/imaging/noise.h"

#include <opencv2/imgproc.hpp>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

/// The noise is another one: results are not compared. The generator of the peer has 64 bits of state and numbers that
/// depend on their order.
void add(Bench& bench, PixelType type, int channels, Size size) {
  bench.image_row({.name = "noise",
                   .source = photo(type, channels, size),
                   .ours = [](const ConstAnyView& source, const AnyView& result,
                              const Run& run) { noise(source, result, {}, run); },
                   .peer =
                       [](const ConstAnyView& source, const AnyView& result) {
                         const double top = full_range(source.info.type);
                         cv::Mat added(source.height(), source.width(), CV_32FC(source.info.channels));
                         cv::randn(added, 0, 0.05 * top);
                         cv::add(mat(source), added, mat(result), cv::noArray(), mat(source).depth());
                       },
                   .tolerance = 1e9,
                   .aim = 1.5});
}

const Rows kRows([](Bench& bench) {
  add(bench, PixelType::U8, 1, kFullHd);
  add(bench, PixelType::U8, 1, k24Megapixels);
  add(bench, PixelType::U8, 3, kFullHd);
  add(bench, PixelType::F32, 1, kFullHd);
});

}  // namespace
}  // namespace azulejo::bench
