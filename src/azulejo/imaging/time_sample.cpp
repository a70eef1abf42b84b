#include "azulejo/imaging/time_sample.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"
#include "azulejo/imaging/rows.h"
#include "azulejo/imaging/sum_row_blocks.h"

namespace azulejo {
namespace {

class TimeSample final : public TileNode {
 public:
  TimeSample(const TimeSampleOptions& options, std::span<const ImageInfo> sources)
      : TileNode(sources), format_(row_format(sources[0], options.light)) {
    for (std::size_t i = 1; i < sources.size(); ++i) {
      if (sources[i] == sources[0]) continue;
      throw Error(Error::Argument, fmt::format("images: number {} is {}, expected {} as the first one", i + 1,
                                               describe(sources[i]), describe(sources[0])));
    }
    weigh(options, static_cast<double>(sources.size()));
    set_results({sources[0]});
  }

  /// Frames outside the interval are not looked at.
  Rect needs(const Rect& result, int source) const override {
    return source >= first_ && source < first_ + static_cast<int>(weights_.size()) ? result : Rect{};
  }

  void run(std::span<const ConstTile> from, std::span<const Tile> results, const TileContext& context) const override {
    integrate(from, results[0], context.scratch, false);
  }
  void run_reference(std::span<const ConstTile> from, std::span<const Tile> results,
                     const TileContext& context) const override {
    integrate(from, results[0], context.scratch, true);
  }

 private:
  void weigh(const TimeSampleOptions& options, double count) {
    const double begin = static_cast<double>(options.time);
    const double end = options.shutter ? begin + static_cast<double>(*options.shutter) : count;
    if (!(begin < count)) {
      throw Error(Error::Argument, fmt::format("time: {}, expected less than {}, the number of frames", begin, count));
    }
    if (end > count) {
      throw Error(Error::Argument,
                  fmt::format("shutter: open until {}, expected at most {}, the number of frames", end, count));
    }
    first_ = static_cast<int>(begin);
    weights_ = {1.0F};
    if (end == begin) return;
    weights_.clear();
    for (int i = first_; i < end; ++i) {
      weights_.push_back(static_cast<float>((std::min(i + 1.0, end) - std::max<double>(i, begin)) / (end - begin)));
    }
  }

  void integrate(std::span<const ConstTile> from, const Tile& to, Scratch& scratch, bool reference) const {
    const auto first = static_cast<std::size_t>(first_);
    if (weights_.size() == 1) {
      if (from[first].pixels.data != to.pixels.data) copy_pixels(from[first].pixels, to.pixels);
      return;
    }
    const int width = to.rect.width;
    float* const total = scratch.take<float>(format_.values(width));
    for (int y = 0; y < to.rect.height; ++y) {
      sum_row_blocks(weights_.data(), static_cast<int>(weights_.size()), format_.values(width), reference, scratch,
                     total, [&](int t, float* row) {
                       (reference ? load_row_reference : load_row)(
                           format_, from[first + static_cast<std::size_t>(t)].pixels.row(y), width, row);
                     });
      (reference ? store_row_reference : store_row)(format_, total, width, to.pixels.row(y));
    }
  }

  RowFormat format_;
  int first_ = 0;               ///< frame of the interval
  std::vector<float> weights_;  ///< of that and the next ones
};

}  // namespace

extern const Operation kTimeSample =
    with_examples(image_operation<TimeSampleOptions, TimeSample>(
                      "time_sample", "Samples frames in time: an instant, or what a shutter lets in.",
                      {{.name = "images", .help = "images of the same kind, in their order", .repeated = true}},
                      {{"exposure", "what is seen"}},
                      {field("time", &TimeSampleOptions::time, {0, 1e6}, "frames", "when the shutter opens"),
                       field("shutter", &TimeSampleOptions::shutter, {0, 1e6}, "frames",
                             "how long it is open; 0 is an instant; auto: to the end"),
                       field("light", &TimeSampleOptions::light, "what is integrated: light or stored values")}),
                  {{"photo.png later.png time_sample",
                    "The shutter is open while the orange rolls: half the time here, half there."}});

void time_sample(std::span<const ConstAnyView> frames, const AnyView& result, const TimeSampleOptions& options,
                 const Run& run) {
  apply_into(kTimeSample, &options, frames, {result}, run);
}

Image time_sample(std::span<const Image* const> frames, const TimeSampleOptions& options, const Run& run) {
  return std::move(apply(kTimeSample, &options, frames, run)[0]);
}

}  // namespace azulejo
