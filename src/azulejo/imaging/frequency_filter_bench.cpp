#include "azulejo/imaging/frequency_filter.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "azulejo/imaging/spectrum.h"
#include "bench/harness.h"

namespace azulejo::bench {
namespace {

constexpr float kCutoff = 0.2F;

/// The peer's steps: borders, transform, product with a response made beforehand, transform back.
class Steps {
 public:
  explicit Steps(Size size)
      : margin_(40),
        width_(cv::getOptimalDFTSize(size.width + 2 * margin_)),
        height_(cv::getOptimalDFTSize(size.height + 2 * margin_)),
        response_(height_, width_, CV_32FC2) {
    for (int v = 0; v < height_; ++v) {
      for (int u = 0; u < width_; ++u) {
        const double x = 2.0 * std::min(u, width_ - u) / width_ / kCutoff;
        const double y = 2.0 * std::min(v, height_ - v) / height_ / kCutoff;
        const auto share = static_cast<float>(std::exp(-0.5 * (x * x + y * y)));
        response_.at<cv::Vec2f>(v, u) = {share, 0};
      }
    }
    // The packed form in which cv::dft gives the transform of a real image.
    cv::Mat impulse;
    cv::idft(response_, impulse, cv::DFT_REAL_OUTPUT | cv::DFT_SCALE);
    cv::dft(impulse, packed_);
  }

  void operator()(const ConstAnyView& source, const AnyView& result) {
    mat(source).convertTo(values_, CV_32F);
    const int right = width_ - margin_ - source.width();
    const int below = height_ - margin_ - source.height();
    cv::copyMakeBorder(values_, padded_, margin_, below, margin_, right, cv::BORDER_REFLECT_101);
    cv::dft(padded_, transformed_);
    cv::mulSpectrums(transformed_, packed_, transformed_, 0);
    cv::idft(transformed_, padded_, cv::DFT_REAL_OUTPUT | cv::DFT_SCALE);
    cv::Mat to = mat(result);
    padded_(cv::Rect(margin_, margin_, source.width(), source.height())).convertTo(to, to.depth());
  }

 private:
  int margin_;
  int width_;
  int height_;
  cv::Mat response_;
  cv::Mat packed_;
  cv::Mat values_;
  cv::Mat padded_;
  cv::Mat transformed_;
};

void add_filter(Bench& bench, PixelType type, Size size) {
  bench.image_row({.name = "frequency_filter gaussian",
                   .source = photo(type, 1, size),
                   .ours = [](const ConstAnyView& source, const AnyView& result,
                              const Run& run) { frequency_filter(source, result, {.cutoff = kCutoff}, run); },
                   .peer = [steps = Steps(size)](const ConstAnyView& source,
                                                 const AnyView& result) mutable { steps(source, result); },
                   .tolerance = type == PixelType::F32 ? 1e-5 : 1,
                   .margin = 2,
                   .aim = 2.5});
}

/// The peer's steps up to the logarithm, which is not moved to the middle.
void add_spectrum(Bench& bench, Size size) {
  ImageInfo result = photo(PixelType::F32, 1, size);
  result.color = ColorState::Data;
  bench.image_row({.name = "spectrum",
                   .source = photo(PixelType::F32, 1, size),
                   .result = result,
                   .ours = [](const ConstAnyView& source, const AnyView& to,
                              const Run& run) { spectrum(source, to, {.output = FilterOutput::F32}, run); },
                   .peer =
                       [=, planes = std::vector<cv::Mat>(2), both = cv::Mat(), length = cv::Mat()](
                           const ConstAnyView& source, const AnyView& to) mutable {
                         cv::dft(mat(source), both, cv::DFT_COMPLEX_OUTPUT);
                         cv::split(both, planes);
                         cv::magnitude(planes[0], planes[1], length);
                         length += 1;
                         cv::log(length, length);
                         const cv::Mat view = mat(to);
                         const int x = view.cols / 2;
                         const int y = view.rows / 2;
                         const int right = view.cols - x;
                         const int below = view.rows - y;
                         length({right, below, x, y}).copyTo(view({0, 0, x, y}));
                         length({0, below, right, y}).copyTo(view({x, 0, right, y}));
                         length({right, 0, x, below}).copyTo(view({0, y, x, below}));
                         length({0, 0, right, below}).copyTo(view({x, y, right, below}));
                       },
                   .tolerance = 0.05,  // where |F| is as small as what roundings leave of its largest
                   .aim = 2.5});
}

const Rows kRows([](Bench& bench) {
  add_filter(bench, PixelType::U8, kFullHd);
  add_filter(bench, PixelType::F32, kFullHd);
  add_filter(bench, PixelType::U8, k24Megapixels);
  add_spectrum(bench, kFullHd);
  add_spectrum(bench, {2048, 2048});
});

}  // namespace
}  // namespace azulejo::bench
