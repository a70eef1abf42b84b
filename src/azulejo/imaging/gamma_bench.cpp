#include "azulejo/imaging/gamma.h"

#include "azulejo/imaging/tone_bench.h"

namespace azulejo::bench {
namespace {

constexpr float kGamma = 2.2F;

void add(Bench& bench, const ImageInfo& source, ImageCall peer, double tolerance) {
  bench.image_row({.name = "gamma gamma=2.2",
                   .source = source,
                   .ours = [](const ConstAnyView& from, const AnyView& to,
                              const Run& run) { gamma(from, to, {.gamma = kGamma}, run); },
                   .peer = std::move(peer),
                   .tolerance = tolerance});
}

const Rows kRows([](Bench& bench) {
  const ImageCall lookup = table_peer([](const Image& every) { return gamma(every, {.gamma = kGamma}); });
  add(bench, photo(PixelType::U8, 1, kFullHd), lookup, 0);
  add(bench, photo(PixelType::U8, 1, k24Megapixels), lookup, 0);
  add(bench, photo(PixelType::U8, 3, kFullHd), lookup, 0);
  const auto power = [](const ConstAnyView& from, const AnyView& to) { cv::pow(mat(from), kGamma, mat(to)); };
  add(bench, photo(PixelType::F32, 1, kFullHd), power, 2e-6);
  add(
      bench, photo(PixelType::U16, 1, kFullHd),
      [](const ConstAnyView& from, const AnyView& to) {
        static cv::Mat real;
        mat(from).convertTo(real, CV_32F, 1 / 65535.0);
        cv::pow(real, kGamma, real);
        cv::Mat result = mat(to);
        real.convertTo(result, CV_16U, 65535);
      },
      1);
});

}  // namespace
}  // namespace azulejo::bench
