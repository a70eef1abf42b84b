#include "azulejo/imaging/compare.h"

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/quality/qualityssim.hpp>

#include <fmt/format.h>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

/// A photo and one with every ninth level changed.
void add(Bench& bench, Size size, bool ssim) {
  const ImageInfo info = photo(PixelType::U8, 1, size);
  bench.row(fmt::format("compare {}, {}", ssim ? "all" : "without ssim", kind(info)), [info, ssim] {
    struct Held {
      std::shared_ptr<Image> a;
      std::shared_ptr<Image> b;
      Comparison ours;
      double maximum = 0;
      double mean = 0;
      double psnr = 0;
      double similarity = 0;
    };
    const auto held = std::make_shared<Held>();
    held->a = make_photo(info);
    held->b = make_photo(info);
    const auto view = held->b->view<std::uint8_t>();
    for (int y = 0; y < view.height; ++y) {
      for (int x = y % 9; x < view.width; x += 9) view(x, y) ^= 5;
    }
    Row row;
    row.work = static_cast<double>(info.rect().area());
    row.ours = [held, ssim](int threads) {
      azulejo::Run run;
      run.threads = threads;
      held->ours = compare(*held->a, *held->b, {.ssim = ssim}, run);
    };
    row.peer = [held, ssim](int) {
      const cv::Mat a = mat(held->a->any());
      const cv::Mat b = mat(held->b->any());
      const auto count = static_cast<double>(a.total());
      held->maximum = cv::norm(a, b, cv::NORM_INF) / 255;
      held->mean = cv::norm(a, b, cv::NORM_L1) / 255 / count;
      held->psnr = cv::PSNR(a, b);
      if (ssim) held->similarity = cv::quality::QualitySSIM::compute(a, b, cv::noArray())[0];
    };
    row.limit = copy_limit(2 * info.row_bytes() * static_cast<std::size_t>(info.height), 0);
    row.check = [held, ssim]() -> Check {
      // The peer's mean takes windows in at the borders.
      const bool right = std::fabs(held->ours.maximum - held->maximum) < 1e-6 &&
                         std::fabs(held->ours.mean - held->mean) < 1e-6 &&
                         std::fabs(held->ours.psnr - held->psnr) < 1e-3 &&
                         (!ssim || std::fabs(held->ours.ssim.value() - held->similarity) < 1e-3);
      return {right, fmt::format("ssim {} and {}", held->ours.ssim.value_or(0), held->similarity)};
    };
    row.aim = 2;
    return row;
  });
}

const Rows kRows([](Bench& bench) {
  add(bench, kFullHd, true);
  add(bench, kFullHd, false);
  add(bench, k24Megapixels, true);
});

}  // namespace
}  // namespace azulejo::bench
