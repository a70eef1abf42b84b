#include "azulejo/imaging/statistics.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include <fmt/format.h>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

/// The peer gives extrema, mean and deviation, and a histogram, of which percentiles and entropy could be made.
void add(Bench& bench, PixelType type) {
  const ImageInfo info = photo(type, 1, k24Megapixels);
  bench.row(fmt::format("statistics, {}", kind(info)), [info, type] {
    struct Held {
      std::shared_ptr<Image> image;
      Statistics ours;
      double low = 0, high = 0;
      cv::Scalar mean, deviation;
      cv::Mat histogram;
    };
    const auto held = std::make_shared<Held>();
    held->image = make_photo(info);
    Row row;
    row.work = static_cast<double>(info.rect().area());
    row.ours = [held](int threads) {
      azulejo::Run run;
      run.threads = threads;
      held->ours = statistics(*held->image, {}, run);
    };
    row.peer = [held, type](int) {
      const cv::Mat image = mat(held->image->any());
      cv::minMaxLoc(image, &held->low, &held->high);
      cv::meanStdDev(image, held->mean, held->deviation);
      const int channel = 0;
      const int bins = type == PixelType::U8 ? 256 : 65536;
      const float range[] = {0, type == PixelType::F32 ? 1.0F : static_cast<float>(bins)};
      const float* ranges = range;
      cv::calcHist(&image, 1, &channel, cv::Mat(), held->histogram, 1, &bins, &ranges);
    };
    row.limit = copy_limit(info.row_bytes() * static_cast<std::size_t>(info.height), 0);
    row.check = [held, type]() -> Check {
      const double top = full_range(type);
      const bool right = std::fabs(held->ours.all.mean - held->mean[0] / top) < 1e-6 &&
                         std::fabs(held->ours.all.standard_deviation - held->deviation[0] / top) < 1e-6 &&
                         std::fabs(held->ours.all.maximum - held->high / top) < 1e-6;
      return {right, fmt::format("mean {}", held->ours.all.mean)};
    };
    row.aim = type == PixelType::F32 ? 0.5 : 2;  // the peer sums floats in the order of memory
    return row;
  });
}

const Rows kRows([](Bench& bench) {
  for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32}) add(bench, type);
});

}  // namespace
}  // namespace azulejo::bench
