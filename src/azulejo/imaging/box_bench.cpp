#include "azulejo/imaging/box.h"

#include <opencv2/imgproc.hpp>
#include <string>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

void add(Bench& bench, int radius, PixelType type, Size size, int channels = 1) {
  bench.image_row({.name = "box radius=" + std::to_string(radius),
                   .source = photo(type, channels, size),
                   .ours = [radius](const ConstAnyView& source, const AnyView& result,
                                    const Run& run) { box(source, result, {.radius = radius}, run); },
                   .peer =
                       [radius](const ConstAnyView& source, const AnyView& result) {
                         const int side = 2 * radius + 1;
                         cv::blur(mat(source), mat(result), {side, side}, {-1, -1}, cv::BORDER_REFLECT_101);
                       },
                   .tolerance = type == PixelType::F32 ? 2e-6 : 1,
                   .aim = 2.5});
}

const Rows kRows([](Bench& bench) {
  for (const Size size : {kFullHd, k24Megapixels}) {
    for (const int radius : {1, 15}) add(bench, radius, PixelType::U8, size);
  }
  add(bench, 60, PixelType::U8, k24Megapixels);
  add(bench, 1, PixelType::U8, kFullHd, 3);
  add(bench, 15, PixelType::U8, kFullHd, 3);
  for (const PixelType type : {PixelType::U16, PixelType::F32}) {
    for (const int radius : {1, 15}) add(bench, radius, type, kFullHd);
  }
  add(bench, 15, PixelType::F32, k24Megapixels);
});

}  // namespace
}  // namespace azulejo::bench
