#include "azulejo/imaging/false_color.h"

#include <fmt/format.h>

#include <array>
#include <vector>

#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"
#include "azulejo/imaging/channels_kernels.h"
#include "azulejo/imaging/tone_analysis.h"
#include "azulejo/imaging/tone_functions.h"

namespace azulejo {
namespace {

/// The image and the channel of a band.
TakenChannel band(const char* name, int number, std::span<const ImageInfo> sources) {
  int first = 1;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    const int bands = sources[s].color_channels();
    if (number < first + bands) return {.source = static_cast<int>(s), .channel = number - first};
    first += bands;
  }
  throw Error(Error::Argument, fmt::format("{}: {}, expected a band from 1 to {}", name, number, first - 1));
}

class FalseColor final : public TileNode {
 public:
  FalseColor(const FalseColorOptions& options, std::span<const ImageInfo> sources)
      : TileNode(sources),
        options_(options),
        taken_{band("red", options.red, sources), band("green", options.green, sources),
               band("blue", options.blue, sources)} {
    if (!(options.low < options.high)) {
      throw Error(Error::Argument, fmt::format("low: {}, expected less than high: {}", options.low, options.high));
    }
    for (const ImageInfo& each : sources) {
      if (each.rect() != sources[0].rect() || each.type != sources[0].type) {
        throw Error(Error::Argument,
                    fmt::format("sources: {}, expected size and type of {}", describe(each), describe(sources[0])));
      }
    }
    ImageInfo info = sources[0];
    info.channels = 3;
    info.alpha = AlphaState::None;
    info.color = ColorState::Srgb;
    set_results({info});
  }

  std::unique_ptr<Analysis> analysis(int source) const override {
    if (!is_used(source)) return nullptr;
    return ToneAnalysis::make(
        sources()[static_cast<std::size_t>(source)], true, [this](std::span<const LevelCounts> histograms) {
          Tones tones;
          for (const LevelCounts& each : histograms) {
            const PercentileSteps steps = percentile_steps(each, static_cast<double>(options_.low) / 100,
                                                           static_cast<double>(options_.high) / 100);
            tones.push_back(std::make_unique<LinearTone>(line_between(steps, each.size())));
          }
          return tones;
        });
  }

  void run(std::span<const ConstTile> from, std::span<const Tile> results, const TileContext& context) const override {
    stretch(from, results[0].pixels, context,
            [&](const ToneMap& map, const ConstAnyView& source, const AnyView& stretched) {
              map.run(source, stretched, context.scratch);
            });
  }

  void run_reference(std::span<const ConstTile> from, std::span<const Tile> results,
                     const TileContext& context) const override {
    stretch(from, results[0].pixels, context,
            [](const ToneMap& map, const ConstAnyView& source, const AnyView& stretched) {
              map.run_reference(source, stretched);
            });
  }

 private:
  bool is_used(int source) const {
    return taken_[0].source == source || taken_[1].source == source || taken_[2].source == source;
  }

  /// The sources that are used, stretched by `map_tile`, and of those the bands.
  template <class MapTile>
  void stretch(std::span<const ConstTile> from, const AnyView& result, const TileContext& context,
               MapTile map_tile) const {
    std::vector<ConstAnyView> stretched(from.size());
    for (std::size_t s = 0; s < from.size(); ++s) {
      if (!is_used(static_cast<int>(s))) continue;
      const ImageInfo& info = from[s].pixels.info;
      const std::size_t row = info.row_bytes();
      const AnyView view(context.scratch.take<std::byte>(row * static_cast<std::size_t>(info.height)),
                         static_cast<std::ptrdiff_t>(row), info);
      map_tile(static_cast<const ToneAnalysis&>(*context.analyses[s]).map(), from[s].pixels, view);
      stretched[s] = view;
    }
    kernels::take_channels(stretched, taken_, result);
  }

  FalseColorOptions options_;
  std::array<TakenChannel, 3> taken_;
};

}  // namespace

extern const Operation kFalseColor = with_examples(
    image_operation<FalseColorOptions, FalseColor>(
        "false_color", "Shows three bands as red, green and blue.",
        {{.name = "sources", .help = "one image or several, of one size and pixel type", .repeated = true}},
        {{"colored", "the bands, each stretched by itself"}},
        {field("red", &FalseColorOptions::red, {1, 100'000}, "",
               "band shown as red, counted from 1 through all images"),
         field("green", &FalseColorOptions::green, {1, 100'000}, "", "band shown as green"),
         field("blue", &FalseColorOptions::blue, {1, 100'000}, "", "band shown as blue"),
         field("low", &FalseColorOptions::low, {0, 100}, "%", "share of a band's values that may become black"),
         field("high", &FalseColorOptions::high, {0, 100}, "%", "share of values up to the one that becomes full")}),
    {{"photo.png false_color:red=3,green=1,blue=2", "What was blue is seen as red, red as green, green as blue."},
     {"photo.png other.png false_color:red=1,green=4,blue=5",
      "Bands of two pictures in one: red of the first, red and green of the second."}});

void false_color(std::span<const ConstAnyView> sources, const AnyView& result, const FalseColorOptions& options,
                 const Run& run) {
  apply_into(kFalseColor, &options, sources, {result}, run);
}

Image false_color(std::span<const Image* const> sources, const FalseColorOptions& options, const Run& run) {
  return std::move(apply(kFalseColor, &options, sources, run)[0]);
}

}  // namespace azulejo
