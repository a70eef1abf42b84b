#include "azulejo/imaging/convert.h"

#include "azulejo/engine/operation.h"
#include "azulejo/imaging/convert_kernels.h"
#include "azulejo/imaging/rows.h"
#include "azulejo/imaging/value_range.h"

namespace azulejo {
namespace {

class Convert final : public TileNode {
 public:
  Convert(const ConvertOptions& options, std::span<const ImageInfo> sources) : TileNode(sources), options_(options) {
    ImageInfo info = sources[0];
    info.type = options.type;
    set_results({info});
  }

  std::unique_ptr<Analysis> analysis(int) const override {
    return options_.normalize ? std::make_unique<ValueRange>(sources()[0]) : nullptr;
  }

  void run(std::span<const ConstTile> from, std::span<const Tile> results, const TileContext& context) const override {
    if (is_copy()) return copy_pixels(from[0].pixels, results[0].pixels);
    kernels::convert(from[0].pixels, results[0].pixels, stretch(context));
  }

  void run_reference(std::span<const ConstTile> from, std::span<const Tile> results,
                     const TileContext& context) const override {
    if (is_copy()) return copy_pixels(from[0].pixels, results[0].pixels);
    visit(from[0].pixels, [&](auto source) {
      visit(results[0].pixels, [&](auto result) { convert_pixels(source, result, stretch(context)); });
    });
  }

 private:
  bool is_copy() const { return !options_.normalize && options_.type == sources()[0].type; }

  Stretch stretch(const TileContext& context) const {
    if (!options_.normalize) return {};
    const auto& range = static_cast<const ValueRange&>(*context.analyses[0]);
    const float width = range.largest() - range.smallest();
    return {range.smallest(), width > 0 ? 1.0F / width : 0.0F, true};
  }

  template <class From, class To>
  void convert_pixels(const ImageView<const From>& source, const ImageView<To>& result, const Stretch& stretch) const {
    const Rescale rescale(kPixelTypeOf<From>, kPixelTypeOf<To>);
    const int colors = sources()[0].color_channels();
    const bool premultiplied = sources()[0].alpha == AlphaState::Premultiplied;
    for (int y = 0; y < result.height; ++y) {
      for (int x = 0; x < result.width; ++x) {
        const From* const pixel = &source(x, y);
        const auto alpha = static_cast<float>(pixel[result.channels - 1]);
        for (int c = 0; c < result.channels; ++c) {
          const auto value = static_cast<float>(pixel[c]);
          result(x, y, c) = rounded<To>(
              c < colors ? stretched(stretch, rescale, value, premultiplied ? &alpha : nullptr) : rescale(value));
        }
      }
    }
  }

  ConvertOptions options_;
};

}  // namespace

extern const Operation kConvert = with_examples(
    image_operation<ConvertOptions, Convert>(
        "convert", "Stores intensities in another pixel type.", {{"source", "the image"}},
        {{"converted", "the same in the other type"}},
        {field("type", &ConvertOptions::type, "pixel type of the result"),
         field("normalize", &ConvertOptions::normalize, "stretch: the smallest color becomes 0, the largest 1")}),
    {{"dark.png convert:type=u16,normalize=true", "An under-exposed picture uses the whole range of 16 bits."}});

void convert(const ConstAnyView& source, const AnyView& result, const ConvertOptions& options, const Run& run) {
  apply_into(kConvert, &options, {source}, {result}, run);
}

Image convert(const Image& source, const ConvertOptions& options, const Run& run) {
  return std::move(apply(kConvert, &options, {&source}, run)[0]);
}

}  // namespace azulejo
