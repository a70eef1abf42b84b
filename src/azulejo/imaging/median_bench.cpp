#include "azulejo/imaging/median.h"

#include <opencv2/imgproc.hpp>
#include <string>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

void add(Bench& bench, int radius, PixelType type, Size size, double aim, int channels = 1) {
  ImageRow row{.name = "median radius=" + std::to_string(radius),
               .source = photo(type, channels, size),
               .ours = [radius](const ConstAnyView& source, const AnyView& result,
                                const Run& run) { median(source, result, {.radius = radius}, run); },
               .tolerance = 0,
               .margin = radius,  // the peer repeats the outermost pixels
               .aim = aim};
  // The peer takes windows of more than 5 × 5 pixels of bytes only.
  if (type == PixelType::U8 || radius <= 2) {
    row.peer = [radius](const ConstAnyView& source, const AnyView& result) {
      cv::Mat to = mat(result);
      cv::medianBlur(mat(source), to, 2 * radius + 1);
    };
  }
  bench.image_row(std::move(row));
}

const Rows kRows([](Bench& bench) {
  for (const Size size : {kFullHd, k24Megapixels}) {
    for (const int radius : {1, 2, 15}) add(bench, radius, PixelType::U8, size, 2.5);
  }
  for (const int radius : {3, 4, 5, 50, 120}) add(bench, radius, PixelType::U8, kFullHd, 2.5);
  add(bench, 2, PixelType::U8, kFullHd, 2.5, 3);
  add(bench, 15, PixelType::U8, kFullHd, 2.5, 3);
  for (const PixelType type : {PixelType::U16, PixelType::F32}) {
    for (const int radius : {1, 2, 4, 5, 15, 50}) add(bench, radius, type, kFullHd, 2.5);
  }
});

}  // namespace
}  // namespace azulejo::bench
