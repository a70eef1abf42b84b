#include "azulejo/imaging/weighted_median.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"
#include "azulejo/imaging/rank_key.h"
#include "azulejo/imaging/weighted_median_kernels.h"

namespace azulejo {
namespace {

using kernels::WeightedTap;
using kernels::WeightedWindow;
using kernels::WindowTile;

constexpr int kMostSide = 65;
constexpr int kMostTotal = 32767;

void check_weights(const NumberGrid& weights) {
  const auto side = [](int count) { return count % 2 == 1 && count <= kMostSide; };
  if (!side(weights.rows) || !side(weights.columns)) {
    throw Error(Error::Argument, fmt::format("weights: {} rows of {} numbers, expected odd numbers up to {}",
                                             weights.rows, weights.columns, kMostSide));
  }
  double total = 0;
  for (const float weight : weights.values) {
    if (weight != std::floor(weight)) {
      throw Error(Error::Argument, fmt::format("weights: {}, expected whole numbers", weight));
    }
    total += weight;
  }
  if (total < 1 || total > kMostTotal) {
    throw Error(Error::Argument, fmt::format("weights: a sum of {}, expected 1 to {}", total, kMostTotal));
  }
}

class WeightedMedian final : public TileNode {
 public:
  WeightedMedian(const WeightedMedianOptions& options, std::span<const ImageInfo> sources)
      : TileNode(sources), options_(options) {
    const NumberGrid& weights = options.weights;
    check_weights(weights);
    set_results({sources[0]});
    for (int dy = 0; dy < weights.rows; ++dy) {
      for (int dx = 0; dx < weights.columns; ++dx) {
        const int weight = static_cast<int>(weights(dy, dx));
        if (weight == 0) continue;
        taps_.push_back({dx, dy, weight});
        total_ += weight;
      }
    }
  }

  Rect needs(const Rect& result, int) const override {
    return grown(result, options_.weights.columns / 2, options_.weights.rows / 2);
  }
  BorderRule border(int) const override { return {options_.border, options_.border_value}; }

  void run(std::span<const ConstTile> sources, std::span<const Tile> results,
           const TileContext& context) const override {
    visit(results[0].pixels, [&](auto result) {
      using T = std::remove_pointer_t<decltype(result.data)>;
      const auto source = sources[0].pixels.as<T>();
      const WindowTile<T> tile{source.data, source.stride, result.data, result.stride, result.width, result.height};
      const WeightedWindow window{options_.weights.columns, options_.weights.rows, taps_, total_};
      kernels::weighted_median_tile(tile, result.channels, window, context.scratch);
    });
  }

  void run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                     const TileContext&) const override {
    visit(results[0].pixels, [&](auto result) {
      using T = std::remove_pointer_t<decltype(result.data)>;
      const auto source = sources[0].pixels.as<T>();
      std::vector<std::pair<RankKey<T>, int>> window(taps_.size());
      for (int y = 0; y < result.height; ++y) {
        for (int i = 0; i < result.width * result.channels; ++i) {
          for (std::size_t k = 0; k < taps_.size(); ++k) {
            const WeightedTap& tap = taps_[k];
            window[k] = {rank_key(source.row(y + tap.dy)[i + tap.dx * source.channels]), tap.weight};
          }
          std::sort(window.begin(), window.end());
          std::size_t k = 0;
          for (int up_to = window[0].second; 2 * up_to < total_; up_to += window[k].second) ++k;
          result.row(y)[i] = ranked_value<T>(window[k].first);
        }
      }
    });
  }

 private:
  WeightedMedianOptions options_;
  std::vector<WeightedTap> taps_;
  int total_ = 0;
};

}  // namespace

extern const Operation kWeightedMedian = with_examples(
    image_operation<WeightedMedianOptions, WeightedMedian>(
        "weighted_median", "Takes the median of a window in which pixels count several times.",
        {{"source", "the image"}}, {{"result", "the filtered image"}},
        {field("weights", &WeightedMedianOptions::weights, {0, 1000}, "",
               "how many times each pixel of the window counts: whole numbers, odd numbers of rows and columns"),
         field("border", &WeightedMedianOptions::border, "what lies outside the image"),
         field("border_value", &WeightedMedianOptions::border_value, {0, 1}, "",
               "intensity outside, for border=constant")}),
    {{"noisy.png weighted_median", "Specks are gone, and fine lines stay that a plain median takes away."},
     {"noisy.png weighted_median:weights=0,1,0/1,1,1/0,1,0", "The median of a cross keeps corners."}});

void weighted_median(const ConstAnyView& source, const AnyView& result, const WeightedMedianOptions& options,
                     const Run& run) {
  apply_into(kWeightedMedian, &options, {source}, {result}, run);
}

Image weighted_median(const Image& source, const WeightedMedianOptions& options, const Run& run) {
  return std::move(apply(kWeightedMedian, &options, {&source}, run)[0]);
}

}  // namespace azulejo
