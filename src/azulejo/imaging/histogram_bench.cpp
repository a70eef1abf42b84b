#include "azulejo/imaging/histogram.h"

#include <opencv2/imgproc.hpp>

#include <fmt/format.h>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

void add(Bench& bench, PixelType type, int channels, Size size) {
  const ImageInfo info = photo(type, channels, size);
  bench.row(fmt::format("histogram, {}", kind(info)), [info, type] {
    struct Held {
      std::shared_ptr<Image> image;
      Histogram ours;
      std::array<cv::Mat, 3> histograms;
    };
    const auto held = std::make_shared<Held>();
    held->image = make_photo(info);
    Row row;
    row.work = static_cast<double>(info.rect().area());
    row.ours = [held](int threads) {
      azulejo::Run run;
      run.threads = threads;
      held->ours = histogram(*held->image, {}, run);
    };
    row.peer = [held, type, info](int) {
      const cv::Mat image = mat(held->image->any());
      const int bins = 256;
      const float range[] = {0, type == PixelType::U8 ? 256.0F : 65536.0F};
      const float* ranges = range;
      for (int c = 0; c < info.channels; ++c) {
        cv::calcHist(&image, 1, &c, cv::Mat(), held->histograms[static_cast<std::size_t>(c)], 1, &bins, &ranges);
      }
    };
    row.limit = copy_limit(info.row_bytes() * static_cast<std::size_t>(info.height), 0);
    row.check = [held, info]() -> Check {
      double difference = 0;
      for (int c = 0; c < info.channels; ++c) {
        const auto at = static_cast<std::size_t>(c);
        for (int b = 0; b < 256; ++b) {
          const auto ours = static_cast<double>(held->ours.counts[at][static_cast<std::size_t>(b)]);
          difference = std::max(difference, std::abs(ours - static_cast<double>(held->histograms[at].at<float>(b))));
        }
      }
      return {difference == 0, fmt::format("largest difference {}", difference)};
    };
    row.aim = 2;
    return row;
  });
}

const Rows kRows([](Bench& bench) {
  add(bench, PixelType::U8, 1, kFullHd);
  add(bench, PixelType::U8, 1, k24Megapixels);
  add(bench, PixelType::U8, 3, k24Megapixels);
  add(bench, PixelType::U16, 1, k24Megapixels);
});

}  // namespace
}  // namespace azulejo::bench
