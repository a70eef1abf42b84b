#include "azulejo/imaging/invert.h"

#include "azulejo/engine/operation.h"
#include "azulejo/imaging/invert_kernels.h"
#include "azulejo/imaging/point.h"

namespace azulejo {
namespace {

class Invert final : public TileNode {
 public:
  Invert(const InvertOptions&, std::span<const ImageInfo> sources) : TileNode(sources) { set_results({sources[0]}); }

  void run(std::span<const ConstTile> from, std::span<const Tile> results, const TileContext&) const override {
    kernels::invert(from[0].pixels, results[0].pixels);
  }

  void run_reference(std::span<const ConstTile> from, std::span<const Tile> results,
                     const TileContext&) const override {
    const auto channels = static_cast<std::size_t>(sources()[0].channels);
    const auto colors = static_cast<std::size_t>(sources()[0].color_channels());
    const bool premultiplied = sources()[0].alpha == AlphaState::Premultiplied;
    for_rows(from[0].pixels, results[0].pixels, [&](auto* source, auto* result, std::size_t count, int) {
      using T = std::remove_pointer_t<decltype(result)>;
      for (std::size_t i = 0; i < count; i += channels) {
        const T whole = premultiplied ? source[i + colors] : static_cast<T>(full_range(kPixelTypeOf<T>));
        for (std::size_t c = 0; c < channels; ++c) {
          result[i + c] = c < colors ? kernels::inverted(source[i + c], whole) : source[i + c];
        }
      }
    });
  }
};

}  // namespace

extern const Operation kInvert =
    with_examples(image_operation<InvertOptions, Invert>("invert", "Makes the negative.", {{"source", "the image"}},
                                                         {{"negative", "dark where the source is bright"}}, {}),
                  {{"photo.png invert", "The negative: bright becomes dark, and each hue its complement."},
                   {"cutout.png invert", "What is transparent stays so."}});

void invert(const ConstAnyView& source, const AnyView& result, const InvertOptions& options, const Run& run) {
  apply_into(kInvert, &options, {source}, {result}, run);
}

Image invert(const Image& source, const InvertOptions& options, const Run& run) {
  return std::move(apply(kInvert, &options, {&source}, run)[0]);
}

}  // namespace azulejo
