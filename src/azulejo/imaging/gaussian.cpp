#include "azulejo/imaging/gaussian.h"

#include <algorithm>

#include "azulejo/engine/operation.h"
#include "azulejo/imaging/gaussian_definition.h"
#include "azulejo/imaging/gaussian_kernels.h"
#include "azulejo/math/transfer.h"

namespace azulejo {
namespace {

using kernels::GaussianPixels;
using kernels::GaussianTile;

float divided(float color, float alpha, float least) {
  return (least > 0 ? alpha < least : alpha == 0) ? 0.0F : color / alpha;
}

/// The stored values of a pixel as they are weighted.
template <class T>
void load_pixel(const T* stored, float* weighted, const GaussianPixels& what) {
  const int colors = what.alpha ? what.channels - 1 : what.channels;
  const auto alpha = static_cast<float>(stored[what.channels - 1]);
  for (int c = 0; c < colors; ++c) {
    auto color = static_cast<float>(stored[c]);
    if (what.decode) color = srgb_to_linear(what.premultiplied ? divided(color, alpha, 0) : color / what.full);
    if (what.alpha && (what.decode || !what.premultiplied)) color *= alpha;
    weighted[c] = color;
  }
  if (what.alpha) weighted[colors] = alpha;
}

template <class T>
T rounded(float value) {
  if constexpr (std::is_same_v<T, float>) {
    return value;
  } else {
    const int top = static_cast<int>(full_range(kPixelTypeOf<T>));
    return static_cast<T>(std::clamp(static_cast<int>(value + 0.5F), 0, top));
  }
}

template <class T>
void store_pixel(const float* weighted, T* stored, const GaussianPixels& what) {
  const int colors = what.alpha ? what.channels - 1 : what.channels;
  const float alpha = weighted[what.channels - 1];
  const bool as_stored = !what.decode && what.premultiplied;
  for (int c = 0; c < colors; ++c) {
    float color = weighted[c];
    if (what.alpha && !as_stored) color = divided(color, alpha, std::is_same_v<T, float> ? 0.0F : 0.5F);
    if (what.decode) color = linear_to_srgb(color) * (what.premultiplied ? alpha : what.full);
    stored[c] = rounded<T>(color);
  }
  if (what.alpha) stored[colors] = rounded<T>(alpha);
}

class Gaussian final : public TileNode {
 public:
  Gaussian(const GaussianOptions& options, std::span<const ImageInfo> sources) : TileNode(sources), options_(options) {
    const ImageInfo& info = sources[0];
    set_results({info});
    pixels_ = {.channels = info.channels,
               .full = full_range(info.type),
               .alpha = info.alpha != AlphaState::None,
               .premultiplied = info.alpha == AlphaState::Premultiplied,
               .decode = options.light == Light::Linear && info.color == ColorState::Srgb};
    const std::vector<double> exact = exact_gaussian_weights(options.sigma);
    const bool as_stored = !pixels_.decode && (!pixels_.alpha || pixels_.premultiplied);
    if (info.type == PixelType::U8 && as_stored && options.sigma <= kFixedGaussianSigma) {
      fixed_ = fixed_gaussian_weights(exact);
      radius_ = fixed_.empty() ? 0 : (static_cast<int>(fixed_.size()) - 3) / 2;
    } else {
      weights_ = float_gaussian_weights(exact);
      radius_ = static_cast<int>(weights_.size()) - 1;
    }
  }

  Rect needs(const Rect& result, int) const override { return grown(result, radius_, radius_); }
  BorderRule border(int) const override { return {options_.border, options_.border_value}; }

  void run(std::span<const ConstTile> sources, std::span<const Tile> results,
           const TileContext& context) const override {
    if (radius_ == 0) return copy_pixels(sources[0].pixels, results[0].pixels);
    visit(results[0].pixels, [&](auto result) {
      using T = std::remove_pointer_t<decltype(result.data)>;
      const auto source = sources[0].pixels.as<T>();
      const GaussianTile<T> tile{source.data, source.stride, result.data, result.stride, result.width, result.height};
      if constexpr (std::is_same_v<T, std::uint8_t>) {
        if (!fixed_.empty()) {
          return kernels::gaussian_tile(tile, pixels_.channels, fixed_.data(), radius_, context.scratch);
        }
      }
      kernels::gaussian_tile(tile, pixels_, weights_.data(), radius_, context.scratch);
    });
  }

