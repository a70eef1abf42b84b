#include "azulejo/imaging/match_histogram.h"

#include <opencv2/imgproc.hpp>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

/// The peer has histograms and tables, and no step that matches them.
void match_by_parts(const cv::Mat& source, const cv::Mat& reference, const cv::Mat& result) {
  const auto counts = [](const cv::Mat& image) {
    const int channel = 0;
    const int bins = 256;
    const float range[] = {0, 256};
    const float* ranges[] = {range};
    cv::Mat histogram;
    cv::calcHist(&image, 1, &channel, cv::Mat(), histogram, 1, &bins, ranges);
    return histogram;
  };
  const cv::Mat from = counts(source);
  const cv::Mat to = counts(reference);
  cv::Mat table(1, 256, CV_8U);
  double below = 0;
  double up_to = to.at<float>(0);
  int z = 0;
  for (int v = 0; v < 256; ++v) {
    while (z < 255 && up_to < below + from.at<float>(v) / 2) up_to += to.at<float>(++z);
    table.at<std::uint8_t>(v) = static_cast<std::uint8_t>(z);
    below += from.at<float>(v);
  }
  cv::LUT(source, table, result);
}

void add(Bench& bench, Size size) {
  const ImageInfo info = photo(PixelType::U8, 1, size);
  const auto reference = std::make_shared<std::shared_ptr<Image>>();
  const auto other = [reference, info] {
    if (!*reference) *reference = make_photo(info);
    return std::as_const(**reference).any();
  };
  bench.image_row({.name = "match_histogram",
                   .source = info,
                   .ours = [other](const ConstAnyView& source, const AnyView& result,
                                   const Run& run) { match_histogram(source, other(), result, {}, run); },
                   .peer_name = "OpenCV's parts",
                   .peer = [other](const ConstAnyView& source,
                                   const AnyView& result) { match_by_parts(mat(source), mat(other()), mat(result)); },
                   .aim = 2});
}

const Rows kRows([](Bench& bench) {
  add(bench, kFullHd);
  add(bench, k24Megapixels);
});

}  // namespace
}  // namespace azulejo::bench
