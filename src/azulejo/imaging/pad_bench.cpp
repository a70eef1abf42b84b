#include "azulejo/imaging/pad.h"

#include <opencv2/core.hpp>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

void add(Bench& bench, int channels) {
  ImageInfo result = photo(PixelType::U8, channels, kFullHd);
  result.width += 64;
  result.height += 64;
  bench.image_row({.name = "pad by 32, mirror",
                   .source = photo(PixelType::U8, channels, kFullHd),
                   .result = result,
                   .ours =
                       [](const ConstAnyView& source, const AnyView& to, const Run& run) {
                         const PadOptions options{
                             .left = 32, .right = 32, .top = 32, .bottom = 32, .border = Border::Mirror};
                         pad(source, to, options, run);
                       },
                   .peer =
                       [](const ConstAnyView& source, const AnyView& to) {
                         cv::copyMakeBorder(mat(source), mat(to), 32, 32, 32, 32, cv::BORDER_REFLECT_101);
                       },
                   .aim = 0.9});
}

const Rows kRows([](Bench& bench) {
  add(bench, 1);
  add(bench, 3);
});

}  // namespace
}  // namespace azulejo::bench
