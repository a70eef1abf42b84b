#include "azulejo/imaging/quantize.h"

#include <opencv2/imgproc.hpp>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

/// The peer has no dithering. Of two levels, its comparison with an image of thresholds does the same.
void add(Bench& bench, Dither dither, const char* name, PixelType type, Size size) {
  ImageRow row{.name = std::string("quantize dither=") + name,
               .source = photo(type, 1, size),
               .ours = [dither](const ConstAnyView& source, const AnyView& result,
                                const Run& run) { quantize(source, result, {.levels = 2, .dither = dither}, run); },
               .aim = 2};
  if (dither == Dither::None) {
    const auto table = std::make_shared<cv::Mat>(1, 256, CV_8U);
    for (int v = 0; v < 256; ++v) table->at<std::uint8_t>(v) = v < 128 ? 0 : 255;
    row.peer = [table](const ConstAnyView& source, const AnyView& result) {
      cv::LUT(mat(source), *table, mat(result));
    };
    row.peer_name = "OpenCV's table";
  } else if (dither == Dither::Ordered) {
    const auto thresholds = std::make_shared<cv::Mat>();
    row.peer = [thresholds](const ConstAnyView& source, const AnyView& result) {
      if (thresholds->empty()) {
        // Up from (rank + ½) / 64 of 255 on.
        const int matrix[8][8] = {{0, 32, 8, 40, 2, 34, 10, 42},  {48, 16, 56, 24, 50, 18, 58, 26},
                                  {12, 44, 4, 36, 14, 46, 6, 38}, {60, 28, 52, 20, 62, 30, 54, 22},
                                  {3, 35, 11, 43, 1, 33, 9, 41},  {51, 19, 59, 27, 49, 17, 57, 25},
                                  {15, 47, 7, 39, 13, 45, 5, 37}, {63, 31, 55, 23, 61, 29, 53, 21}};
        thresholds->create(source.height(), source.width(), CV_8U);
        for (int y = 0; y < source.height(); ++y) {
          for (int x = 0; x < source.width(); ++x) {
            thresholds->at<std::uint8_t>(y, x) =
                static_cast<std::uint8_t>(std::ceil((matrix[y % 8][x % 8] + 0.5) / 64 * 255));
          }
        }
      }
      cv::compare(mat(source), *thresholds, mat(result), cv::CMP_GE);
    };
    row.peer_name = "OpenCV's parts";
    row.aim = 0.5;  // its thresholds are there already
  }
  bench.image_row(std::move(row));
}

const Rows kRows([](Bench& bench) {
  add(bench, Dither::None, "none", PixelType::U8, kFullHd);
  add(bench, Dither::Ordered, "ordered", PixelType::U8, kFullHd);
  add(bench, Dither::BlueNoise, "blue_noise", PixelType::U8, kFullHd);
  add(bench, Dither::FloydSteinberg, "floyd_steinberg", PixelType::U8, kFullHd);
});

}  // namespace
}  // namespace azulejo::bench
