#include "azulejo/imaging/quantize.h"

#include <cstring>
#include <variant>

#include "azulejo/engine/operation.h"
#include "azulejo/imaging/dither_masks.h"
#include "azulejo/imaging/error_diffusion.h"

namespace azulejo {
namespace {

class Quantize final : public TileNode {
 public:
  Quantize(const QuantizeOptions& options, std::span<const ImageInfo> sources)
      : TileNode(sources), dither_(options.dither) {
    set_results({sources[0]});
    visit_type(sources[0].type,
               [&](auto zero) { levels_.emplace<QuantizeLevels<decltype(zero)>>(options, sources[0].color); });
    if (dither_ == Dither::FloydSteinberg) return;
    make_thresholds();
    if (sources[0].type == PixelType::U8 && sources[0].alpha == AlphaState::None) {
      bytes_ = std::make_unique<ByteLevels>(levels<std::uint8_t>());
      for (const float threshold : thresholds_) byte_thresholds_.push_back(bytes_->rank(threshold));
    }
  }

  bool needs_everything(int) const override { return dither_ == Dither::FloydSteinberg; }
  Rect needs(const Rect& result, int) const override { return needs_everything(0) ? sources()[0].rect() : result; }

  std::unique_ptr<Analysis> analysis(int) const override {
    if (dither_ != Dither::FloydSteinberg) return nullptr;
    return visit_type(sources()[0].type, [&](auto zero) -> std::unique_ptr<Analysis> {
      return std::make_unique<ErrorDiffusion<decltype(zero)>>(levels<decltype(zero)>(), sources()[0]);
    });
  }

  void run(std::span<const ConstTile> from, std::span<const Tile> results, const TileContext& context) const override {
    compute(from[0], results[0], context, false);
  }
  void run_reference(std::span<const ConstTile> from, std::span<const Tile> results,
                     const TileContext& context) const override {
    compute(from[0], results[0], context, true);
  }

 private:
  template <class T>
  const QuantizeLevels<T>& levels() const {
    return std::get<QuantizeLevels<T>>(levels_);
  }

  void compute(const ConstTile& from, const Tile& to, const TileContext& context, bool reference) const {
    visit(to.pixels, [&](auto result) {
      using T = std::remove_pointer_t<decltype(result.data)>;
      const auto source = from.pixels.as<T>();
      if (dither_ == Dither::FloydSteinberg) {
        return static_cast<const ErrorDiffusion<T>&>(*context.analyses[0]).take(source, to.rect, to.pixels, reference);
      }
      if constexpr (sizeof(T) == 1) {
        if (bytes_ && !reference) return compute_bytes(source, to, context.scratch);
      }
      const ImageInfo& info = to.pixels.info;
      const auto count = static_cast<std::size_t>(info.width) * static_cast<std::size_t>(info.channels);
      float* const thresholds = context.scratch.take<float>(count);
      for (int y = 0; y < info.height; ++y) {
        spread(thresholds_, to.rect.x, to.rect.y + y, info.channels, count, thresholds);
        if (levels<T>().curve() || info.alpha == AlphaState::Premultiplied) {
          each_value(info, source.row(y), thresholds, result.row(y));
          continue;
        }
        const kernels::QuantizeRow<T> row{
            source.row(y),     thresholds, result.row(y), count, info.alpha == AlphaState::None ? 0 : info.channels,
            levels<T>().last()};
        reference ? kernels::quantize_row_reference(row) : kernels::quantize_row(row);
      }
    });
  }

  void compute_bytes(const ImageView<const std::uint8_t>& source, const Tile& to, Scratch& scratch) const {
    const auto count = static_cast<std::size_t>(source.width) * static_cast<std::size_t>(source.channels);
    auto* const thresholds = scratch.take<std::uint8_t>(count);
    for (int y = 0; y < source.height; ++y) {
      spread(byte_thresholds_, to.rect.x, to.rect.y + y, source.channels, count, thresholds);
      kernels::quantize_bytes(bytes_->quantizer(), source.row(y), thresholds, count,
                              to.pixels.as<std::uint8_t>().row(y));
    }
  }

