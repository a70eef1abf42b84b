#include "azulejo/imaging/brightness_contrast.h"

#include <opencv2/core.hpp>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

constexpr BrightnessContrastOptions kOptions{.brightness = 0.1F, .contrast = 1.5F};

void add(Bench& bench, PixelType type, int channels, Size size, double tolerance) {
  const double offset = (0.5 - 0.5 * 1.5 + 0.1) * static_cast<double>(full_range(type));
  bench.image_row({.name = "brightness_contrast",
                   .source = photo(type, channels, size),
                   .ours = [](const ConstAnyView& source, const AnyView& result,
                              const Run& run) { brightness_contrast(source, result, kOptions, run); },
                   .peer =
                       [offset](const ConstAnyView& source, const AnyView& result) {
                         cv::Mat to = mat(result);
                         mat(source).convertTo(to, -1, 1.5, offset);
                       },
                   .tolerance = tolerance});
}

const Rows kRows([](Bench& bench) {
  add(bench, PixelType::U8, 1, kFullHd, 1);  // halves are rounded up here, to even there
  add(bench, PixelType::U8, 1, k24Megapixels, 1);
  add(bench, PixelType::U8, 3, kFullHd, 1);
  add(bench, PixelType::U16, 1, kFullHd, 1);
  add(bench, PixelType::F32, 1, kFullHd, 1e-6);
});

}  // namespace
}  // namespace azulejo::bench
