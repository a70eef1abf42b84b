#include "azulejo/imaging/gaussian.h"

#include <algorithm>
#include <cmath>

#include "azulejo/engine/operation.h"
#include "azulejo/imaging/gaussian_kernels.h"
#include "azulejo/math/exponential.h"
#include "azulejo/math/transfer.h"

namespace azulejo {
namespace {

using kernels::GaussianPixels;
using kernels::GaussianTile;

/// Up to here bytes are smoothed in integers: the weights' 15 bits are too coarse for wider kernels.
constexpr float kFixedSigma = 16;

/// weights[0 … radius] with weights[0] + 2 · (weights[1] + …) = 1 but for rounding.
std::vector<double> exact_weights(float sigma) {
  const int radius = static_cast<int>(std::ceil(4 * double{sigma}));
  std::vector<double> weights(static_cast<std::size_t>(radius) + 1, 1.0);
  double sum = 1;
  for (int k = 1; k <= radius; ++k) {
    const double steps = k / double{sigma};
    sum += 2 * (weights[static_cast<std::size_t>(k)] = exp_deterministic(-0.5 * steps * steps));
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

/// The same sum but for the rounding of weights[0].
std::vector<float> float_weights(const std::vector<double>& exact) {
  std::vector<float> weights(exact.size());
  double rest = 1;
  for (std::size_t k = exact.size() - 1; k > 0; --k) {
    weights[k] = static_cast<float>(exact[k]);
    rest -= 2 * double{weights[k]};
  }
  weights[0] = static_cast<float>(rest);
  return weights;
}

/// The weights of all taps in 2⁻¹⁵ with a sum of exactly 1, between two zeros. What a rounding leaves goes to the next
/// weight inwards. Ends at the last weight that isn't 0; empty if that is the one in the middle.
std::vector<std::int16_t> fixed_weights(const std::vector<double>& exact) {
  constexpr int kOne = 1 << kernels::kGaussianWeightBits;
  std::vector<int> half(exact.size());
  double carried = 0;
  half[0] = kOne;
  for (std::size_t k = exact.size() - 1; k > 0; --k) {
    const double wanted = exact[k] * kOne + carried;
    half[k] = static_cast<int>(std::floor(wanted + 0.5));
    carried = wanted - half[k];
    half[0] -= 2 * half[k];
  }
  while (half.back() == 0) half.pop_back();
  const std::size_t radius = half.size() - 1;
  if (radius == 0) return {};
  std::vector<std::int16_t> weights(2 * radius + 3);
  for (std::size_t k = 0; k <= radius; ++k) {
    weights[radius + 1 - k] = weights[radius + 1 + k] = static_cast<std::int16_t>(half[k]);
  }
  return weights;
}

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

/// One value of one pass: the scalar definition.
template <class T>
float smoothed(const float* center, std::ptrdiff_t tap, const std::vector<float>& weights) {
  constexpr bool kAnchored = !std::is_same_v<T, std::uint8_t>;
  float sum = 0;
  for (auto k = static_cast<std::ptrdiff_t>(weights.size()) - 1; k > 0; --k) {
    float pair = center[-k * tap] + center[k * tap];
    if (kAnchored) pair = pair - (center[0] + center[0]);
    sum = sum + weights[static_cast<std::size_t>(k)] * pair;
  }
  return sum + (kAnchored ? center[0] : weights[0] * center[0]);
}

/// The same in integers, with so many bits rounded away, from the first tap on.
template <class T>
int smoothed(const T* first, std::ptrdiff_t tap, const std::vector<std::int16_t>& weights, int shift) {
  std::int32_t sum = 1 << (shift - 1);
  for (std::size_t k = 1; k + 1 < weights.size(); ++k, first += tap) sum += weights[k] * *first;
  return sum >> shift;
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
    const std::vector<double> exact = exact_weights(options.sigma);
    const bool as_stored = !pixels_.decode && (!pixels_.alpha || pixels_.premultiplied);
    if (info.type == PixelType::U8 && as_stored && options.sigma <= kFixedSigma) {
      fixed_ = fixed_weights(exact);
      radius_ = fixed_.empty() ? 0 : (static_cast<int>(fixed_.size()) - 3) / 2;
    } else {
      weights_ = float_weights(exact);
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
        for (std::ptrdiff_t i = 0; i < row; ++i) columns[i] = smoothed<T>(center + i, row, weights_);
        for (int x = 0; x < result.width; ++x) {
          float pixel[4];
          for (int c = 0; c < result.channels; ++c) {
            const auto at = std::ptrdiff_t{x + radius_} * result.channels + c;
            pixel[c] = smoothed<T>(columns + at, result.channels, weights_);
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
        const int level = smoothed(source.row(y) + i, source.stride, fixed_, kernels::kGaussianFirstShift);
        columns[i] = static_cast<std::int16_t>(level);
      }
      for (int i = 0; i < result.width * result.channels; ++i) {
        const int level = smoothed(columns + i, result.channels, fixed_, kernels::kGaussianSecondShift);
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

extern const Operation kGaussian = image_operation<GaussianOptions, Gaussian>(
    "gaussian", "Smooths with a Gaussian kernel.", {{"source", "the image"}}, {{"result", "the smoothed image"}},
    {field("sigma", &GaussianOptions::sigma, {0, 1000}, "px", "standard deviation; 0 copies"),
     field("border", &GaussianOptions::border, "what lies outside the image"),
     field("border_value", &GaussianOptions::border_value, {0, 1}, "", "intensity outside, for border=constant"),
     field("light", &GaussianOptions::light, "what is weighted: stored values or linear light")});

void gaussian(const ConstAnyView& source, const AnyView& result, const GaussianOptions& options, const Run& run) {
  apply_into(kGaussian, &options, {source}, {result}, run);
}

Image gaussian(const Image& source, const GaussianOptions& options, const Run& run) {
  return std::move(apply(kGaussian, &options, {&source}, run)[0]);
}

}  // namespace azulejo
