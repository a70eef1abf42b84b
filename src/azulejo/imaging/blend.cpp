#include "azulejo/imaging/blend.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"
#include "azulejo/imaging/blend_kernels.h"
#include "azulejo/math/transfer.h"

namespace azulejo {
namespace {

/// A pixel as it is weighted: colors times alpha.
struct Weighted {
  std::array<float, 4> color{};
  float alpha = 1;  ///< 0–1
};

/// How pixels of an image become weighted ones, and back.
struct PixelFormat {
  AlphaState alpha;
  int colors;
  bool curve;  ///< stored values are sRGB, weighted ones are light

  template <class T>
  Weighted load(const T* pixel, int wanted_colors) const {
    const float top = full_range(kPixelTypeOf<T>);
    Weighted result;
    if (alpha != AlphaState::None) result.alpha = static_cast<float>(pixel[colors]) / top;
    for (int c = 0; c < wanted_colors; ++c) {
      float value = static_cast<float>(pixel[colors == 1 ? 0 : c]) / top;
      if (curve) {
        if (alpha == AlphaState::Premultiplied) value = over(value, result.alpha);
        value = srgb_to_linear(value);
      }
      const bool multiplied = alpha == AlphaState::None || (alpha == AlphaState::Premultiplied && !curve);
      result.color[static_cast<std::size_t>(c)] = multiplied ? value : value * result.alpha;
    }
    return result;
  }

  template <class T>
  void store(const Weighted& weighted, T* pixel) const {
    for (int c = 0; c < colors; ++c) {
      float value = weighted.color[static_cast<std::size_t>(c)];
      const bool divide = alpha == AlphaState::Straight || (alpha == AlphaState::Premultiplied && curve);
      if (divide) value = over(value, weighted.alpha);
      if (curve) value = linear_to_srgb(value);
      if (divide && alpha == AlphaState::Premultiplied) value = value * weighted.alpha;
      pixel[c] = rounded<T>(value);
    }
    if (alpha != AlphaState::None) pixel[colors] = rounded<T>(weighted.alpha);
  }

 private:
  static float over(float value, float divisor) { return divisor == 0 ? 0 : value / divisor; }

  template <class T>
  static T rounded(float value) {
    if constexpr (std::is_same_v<T, float>) return value;
    const float top = full_range(kPixelTypeOf<T>);
    return static_cast<T>(std::min(value * top + 0.5F, top));
  }
};

class Blend final : public Node {
 public:
  Blend(const BlendOptions& options, std::span<const ImageInfo> sources) : Node(sources), options_(options) {
    const ImageInfo& source = sources[0];
    const ImageInfo& other = sources[1];
    const int source_colors = source.color_channels();
    const int other_colors = other.color_channels();
    if (source.rect() != other.rect() || source.type != other.type || source.color != other.color) {
      throw Error(Error::Argument, fmt::format("other: {}, expected size, pixel type and color state of source: {}",
                                               describe(other), describe(source)));
    }
    if (source_colors != other_colors && source_colors != 1 && other_colors != 1) {
      throw Error(Error::Argument, fmt::format("other: {}, expected the color channels of source or gray: {}",
                                               describe(other), describe(source)));
    }
    ImageInfo info = source;
    if (info.alpha == AlphaState::None) info.alpha = other.alpha;
    info.channels = std::max(source_colors, other_colors) + (info.alpha == AlphaState::None ? 0 : 1);
    if (info.alpha != AlphaState::None && info.channels % 2 != 0) {
      throw Error(Error::Argument, fmt::format("other: {} and source: {}, expected 1 or 3 channels beside alpha",
                                               describe(other), describe(source)));
    }
    set_results({info});
    curve_ = options.light == Light::Linear && info.color == ColorState::Srgb;
    plain_ = !curve_ && info.alpha != AlphaState::Straight && source.alpha == other.alpha &&
             source.channels == other.channels;
  }

  void run(std::span<const ConstTile> from, std::span<const Tile> results, const TileContext& context) const override {
    if (!plain_) return run_reference(from, results, context);
    kernels::blend(from[0].pixels, from[1].pixels, results[0].pixels, options_.amount);
  }

  void run_reference(std::span<const ConstTile> from, std::span<const Tile> results,
                     const TileContext&) const override {
    visit(results[0].pixels, [&](auto result) {
      using T = std::remove_pointer_t<decltype(result.data)>;
      const auto source = from[0].pixels.as<T>();
      const auto other = from[1].pixels.as<T>();
      if (plain_) {
        const kernels::BlendPoint<T> mix(options_.amount);
        for (int y = 0; y < result.height; ++y) {
          const int count = result.width * result.channels;
          for (int i = 0; i < count; ++i) result.row(y)[i] = mix(source.row(y)[i], other.row(y)[i]);
        }
        return;
      }
      const PixelFormat formats[] = {format_of(sources()[0]), format_of(sources()[1]), format_of(this->results()[0])};
      for (int y = 0; y < result.height; ++y) {
        for (int x = 0; x < result.width; ++x) {
          const int colors = formats[2].colors;
          const Weighted mixed = mix(formats[0].load(&source(x, y), colors), formats[1].load(&other(x, y), colors));
          formats[2].store(mixed, &result(x, y));
        }
      }
    });
  }

 private:
  PixelFormat format_of(const ImageInfo& info) const { return {info.alpha, info.color_channels(), curve_}; }

  Weighted mix(const Weighted& source, const Weighted& other) const {
    const kernels::BlendPoint<float> mix_one(options_.amount);
    Weighted result;
    for (std::size_t c = 0; c < result.color.size(); ++c) result.color[c] = mix_one(source.color[c], other.color[c]);
    result.alpha = mix_one(source.alpha, other.alpha);
    return result;
  }

  BlendOptions options_;
  bool curve_ = false;
  bool plain_ = false;  ///< stored values are weighted and summed as they are
};

}  // namespace

extern const Operation kBlend = image_operation<BlendOptions, Blend>(
    "blend", "Mixes two images.", {{"source", "the image"}, {"other", "the image that is mixed in"}},
    {{"blended", "the weighted mean of both"}},
    {field("amount", &BlendOptions::amount, {0, 1}, "", "share of the other image"),
     field("light", &BlendOptions::light, "what is mixed: stored values, or the light they stand for")});

void blend(const ConstAnyView& source, const ConstAnyView& other, const AnyView& result, const BlendOptions& options,
           const Run& run) {
  apply_into(kBlend, &options, {source, other}, {result}, run);
}

Image blend(const Image& source, const Image& other, const BlendOptions& options, const Run& run) {
  return std::move(apply(kBlend, &options, {&source, &other}, run)[0]);
}

}  // namespace azulejo
