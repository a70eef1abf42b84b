#include "azulejo/imaging/noise.h"

#include "azulejo/engine/operation.h"
#include "azulejo/imaging/noise_kernels.h"

namespace azulejo {
namespace {

/// The random words and normal deviates of part of a row, one a value, those of alpha without use.
class RowNoise {
 public:
  RowNoise(const NoiseOptions& options, const ImageInfo& info, int width, bool reference, Scratch& scratch)
      : options_(options), channels_(info.channels), reference_(reference) {
    drawn_ = options.monochrome ? 1 : channels_;
    count_ = static_cast<std::size_t>(width) * static_cast<std::size_t>(channels_);
    const std::size_t room = count_ + 8 + kernels::kNoiseRoom;
    words_ = scratch.take<std::uint32_t>(room);
    deviates_ = scratch.take<float>(room);
    spread_words_ = scratch.take<std::uint32_t>(count_);
    spread_deviates_ = scratch.take<float>(count_);
  }

  /// The row's pixels from x on.
  void draw(int x, int y, bool normal) {
    const std::size_t first = static_cast<std::size_t>(x) * static_cast<std::size_t>(drawn_);
    const std::size_t drawn = count_ / static_cast<std::size_t>(channels_) * static_cast<std::size_t>(drawn_);
    const std::size_t skip = first % 4;
    const kernels::NoiseBits place{static_cast<std::uint32_t>(options_.seed), static_cast<std::uint32_t>(y),
                                   static_cast<std::uint32_t>(first / 4), (skip + drawn + 3) / 4};
    (reference_ ? kernels::noise_bits_reference : kernels::noise_bits)(place, words_);
    if (normal) (reference_ ? kernels::noise_normal_reference : kernels::noise_normal)(words_ + skip, drawn, deviates_);
    words = words_ + skip;
    deviates = deviates_;
    if (drawn_ == channels_) return;
    for (std::size_t i = 0; i < count_; ++i) {
      spread_words_[i] = words[i / static_cast<std::size_t>(channels_)];
      if (normal) spread_deviates_[i] = deviates[i / static_cast<std::size_t>(channels_)];
    }
    words = spread_words_;
    deviates = spread_deviates_;
  }

  const std::uint32_t* words = nullptr;
  const float* deviates = nullptr;

 private:
  const NoiseOptions& options_;
  int channels_;
  int drawn_;  ///< words a pixel
  bool reference_;
  std::size_t count_;  ///< values
  std::uint32_t* words_;
  float* deviates_;
  std::uint32_t* spread_words_;
  float* spread_deviates_;
};

/// What becomes of one value of a color. `unit` stands for an intensity of 1: alpha, of premultiplied color.
template <class T>
T noisy(const NoiseOptions& options, T value, float unit, std::uint32_t word, float deviate) {
  switch (options.kind) {
    case NoiseKind::SaltPepper: {
      // Words below `lost`, of 2³², are lost; the lower half of them to black.
      const auto lost = static_cast<std::uint64_t>(static_cast<double>(options.amount) * 0x1p32);
      return word >= lost ? value : static_cast<T>(word < lost / 2 ? 0.0F : unit);
    }
    case NoiseKind::Poisson: {
      const double events = 1 / (static_cast<double>(options.amount) * static_cast<double>(options.amount));
      const double mean = static_cast<double>(value) / static_cast<double>(unit) * events;
      if (!(mean > 0 && mean < 1e15)) return value;
      const double counted = kernels::poisson_count(mean, word, deviate) / events * static_cast<double>(unit);
      return kernels::noise_stored<T>(static_cast<float>(counted), unit);
    }
    case NoiseKind::Speckle: return kernels::noise_added(value, deviate, 0.0F, options.amount, unit);
    default: return kernels::noise_added(value, deviate, options.amount * unit, 0.0F, unit);
  }
}

class Noise final : public TileNode {
 public:
  Noise(const NoiseOptions& options, std::span<const ImageInfo> sources) : TileNode(sources), options_(options) {
    set_results({sources[0]});
  }

