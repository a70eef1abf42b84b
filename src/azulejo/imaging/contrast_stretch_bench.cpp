#include "azulejo/imaging/contrast_stretch.h"

#include <opencv2/imgproc.hpp>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

/// What one writes with the peer: a histogram, its percentiles, a table.
void stretch_by_opencv(const ConstAnyView& source, const AnyView& result) {
  const cv::Mat from = mat(source);
  cv::Mat histogram;
  const int channel = 0;
  const int bins = 256;
  const float range[] = {0, 256};
  const float* ranges[] = {range};
  cv::calcHist(&from, 1, &channel, cv::Mat(), histogram, 1, &bins, ranges);
  const double all = static_cast<double>(from.total());
  int black = 0;
  int white = 255;
  for (double up_to = histogram.at<float>(0); up_to <= 0.01 * all; ++black) up_to += histogram.at<float>(black + 1);
  for (double down_to = histogram.at<float>(255); down_to <= 0.01 * all; --white) {
    down_to += histogram.at<float>(white - 1);
  }
  cv::Mat table(1, 256, CV_8U);
  for (int v = 0; v < 256; ++v)
    table.at<std::uint8_t>(v) = cv::saturate_cast<std::uint8_t>((v - black) * 255.0 / (white - black));
  cv::LUT(from, table, mat(result));
}

void add(Bench& bench, Size size) {
  bench.image_row({.name = "contrast_stretch",
                   .source = photo(PixelType::U8, 1, size),
                   .ours = [](const ConstAnyView& source, const AnyView& result,
                              const Run& run) { contrast_stretch(source, result, {}, run); },
                   .peer = stretch_by_opencv,
                   .tolerance = 1});
}

const Rows kRows([](Bench& bench) {
  add(bench, kFullHd);
  add(bench, k24Megapixels);
});

}  // namespace
}  // namespace azulejo::bench