  void make_thresholds() {
    thresholds_ = {0.5F};
    if (dither_ == Dither::None) return;
    const DitherMask mask = dither_ == Dither::Ordered ? bayer_mask() : blue_noise_mask();
    thresholds_.clear();
    for (int y = 0; y < mask.size; ++y) {
      for (int x = 0; x < mask.size; ++x) thresholds_.push_back(mask.threshold(x, y));
    }
    side_ = mask.size;
  }

  /// The thresholds of a row's values from a column on.
  template <class V>
  void spread(const std::vector<V>& thresholds, int left, int y, int channels, std::size_t count, V* result) const {
    const V* const row = thresholds.data() + (y & (side_ - 1)) * side_;
    // The mask once, and copies of what is there.
    std::size_t first = 0;
    for (int x = 0; x < side_ && first < count; ++x) {
      const V threshold = row[(left + x) & (side_ - 1)];
      for (int c = 0; c < channels; ++c) result[first++] = threshold;
    }
    for (std::size_t i = first; i < count; i *= 2) {
      std::memcpy(result + i, result, std::min(i, count - i) * sizeof(V));
    }
  }

  template <class T>
  void each_value(const ImageInfo& info, const T* source, const float* thresholds, T* result) const {
    const int colors = info.color_channels();
    for (int x = 0; x < info.width; ++x) {
      const T alpha = colors < info.channels ? source[colors] : T{};
      for (int c = 0; c < colors; ++c) {
        const T value = straight_color(info, source[c], alpha);
        const float place = value != value ? 0.0F : levels<T>().place(value);
        result[c] = stored_color(info, kernels::quantized(value, place, thresholds[c], levels<T>().last()), alpha);
      }
      if (colors < info.channels) result[colors] = alpha;
      source += info.channels;
      result += info.channels;
      thresholds += info.channels;
    }
  }

  Dither dither_;
  int side_ = 1;                   ///< of the square of thresholds; a power of two
  std::vector<float> thresholds_;  ///< side_² of them
  std::unique_ptr<ByteLevels> bytes_;
  std::vector<std::uint8_t> byte_thresholds_;  ///< the same as ranks
  std::variant<std::monostate, QuantizeLevels<std::uint8_t>, QuantizeLevels<std::uint16_t>, QuantizeLevels<float>>
      levels_;
};

}  // namespace

extern const Operation kQuantize = with_examples(
    image_operation<QuantizeOptions, Quantize>(
        "quantize", "Leaves few intensities, with means kept by dithering.", {{"source", "the image"}},
        {{"quantized", "the same in a few levels of each channel"}},
        {field("levels", &QuantizeOptions::levels, {2, 256}, "", "intensities of each channel"),
         field("dither", &QuantizeOptions::dither, "how means are kept"),
         field("light", &QuantizeOptions::light, "what dithering keeps the mean of: stored values, or light")}),
    {{"gray.png quantize:dither=blue_noise,light=linear", "Black and white only; seen from afar it is the picture."},
     {"gray.png quantize:dither=ordered,light=linear", "Bayer's regular pattern."},
     {"gray.png quantize:dither=floyd_steinberg,light=linear", "Differences go on to the neighbors."},
     {"photo.png quantize:levels=4,dither=blue_noise", "Four levels of each color: 64 colors."}});

void quantize(const ConstAnyView& source, const AnyView& result, const QuantizeOptions& options, const Run& run) {
  apply_into(kQuantize, &options, {source}, {result}, run);
}

Image quantize(const Image& source, const QuantizeOptions& options, const Run& run) {
  return std::move(apply(kQuantize, &options, {&source}, run)[0]);
}

}  // namespace azulejo
