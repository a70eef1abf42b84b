#include "azulejo/imaging/grayscale.h"

#include <fmt/format.h>

#include <algorithm>

#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"
#include "azulejo/imaging/grayscale_kernels.h"
#include "azulejo/math/transfer.h"

namespace azulejo {
namespace {

using kernels::GrayRule;

GrayRule gray_rule(const GrayscaleOptions& options, ColorState color) {
  if (color == ColorState::Linear) return GrayRule::Luminance;
  if (options.light == Light::Encoded) return GrayRule::Luma;
  return color == ColorState::Srgb ? GrayRule::LightLuminance : GrayRule::Luminance;
}

float luminance(float r, float g, float b) { return 0.2126F * r + 0.7152F * g + 0.0722F * b; }

template <class T>
T rounded(float value) {
  if constexpr (std::is_same_v<T, float>) return value;
  return static_cast<T>(std::min(value + 0.5F, full_range(kPixelTypeOf<T>)));
}

/// The gray of a pixel; `unit` is the value that stands for full intensity.
template <class T>
T gray_of(const T* pixel, GrayRule rule, float unit) {
  if (rule == GrayRule::Luma) {
    if constexpr (std::is_same_v<T, float>) {
      return 0.299F * pixel[0] + 0.587F * pixel[1] + 0.114F * pixel[2];
    } else {
      return static_cast<T>((299U * pixel[0] + 587U * pixel[1] + 114U * pixel[2] + 500U) / 1000U);
    }
  }
  const auto r = static_cast<float>(pixel[0]);
  const auto g = static_cast<float>(pixel[1]);
  const auto b = static_cast<float>(pixel[2]);
  if (rule == GrayRule::Luminance) return rounded<T>(luminance(r, g, b));
  if (unit == 0) return T{0};
  const float light = luminance(srgb_to_linear(r / unit), srgb_to_linear(g / unit), srgb_to_linear(b / unit));
  return rounded<T>(linear_to_srgb(light) * unit);
}

class Grayscale final : public TileNode {
 public:
  Grayscale(const GrayscaleOptions& options, std::span<const ImageInfo> sources)
      : TileNode(sources), rule_(gray_rule(options, sources[0].color)) {
    ImageInfo info = sources[0];
    if (info.color_channels() != 1 && info.color_channels() != 3) {
      throw Error(Error::Argument, fmt::format("source: {}, expected 1 or 3 channels beside alpha", describe(info)));
    }
    info.channels -= info.color_channels() - 1;
    set_results({info});
  }

  void run(std::span<const ConstTile> sources, std::span<const Tile> results, const TileContext&) const override {
    if (is_gray()) return copy_pixels(sources[0].pixels, results[0].pixels);
    kernels::grayscale(sources[0].pixels, results[0].pixels, rule_);
  }

  void run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                     const TileContext&) const override {
    if (is_gray()) return copy_pixels(sources[0].pixels, results[0].pixels);
    visit(results[0].pixels, [&](auto result) {
      using T = std::remove_pointer_t<decltype(result.data)>;
      const auto source = sources[0].pixels.as<T>();
      const bool premultiplied = results[0].pixels.info.alpha == AlphaState::Premultiplied;
      for (int y = 0; y < result.height; ++y) {
        for (int x = 0; x < result.width; ++x) {
          const T* const pixel = &source(x, y);
          const float unit = premultiplied ? static_cast<float>(pixel[3]) : full_range(kPixelTypeOf<T>);
          result(x, y) = gray_of(pixel, rule_, unit);
          if (result.channels == 2) result(x, y, 1) = pixel[3];
        }
      }
    });
  }

 private:
  bool is_gray() const { return sources()[0].color_channels() == 1; }

  GrayRule rule_;
};

}  // namespace

extern const Operation kGrayscale =
    with_examples(image_operation<GrayscaleOptions, Grayscale>(
                      "grayscale", "Makes one channel of gray out of three of color.", {{"source", "the image"}},
                      {{"gray", "one channel, and the source's alpha"}},
                      {field("light", &GrayscaleOptions::light,
                             "luma of the stored values, or luminance of the light they stand for")}),
                  {{"photo.png grayscale", "Luma: greens look brighter than blues of the same value."},
                   {"photo.png grayscale:light=linear",
                    "Luminance of the light itself: saturated colors come out brighter or darker."}});

void grayscale(const ConstAnyView& source, const AnyView& result, const GrayscaleOptions& options, const Run& run) {
  apply_into(kGrayscale, &options, {source}, {result}, run);
}

Image grayscale(const Image& source, const GrayscaleOptions& options, const Run& run) {
  return std::move(apply(kGrayscale, &options, {&source}, run)[0]);
}

}  // namespace azulejo
