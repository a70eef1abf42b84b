#include "azulejo/imaging/clahe.h"

#include <opencv2/imgproc.hpp>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

void add(Bench& bench, PixelType type, Size size, double tolerance) {
  bench.image_row(
      {.name = "clahe",
       .source = photo(type, 1, size),
       .ours = [](const ConstAnyView& source, const AnyView& result,
                  const Run& run) { clahe(source, result, {}, run); },
       .peer = [peer = cv::createCLAHE(2, {8, 8})](const ConstAnyView& source,
                                                   const AnyView& result) { peer->apply(mat(source), mat(result)); },
       .tolerance = tolerance,
       .aim = 2.5});
}

const Rows kRows([](Bench& bench) {
  // The peer gives the excess out once, which leaves bins above the limit, and rounds its tables to whole values.
  add(bench, PixelType::U8, kFullHd, 16);
  add(bench, PixelType::U8, k24Megapixels, 16);
  // Of 16 bits, its limit is a whole number of the few pixels that a bin of 65536 gets.
  add(bench, PixelType::U16, k24Megapixels, 16 * 257);
  bench.image_row({.name = "clahe",
                   .source = photo(PixelType::U8, 3, kFullHd),
                   .ours = [](const ConstAnyView& source, const AnyView& result,
                              const Run& run) { clahe(source, result, {}, run); },
                   .peer =
                       [peer = cv::createCLAHE(2, {8, 8})](const ConstAnyView& source, const AnyView& result) {
                         cv::Mat luma;
                         std::vector<cv::Mat> planes;
                         cv::cvtColor(mat(source), luma, cv::COLOR_RGB2YCrCb);
                         cv::split(luma, planes);
                         peer->apply(planes[0], planes[0]);
                         cv::merge(planes, luma);
                         cv::cvtColor(luma, mat(result), cv::COLOR_YCrCb2RGB);
                       },
                   .tolerance = 18,  // chroma is rounded, too
                   .aim = 2.5});
});

}  // namespace
}  // namespace azulejo::bench