  void run(std::span<const ConstTile> from, std::span<const Tile> results, const TileContext& context) const override {
    add(from[0], results[0], context.scratch, false);
  }
  void run_reference(std::span<const ConstTile> from, std::span<const Tile> results,
                     const TileContext& context) const override {
    add(from[0], results[0], context.scratch, true);
  }

 private:
  void add(const ConstTile& from, const Tile& to, Scratch& scratch, bool reference) const {
    if (options_.amount == 0) {
      if (from.pixels.data != to.pixels.data) copy_pixels(from.pixels, to.pixels);
      return;
    }
    const ImageInfo& info = to.pixels.info;
    const bool added = options_.kind == NoiseKind::Gaussian || options_.kind == NoiseKind::Speckle;
    RowNoise row(options_, info, to.rect.width, reference, scratch);
    visit(to.pixels, [&](auto result) {
      using T = std::remove_pointer_t<decltype(result.data)>;
      for (int y = 0; y < result.height; ++y) {
        row.draw(to.rect.x, to.rect.y + y, options_.kind != NoiseKind::SaltPepper);
        const T* const source = from.pixels.as<T>().row(y);
        if (reference || !added || info.alpha == AlphaState::Premultiplied) {
          each_value(info, source, result.row(y), row);
          continue;
        }
        const bool speckle = options_.kind == NoiseKind::Speckle;
        kernels::noise_add(kernels::NoiseRow<T>{
            source, result.row(y), row.deviates,
            static_cast<std::size_t>(result.width) * static_cast<std::size_t>(result.channels),
            info.alpha == AlphaState::None ? 0 : result.channels,
            speckle ? 0.0F : options_.amount * full_range(info.type), speckle ? options_.amount : 0.0F});
      }
    });
  }

  template <class T>
  void each_value(const ImageInfo& info, const T* source, T* result, const RowNoise& row) const {
    const int colors = info.color_channels();
    const float full = full_range(info.type);
    const bool normal = options_.kind != NoiseKind::SaltPepper;
    std::size_t i = 0;
    for (int x = 0; x < info.width; ++x) {
      const T alpha = source[i + static_cast<std::size_t>(info.channels) - 1];
      const float unit = info.alpha == AlphaState::Premultiplied ? static_cast<float>(alpha) : full;
      for (int c = 0; c < info.channels; ++c, ++i) {
        result[i] = c < colors && unit != 0
                        ? noisy(options_, source[i], unit, row.words[i], normal ? row.deviates[i] : 0)
                        : source[i];
      }
    }
  }

  NoiseOptions options_;
};

}  // namespace

extern const Operation kNoise =
    with_examples(image_operation<NoiseOptions, Noise>(
                      "noise", "Adds noise.", {{"source", "the image"}}, {{"noisy", "the image with noise"}},
                      {field("kind", &NoiseOptions::kind, "how the noise is distributed"),
                       field("amount", &NoiseOptions::amount, {0, 1}, "",
                             "standard deviation; of salt_pepper, the share of values that are lost"),
                       field("seed", &NoiseOptions::seed, {0, 2147483647}, "", "other noise for each"),
                       field("monochrome", &NoiseOptions::monochrome, "all channels of a pixel get the same noise")}),
                  {{"photo.png noise:amount=0.1", "Gaussian noise, in each color by itself."},
                   {"photo.png noise:kind=salt_pepper,monochrome=true", "One pixel in twenty is black or white."},
                   {"photo.png noise:kind=poisson,amount=0.2", "Few photons: lights are noisier than shadows."}});

void noise(const ConstAnyView& source, const AnyView& result, const NoiseOptions& options, const Run& run) {
  apply_into(kNoise, &options, {source}, {result}, run);
}

Image noise(const Image& source, const NoiseOptions& options, const Run& run) {
  return std::move(apply(kNoise, &options, {&source}, run)[0]);
}

}  // namespace azulejo
