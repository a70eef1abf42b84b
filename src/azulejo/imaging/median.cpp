#include "azulejo/imaging/median.h"

#include <algorithm>

#include "azulejo/engine/operation.h"
#include "azulejo/imaging/median_kernels.h"
#include "azulejo/imaging/rank_key.h"

namespace azulejo {
namespace {

using kernels::WindowTile;

template <class T>
void median_tile(const WindowTile<T>& tile, int channels, int radius, Scratch& scratch) {
  if (radius <= kernels::kNetworkRadius) return kernels::median_by_network(tile, channels, radius, scratch);
  if constexpr (std::is_same_v<T, std::uint8_t>) {
    if (radius <= kernels::kHistogramRadius) return kernels::median_by_histogram(tile, channels, radius, scratch);
  }
  kernels::median_by_walking(tile, channels, radius, scratch);
}

class Median final : public TileNode {
 public:
  Median(const MedianOptions& options, std::span<const ImageInfo> sources) : TileNode(sources), options_(options) {
    set_results({sources[0]});
  }

  Rect needs(const Rect& result, int) const override { return grown(result, options_.radius, options_.radius); }
  BorderRule border(int) const override { return {options_.border, options_.border_value}; }

  void run(std::span<const ConstTile> sources, std::span<const Tile> results,
           const TileContext& context) const override {
    if (options_.radius == 0) return copy_pixels(sources[0].pixels, results[0].pixels);
    visit(results[0].pixels, [&](auto result) {
      using T = std::remove_pointer_t<decltype(result.data)>;
      const auto source = sources[0].pixels.as<T>();
      const WindowTile<T> tile{source.data, source.stride, result.data, result.stride, result.width, result.height};
      median_tile(tile, result.channels, options_.radius, context.scratch);
    });
  }

  void run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                     const TileContext& context) const override {
    if (options_.radius == 0) return copy_pixels(sources[0].pixels, results[0].pixels);
    const int side = 2 * options_.radius + 1;
    visit(results[0].pixels, [&](auto result) {
      using T = std::remove_pointer_t<decltype(result.data)>;
      const auto source = sources[0].pixels.as<T>();
      const std::size_t count = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
      RankKey<T>* const window = context.scratch.take<RankKey<T>>(count);
      for (int y = 0; y < result.height; ++y) {
        for (int i = 0; i < result.width * result.channels; ++i) {
          RankKey<T>* next = window;
          for (int dy = 0; dy < side; ++dy) {
            for (int dx = 0; dx < side; ++dx) *next++ = rank_key(source.row(y + dy)[i + dx * source.channels]);
          }
          std::nth_element(window, window + count / 2, window + count);
          result.row(y)[i] = ranked_value<T>(window[count / 2]);
        }
      }
    });
  }

 private:
  MedianOptions options_;
};

}  // namespace

extern const Operation kMedian = with_examples(
    image_operation<MedianOptions, Median>(
        "median", "Takes the median of a square window.", {{"source", "the image"}}, {{"result", "the filtered image"}},
        {field("radius", &MedianOptions::radius, {0, 1000}, "px", "of the window, 2 · radius + 1 wide; 0 copies"),
         field("border", &MedianOptions::border, "what lies outside the image"),
         field("border_value", &MedianOptions::border_value, {0, 1}, "", "intensity outside, for border=constant")}),
    {{"noisy.png median", "Salt and pepper is gone; edges are where they were."},
     {"photo.png median:radius=8", "Large windows paint in flat patches with sharp edges."}});

void median(const ConstAnyView& source, const AnyView& result, const MedianOptions& options, const Run& run) {
  apply_into(kMedian, &options, {source}, {result}, run);
}

Image median(const Image& source, const MedianOptions& options, const Run& run) {
  return std::move(apply(kMedian, &options, {&source}, run)[0]);
}

}  // namespace azulejo
