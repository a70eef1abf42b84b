#include "azulejo/imaging/mask.h"

#include <fmt/format.h>

#include <algorithm>

#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"
#include "azulejo/imaging/arithmetic.h"
#include "azulejo/imaging/mask_kernels.h"
#include "azulejo/imaging/mask_weight.h"

namespace azulejo {
namespace {

template <class T>
constexpr T kTop = static_cast<T>(full_range(kPixelTypeOf<T>));

/// A weight in steps of the type: of f32, 0–1.
template <class T>
T in_steps(int weight) {
  if constexpr (std::is_same_v<T, float>) return static_cast<float>(weight) / static_cast<float>(kFullWeight);
  if constexpr (sizeof(T) == 1) return static_cast<T>((weight + 128) / 257);
  return static_cast<T>(weight);
}

class Mask final : public TileNode {
 public:
  Mask(const MaskOptions& options, std::span<const ImageInfo> sources) : TileNode(sources), options_(options) {
    const ImageInfo& source = sources[0];
    if (sources[1].rect() != source.rect()) {
      throw Error(Error::Argument, fmt::format("mask: {}×{}, expected {}×{}", sources[1].width, sources[1].height,
                                               source.width, source.height));
    }
    ImageInfo info = source;
    if (options.transparent && info.alpha == AlphaState::None) {
      if (info.channels % 2 == 0) {
        throw Error(Error::Argument,
                    fmt::format("source: {}, expected 1 or 3 channels to which alpha is added", describe(source)));
      }
      info.alpha = AlphaState::Straight;
      ++info.channels;
    }
    set_results({info});
  }

  void run(std::span<const ConstTile> from, std::span<const Tile> results, const TileContext& context) const override {
    visit(results[0].pixels, [&](auto view) {
      using T = std::remove_pointer_t<decltype(view.data)>;
      const auto pixels = static_cast<std::size_t>(view.width);
      const auto values = pixels * static_cast<std::size_t>(view.channels);
      T* const weights = context.scratch.take<T>(pixels);
      T* const factors = context.scratch.take<T>(values);
      T* const opaque = context.scratch.take<T>(values);
      for (int y = 0; y < view.height; ++y) {
        const T* const source = from[0].pixels.as<T>().row(y);
        const T* const kept = pixel_weights(from[1].pixels, y, weights);
        const T* const factor = value_factors(kept, pixels, factors);
        const T* const all = adds_alpha() ? with_alpha(source, pixels, opaque) : source;
        T* const result = view.row(y);
        kernels::arithmetic_row(Arithmetic::Multiply, sources()[0].type, reinterpret_cast<const std::byte*>(all),
                                reinterpret_cast<const std::byte*>(factor), values,
                                reinterpret_cast<std::byte*>(result), 0);
        if constexpr (std::is_same_v<T, float>) {
          for (std::size_t i = 0; i < values; ++i) result[i] = factor[i] == 0.0F ? 0.0F : result[i];
        }
      }
    });
  }

  void run_reference(std::span<const ConstTile> from, std::span<const Tile> results,
                     const TileContext&) const override {
    const ImageInfo& info = this->results()[0];
    visit(results[0].pixels, [&](auto view) {
      using T = std::remove_pointer_t<decltype(view.data)>;
      for (int y = 0; y < view.height; ++y) {
        for (int x = 0; x < view.width; ++x) {
          const T weight = weight_at<T>(from[1].pixels, x, y);
          for (int c = 0; c < info.channels; ++c) {
            const bool added = adds_alpha() && c == info.channels - 1;
            const T value = added ? kTop<T> : from[0].pixels.as<T>()(x, y, c);
            const T factor = factor_of(weight, info.alpha != AlphaState::None && c == info.channels - 1);
            view(x, y, c) = factor == T{0} ? T{0} : MultiplyValues<T>()(value, factor);
          }
        }
      }
    });
  }

 private:
  bool adds_alpha() const { return results()[0].channels > sources()[0].channels; }

  template <class T>
  T weight_at(const ConstAnyView& mask, int x, int y) const {
    return visit(mask, [&](auto view) {
      const int weight = mask_weight(&view(x, y), mask.info);
      return in_steps<T>(options_.invert ? kFullWeight - weight : weight);
    });
  }

  /// What a value of a pixel with this weight is multiplied by.
  template <class T>
  T factor_of(T weight, bool is_alpha) const {
    if (results()[0].alpha == AlphaState::None) return weight;
    if (!options_.transparent) return is_alpha ? kTop<T> : weight;
    // What can't be seen has no color; what is seen keeps it, unless it is premultiplied.
    const bool keeps = !is_alpha && results()[0].alpha == AlphaState::Straight && weight != T{0};
    return keeps ? kTop<T> : weight;
  }

  /// The weights of a row, which are the mask itself where that has the source's integers.
  template <class T>
  const T* pixel_weights(const ConstAnyView& mask, int y, T* weights) const {
    if (mask.info.type == kPixelTypeOf<T> && mask.info.channels == 1 && mask.info.type != PixelType::F32) {
      const T* const row = mask.as<T>().row(y);
      if (!options_.invert) return row;
      std::transform(row, row + mask.info.width, weights, [](T v) { return static_cast<T>(kTop<T> - v); });
      return weights;
    }
    for (int x = 0; x < mask.info.width; ++x) weights[x] = weight_at<T>(mask, x, y);
    return weights;
  }

  template <class T>
  const T* value_factors(const T* weights, std::size_t pixels, T* factors) const {
    const ImageInfo& info = results()[0];
    if (info.channels == 1) return weights;
    if (info.alpha == AlphaState::None) {
      kernels::repeat_values(info.type, reinterpret_cast<const std::byte*>(weights), pixels, info.channels,
                             reinterpret_cast<std::byte*>(factors));
      return factors;
    }
    T* factor = factors;
    for (std::size_t x = 0; x < pixels; ++x) {
      for (int c = 0; c < info.channels; ++c) *factor++ = factor_of(weights[x], c == info.channels - 1);
    }
    return factors;
  }

  template <class T>
  const T* with_alpha(const T* source, std::size_t pixels, T* result) const {
    const int channels = sources()[0].channels;
    T* to = result;
    for (std::size_t x = 0; x < pixels; ++x) {
      for (int c = 0; c < channels; ++c) *to++ = *source++;
      *to++ = kTop<T>;
    }
    return result;
  }

  MaskOptions options_;
};

}  // namespace

extern const Operation kMask = with_examples(
    image_operation<MaskOptions, Mask>(
        "mask", "Keeps what a mask marks.",
        {{"source", "the image"}, {"mask", "0 leaves out, full range keeps, between is a weight"}},
        {{"masked", "the source, black or transparent outside the mask"}},
        {field("transparent", &MaskOptions::transparent, "what is left out becomes transparent instead of black"),
         field("invert", &MaskOptions::invert, "what the mask marks is left out")}),
    {{"photo.png mask:mask=mask.png", "Black outside the mask."},
     {"photo.png mask:mask=mask.png,transparent=true", "Transparent outside: a cutout."}});

void mask(const ConstAnyView& source, const ConstAnyView& mask, const AnyView& result, const MaskOptions& options,
          const Run& run) {
  apply_into(kMask, &options, {source, mask}, {result}, run);
}

Image mask(const Image& source, const Image& mask, const MaskOptions& options, const Run& run) {
  return std::move(apply(kMask, &options, {&source, &mask}, run)[0]);
}

}  // namespace azulejo
