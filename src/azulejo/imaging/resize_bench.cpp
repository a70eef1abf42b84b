#include "azulejo/imaging/resize.h"

#include <vips/vips.h>

#include <opencv2/imgproc.hpp>
#include <string>

#include "bench/harness.h"

namespace azulejo::bench {
namespace {

constexpr Size k4k{3840, 2160};
constexpr Size kHalf{3000, 2000};
constexpr Size kQuarter{1500, 1000};

struct Peer {
  int interpolation;  ///< of OpenCV
  double tolerance;   ///< OpenCV has weights of 11 bits for u8, and takes coordinates in f32
  double aim;
};

void beside_opencv(Bench& bench, const std::string& name, ResizeFilter filter, PixelType type, int channels, Size from,
                   Size to, const Peer& peer, Light light = Light::Encoded) {
  bench.image_row({.name = name,
                   .source = photo(type, channels, from),
                   .result = photo(type, channels, to),
                   .ours =
                       [filter, light](const ConstAnyView& source, const AnyView& result, const Run& run) {
                         resize(source, result,
                                {.width = result.width(), .height = result.height(), .filter = filter, .light = light},
                                run);
                       },
                   .peer =
                       [peer](const ConstAnyView& source, const AnyView& result) {
                         cv::Mat to_mat = mat(result);
                         cv::resize(mat(source), to_mat, to_mat.size(), 0, 0, peer.interpolation);
                       },
                   .tolerance = peer.tolerance,
                   .aim = peer.aim});
}

/// vips_resize into the caller's memory. Without a gap it filters over the whole window as ours does; with its default
/// of 2 it would first average boxes.
void vips_lanczos(const ConstAnyView& source, const AnyView& result) {
  const VipsBandFormat format = source.info.type == PixelType::U8 ? VIPS_FORMAT_UCHAR : VIPS_FORMAT_FLOAT;
  VipsImage* const in =
      vips_image_new_from_memory(source.data, source.info.row_bytes() * static_cast<std::size_t>(source.height()),
                                 source.width(), source.height(), source.info.channels, format);
  VipsImage* out = nullptr;
  const double across = static_cast<double>(result.width()) / source.width();
  const double down = static_cast<double>(result.height()) / source.height();
  if (in == nullptr ||
      vips_resize(in, &out, across, "vscale", down, "kernel", VIPS_KERNEL_LANCZOS3, "gap", 0.0, nullptr) != 0) {
    g_object_unref(in);
    return;
  }
  VipsImage* const memory =
      vips_image_new_from_memory(result.data, result.info.row_bytes() * static_cast<std::size_t>(result.height()),
                                 result.width(), result.height(), result.info.channels, format);
  vips_image_write(out, memory);
  g_object_unref(memory);
  g_object_unref(out);
  g_object_unref(in);
}

void beside_vips(Bench& bench, const std::string& name, int channels, Size from, Size to, double tolerance,
                 Light light) {
  bench.image_row({.name = name,
                   .source = photo(PixelType::U8, channels, from),
                   .result = photo(PixelType::U8, channels, to),
                   .ours =
                       [light](const ConstAnyView& source, const AnyView& result, const Run& run) {
                         resize(source, result, {.width = result.width(), .height = result.height(), .light = light},
                                run);
                       },
                   .peer_name = "libvips",
                   .peer = vips_lanczos,
                   .tolerance = tolerance,
                   .margin = 8,
                   .aim = 1.5,
                   .packed = true});
}

const Rows kRows([](Bench& bench) {
  // libvips rounds between its passes and has weights of few bits.
  beside_vips(bench, "resize lanczos 1/4", 3, k24Megapixels, kQuarter, 4, Light::Encoded);
  beside_vips(bench, "resize lanczos 1/4 linear light (libvips: encoded)", 3, k24Megapixels, kQuarter, 255,
              Light::Linear);
  // OpenCV's Lanczos has four lobes: 8 × 8 products instead of 6 × 6.
  for (const int channels : {1, 3}) {
    beside_opencv(bench, "resize lanczos 2×", ResizeFilter::Lanczos, PixelType::U8, channels, kFullHd, k4k,
                  {cv::INTER_LANCZOS4, 255, 2});
  }
  beside_opencv(bench, "resize lanczos 2×", ResizeFilter::Lanczos, PixelType::F32, 3, kFullHd, k4k,
                {cv::INTER_LANCZOS4, 1, 2});
  beside_opencv(bench, "resize lanczos 2× linear light (OpenCV: encoded)", ResizeFilter::Lanczos, PixelType::U8, 3,
                kFullHd, k4k, {cv::INTER_LANCZOS4, 255, 1}, Light::Linear);
  for (const int channels : {1, 3}) {
    beside_opencv(bench, "resize bilinear 2×", ResizeFilter::Bilinear, PixelType::U8, channels, kFullHd, k4k,
                  {cv::INTER_LINEAR, 1, 1});
  }
  beside_opencv(bench, "resize bilinear 2×", ResizeFilter::Bilinear, PixelType::F32, 3, kFullHd, k4k,
                {cv::INTER_LINEAR, 1e-5, 1});
  // OpenCV's cubic has a = −0.75, sharper than Catmull–Rom.
  for (const int channels : {1, 3}) {
    beside_opencv(bench, "resize bicubic 2×", ResizeFilter::Bicubic, PixelType::U8, channels, kFullHd, k4k,
                  {cv::INTER_CUBIC, 255, 1});
  }
  for (const int channels : {1, 3}) {
    beside_opencv(bench, "resize area 1/4", ResizeFilter::Area, PixelType::U8, channels, k24Megapixels, kQuarter,
                  {cv::INTER_AREA, 1, 1});
  }
  beside_opencv(bench, "resize area 1/2", ResizeFilter::Area, PixelType::U8, 3, k24Megapixels, kHalf,
                {cv::INTER_AREA, 1, 0.9});
  beside_opencv(bench, "resize nearest 2×", ResizeFilter::Nearest, PixelType::U8, 3, kFullHd, k4k,
                {cv::INTER_NEAREST_EXACT, 0, 1});
});

}  // namespace
}  // namespace azulejo::bench
