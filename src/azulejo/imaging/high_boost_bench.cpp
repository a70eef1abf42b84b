#include "azulejo/imaging/high_boost.h"

#include <opencv2/imgproc.hpp>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

void add(Bench& bench, PixelType type) {
  const auto held = std::make_shared<cv::Mat>();
  bench.image_row({.name = "high_boost boost=1.5, sigma=1.5",
                   .source = photo(type, 1, kFullHd),
                   .ours = [](const ConstAnyView& source, const AnyView& result,
                              const Run& run) { high_boost(source, result, {.boost = 1.5F, .sigma = 1.5F}, run); },
                   .peer =
                       [held](const ConstAnyView& source, const AnyView& result) {
                         cv::GaussianBlur(mat(source), *held, {13, 13}, 1.5, 1.5, cv::BORDER_REFLECT_101);
                         cv::addWeighted(mat(source), 1.5, *held, -1, 0, mat(result));
                       },
                   .tolerance = type == PixelType::F32 ? 1e-4 : 1.0});
}

const Rows kRows([](Bench& bench) {
  add(bench, PixelType::U8);
  add(bench, PixelType::F32);
});

}  // namespace
}  // namespace azulejo::bench
