#include "azulejo/imaging/threshold.h"

#include "azulejo/engine/operation.h"
#include "azulejo/imaging/threshold_kernels.h"

namespace azulejo {
namespace {

class Threshold final : public Node {
 public:
  Threshold(const ThresholdOptions& options, std::span<const ImageInfo> sources) : Node(sources), options_(options) {
    set_results({sources[0]});
  }

  void run(std::span<const ConstTile> sources, std::span<const Tile> results, const TileContext&) const override {
    rows(sources[0], results[0], [](auto... arguments) { kernels::threshold_row(arguments...); });
  }

  void run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                     const TileContext&) const override {
    rows(sources[0], results[0], [](auto* source, auto* result, std::size_t count, int period, auto level, auto above, auto below) {
      for (std::size_t i = 0; i < count; ++i) {
        const bool alpha = period > 0 && static_cast<int>(i) % period == period - 1;
        result[i] = alpha ? source[i] : source[i] > level ? above : below;
      }
    });
  }

 private:
  template <class RowKernel>
  void rows(const ConstTile& source, const Tile& result, RowKernel kernel) const {
    visit(result.pixels, [&](auto view) {
      using T = std::remove_pointer_t<decltype(view.data)>;
      const auto top = static_cast<T>(full_range(kPixelTypeOf<T>));
      const auto level = static_cast<T>(options_.level * full_range(kPixelTypeOf<T>));  // integers: v > x is v > floor(x)
      const int period = result.pixels.info.alpha == AlphaState::None ? 0 : view.channels;
      const auto count = static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.channels);
      for (int y = 0; y < view.height; ++y) {
        kernel(source.pixels.as<T>().row(y), view.row(y), count, period, level, options_.invert ? T{0} : top,
               options_.invert ? top : T{0});
      }
    });
  }

  ThresholdOptions options_;
};

}  // namespace

extern const Operation kThreshold = image_operation<ThresholdOptions, Threshold>(
    "threshold", "Marks what is brighter than a level.",
    {{"source", "the image"}}, {{"mask", "full range where the source is above the level, 0 elsewhere"}},
    {field("level", &ThresholdOptions::level, {0, 1}, "", "intensity above which a value is foreground"),
     field("invert", &ThresholdOptions::invert, "foreground is what is not above the level")});

void threshold(const ConstAnyView& source, const AnyView& result, const ThresholdOptions& options, const Run& run) {
  apply_into(kThreshold, &options, {source}, {result}, run);
}

Image threshold(const Image& source, const ThresholdOptions& options, const Run& run) {
  return std::move(apply(kThreshold, &options, {&source}, run)[0]);
}

}  // namespace azulejo
