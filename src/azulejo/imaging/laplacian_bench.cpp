#include "azulejo/imaging/laplacian.h"

#include <opencv2/imgproc.hpp>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

void add(Bench& bench, PixelType type, Size size) {
  ImageInfo result = photo(type, 1, size);
  result.type = PixelType::F32;
  result.color = ColorState::Data;
  bench.image_row(
      {.name = "laplacian",
       .source = photo(type, 1, size),
       .result = result,
       .ours = [](const ConstAnyView& source, const AnyView& to, const Run& run) { laplacian(source, to, {}, run); },
       .peer =
           [](const ConstAnyView& source, const AnyView& to) {
             cv::Laplacian(mat(source), mat(to), CV_32F, 1, 1 / static_cast<double>(full_range(source.info.type)), 0,
                           cv::BORDER_REFLECT_101);
           },
       .tolerance = 1e-5});
}

const Rows kRows([](Bench& bench) {
  add(bench, PixelType::U8, kFullHd);
  add(bench, PixelType::U8, k24Megapixels);
  add(bench, PixelType::F32, kFullHd);
});

}  // namespace
}  // namespace azulejo::bench
