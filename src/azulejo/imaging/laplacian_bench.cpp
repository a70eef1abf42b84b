#include "azulejo/imaging/laplacian.h"

#include <opencv2/imgproc.hpp>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

void add(Bench& bench, PixelType type, Size size) {
  ImageInfo result = photo(PixelType::F32, 1, size);
  result.color = ColorState::Data;
  const double scale = 1 / static_cast<double>(full_range(type));
  bench.image_row(
      {.name = "laplacian",
       .source = photo(type, 1, size),
       .result = result,
       .ours = [](const ConstAnyView& from, const AnyView& to, const Run& run) { laplacian(from, to, {}, run); },
       .peer =
           [scale](const ConstAnyView& from, const AnyView& to) {
             cv::Laplacian(mat(from), mat(to), CV_32F, 1, scale, 0, cv::BORDER_REFLECT_101);
           },
       .tolerance = 2e-6,
       .aim = 2.5});
}

const Rows kRows([](Bench& bench) {
  for (const Size size : {kFullHd, k24Megapixels}) {
    for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) add(bench, type, size);
  }
});

}  // namespace
}  // namespace azulejo::bench
