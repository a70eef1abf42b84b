#include "azulejo/imaging/sobel.h"

#include <opencv2/imgproc.hpp>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

const Rows kRows([](Bench& bench) {
  for (const Size size : {kFullHd, k24Megapixels}) {
    const ImageInfo info = photo(PixelType::U8, 1, size);
    const auto x = std::make_shared<cv::Mat>();
    const auto y = std::make_shared<cv::Mat>();
    bench.image_row({.name = "sobel magnitude",
                     .source = info,
                     .result = {info.width, info.height, 1, PixelType::F32, ColorState::Data},
                     .ours = [](const ConstAnyView& source, const AnyView& result,
                                const Run& run) { sobel(source, SobelViews{.magnitude = result}, {}, run); },
                     .peer =
                         [x, y](const ConstAnyView& source, const AnyView& result) {
                           cv::Sobel(mat(source), *x, CV_32F, 1, 0, 3, 1.0 / 255, 0, cv::BORDER_REFLECT_101);
                           cv::Sobel(mat(source), *y, CV_32F, 0, 1, 3, 1.0 / 255, 0, cv::BORDER_REFLECT_101);
                           cv::magnitude(*x, *y, mat(result));
                         },
                     .tolerance = 2e-6});
  }
});

}  // namespace
}  // namespace azulejo::bench
