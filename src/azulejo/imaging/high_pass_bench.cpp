#include "azulejo/imaging/high_pass.h"

#include <opencv2/imgproc.hpp>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

/// The peer's mask is that of bytes rounded to levels.
void add(Bench& bench, PixelType type) {
  const auto held = std::make_shared<cv::Mat>();
  ImageInfo result = photo(type, 1, kFullHd);
  result.type = PixelType::F32;
  result.color = ColorState::Data;
  bench.image_row({.name = "high_pass sigma=1.5",
                   .source = photo(type, 1, kFullHd),
                   .result = result,
                   .ours = [](const ConstAnyView& source, const AnyView& to,
                              const Run& run) { high_pass(source, to, {.sigma = 1.5F}, run); },
                   .peer =
                       [held](const ConstAnyView& source, const AnyView& to) {
                         cv::GaussianBlur(mat(source), *held, {13, 13}, 1.5, 1.5, cv::BORDER_REFLECT_101);
                         const double scale = 1 / static_cast<double>(full_range(source.info.type));
                         cv::addWeighted(mat(source), scale, *held, -scale, 0, mat(to), CV_32F);
                       },
                   .tolerance = type == PixelType::F32 ? 1e-4 : 1.0 / 255});
}

const Rows kRows([](Bench& bench) {
  add(bench, PixelType::U8);
  add(bench, PixelType::F32);
});

}  // namespace
}  // namespace azulejo::bench