  void run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                     const TileContext& context) const override {
    if (radius_ == 0) return copy_pixels(sources[0].pixels, results[0].pixels);
    visit(results[0].pixels, [&](auto result) {
      using T = std::remove_pointer_t<decltype(result.data)>;
      const auto source = sources[0].pixels.as<T>();
      if constexpr (std::is_same_v<T, std::uint8_t>) {
        if (!fixed_.empty()) return run_fixed_reference(source, result, context.scratch);
      }
      const auto row = std::ptrdiff_t{source.width} * source.channels;
      float* const loaded = context.scratch.take<float>(static_cast<std::size_t>(row * source.height));
      float* const columns = context.scratch.take<float>(static_cast<std::size_t>(row));
      for (int y = 0; y < source.height; ++y) {
        for (int x = 0; x < source.width; ++x) {
          load_pixel(&source(x, y), loaded + y * row + std::ptrdiff_t{x} * source.channels, pixels_);
        }
      }
      for (int y = 0; y < result.height; ++y) {
        const float* const center = loaded + (y + radius_) * row;
        for (std::ptrdiff_t i = 0; i < row; ++i) columns[i] = gaussian_value<T>(center + i, row, weights_);
        for (int x = 0; x < result.width; ++x) {
          float pixel[4];
          for (int c = 0; c < result.channels; ++c) {
            const auto at = std::ptrdiff_t{x + radius_} * result.channels + c;
            pixel[c] = gaussian_value<T>(columns + at, result.channels, weights_);
          }
          store_pixel(pixel, &result(x, y), pixels_);
        }
      }
    });
  }

 private:
  void run_fixed_reference(const ImageView<const std::uint8_t>& source, const ImageView<std::uint8_t>& result,
                           Scratch& scratch) const {
    const auto row = std::ptrdiff_t{source.width} * source.channels;
    auto* const columns = scratch.take<std::int16_t>(static_cast<std::size_t>(row));
    for (int y = 0; y < result.height; ++y) {
      for (std::ptrdiff_t i = 0; i < row; ++i) {
        const int level = fixed_gaussian_value(source.row(y) + i, source.stride, fixed_, kernels::kGaussianFirstShift);
        columns[i] = static_cast<std::int16_t>(level);
      }
      for (int i = 0; i < result.width * result.channels; ++i) {
        const int level = fixed_gaussian_value(columns + i, result.channels, fixed_, kernels::kGaussianSecondShift);
        result.row(y)[i] = static_cast<std::uint8_t>(level);
      }
    }
  }

  GaussianOptions options_;
  int radius_;
  std::vector<float> weights_;
  std::vector<std::int16_t> fixed_;  ///< weights of bytes that are smoothed in integers; else empty
  GaussianPixels pixels_;
};

}  // namespace

extern const Operation kGaussian = with_examples(
    image_operation<GaussianOptions, Gaussian>(
        "gaussian", "Smooths with a Gaussian kernel.", {{"source", "the image"}}, {{"result", "the smoothed image"}},
        {field("sigma", &GaussianOptions::sigma, {0, 1000}, "px", "standard deviation; 0 copies"),
         field("border", &GaussianOptions::border, "what lies outside the image"),
         field("border_value", &GaussianOptions::border_value, {0, 1}, "", "intensity outside, for border=constant"),
         field("light", &GaussianOptions::light, "what is weighted: stored values or linear light")}),
    {{"photo.png gaussian:sigma=4", "Details smaller than some pixels are gone."},
     {"cutout.png gaussian:sigma=6", "A soft edge; hidden colors do not bleed into it."}});

void gaussian(const ConstAnyView& source, const AnyView& result, const GaussianOptions& options, const Run& run) {
  apply_into(kGaussian, &options, {source}, {result}, run);
}

Image gaussian(const Image& source, const GaussianOptions& options, const Run& run) {
  return std::move(apply(kGaussian, &options, {&source}, run)[0]);
}

}  // namespace azulejo
