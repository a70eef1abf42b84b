#include "azulejo/imaging/gaussian.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

void add(Bench& bench, float sigma, PixelType type, Size size, double aim) {
  const int side = 2 * static_cast<int>(std::ceil(4 * sigma)) + 1;
  bench.image_row({.name = "gaussian sigma=" + std::to_string(static_cast<int>(sigma)),
                   .source = photo(type, 1, size),
                   .ours = [sigma](const ConstAnyView& source, const AnyView& result,
                                   const Run& run) { gaussian(source, result, {.sigma = sigma}, run); },
                   .peer =
                       [sigma, side](const ConstAnyView& source, const AnyView& result) {
                         cv::GaussianBlur(mat(source), mat(result), {side, side}, sigma, sigma, cv::BORDER_REFLECT_101);
                       },
                   // The peer calculates bytes with weights of 8 bits.
                   .tolerance = type == PixelType::F32 ? 2e-6 : 2,
                   .aim = aim});
}

const Rows kRows([](Bench& bench) {
  for (const Size size : {kFullHd, k24Megapixels}) {
    add(bench, 1, PixelType::U8, size, 2);
    add(bench, 5, PixelType::U8, size, 3);
    add(bench, 5, PixelType::F32, size, 3);
  }
  add(bench, 5, PixelType::U16, kFullHd, 3);
  add(bench, 50, PixelType::U8, kFullHd, 2);  // beyond what is computed tile by tile
});

}  // namespace
}  // namespace azulejo::bench
