#include "azulejo/imaging/contrast_stretch.h"

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"
#include "azulejo/engine/stages.h"
#include "azulejo/imaging/histogram_chart.h"
#include "azulejo/imaging/tone_analysis.h"
#include "azulejo/imaging/tone_functions.h"

namespace azulejo {
namespace {

class ContrastStretch final : public TileNode {
 public:
  ContrastStretch(const ContrastStretchOptions& options, std::span<const ImageInfo> sources)
      : TileNode(sources), options_(options) {
    if (!(options.low < options.high)) {
      throw Error(Error::Argument, fmt::format("low: {}, expected less than high: {}", options.low, options.high));
    }
    set_results({sources[0]});
  }

  std::unique_ptr<Analysis> analysis(int) const override {
    return ToneAnalysis::make(sources()[0], options_.per_channel, [this](std::span<const LevelCounts> histograms) {
      Tones tones;
      for (const LevelCounts& each : histograms) tones.push_back(std::make_unique<LinearTone>(line(each)));
      return tones;
    });
  }

  void run(std::span<const ConstTile> from, std::span<const Tile> results, const TileContext& context) const override {
    analysis_of(context.analyses).map().run(from[0].pixels, results[0].pixels, context.scratch);
  }

  void run_reference(std::span<const ConstTile> from, std::span<const Tile> results,
                     const TileContext& context) const override {
    analysis_of(context.analyses).map().run_reference(from[0].pixels, results[0].pixels);
  }

  void report_stages(std::span<const Analysis* const> analyses, const StageReporter& reporter) const override {
    const auto& histograms = analysis_of(analyses).histograms();
    for (std::size_t t = 0; t < histograms.size(); ++t) {
      const LevelCounts& counts = histograms[t];
      const std::string channel = histograms.size() == 1 ? "" : fmt::format("_{}", t);
      std::vector<double> columns(kChartWidth);
      for (std::size_t v = 0; v < counts.size(); ++v) {
        columns[v * columns.size() / counts.size()] += static_cast<double>(counts[v]);
      }
      report_chart(reporter, "histogram_before" + channel, "counts", columns);
      const PercentileSteps levels = percentiles(counts);
      const auto last = static_cast<double>(counts.size() - 1);
      reporter.report("levels" + channel, Json::object()
                                              .set("black", static_cast<double>(levels.low) / last)
                                              .set("white", static_cast<double>(levels.high) / last));
    }
  }

 private:
  static const ToneAnalysis& analysis_of(std::span<const Analysis* const> analyses) {
    return static_cast<const ToneAnalysis&>(*analyses[0]);
  }

  PercentileSteps percentiles(LevelCounts counts) const {
    return percentile_steps(counts, static_cast<double>(options_.low) / 100, static_cast<double>(options_.high) / 100);
  }

  LinearFunction line(LevelCounts counts) const { return line_between(percentiles(counts), counts.size()); }

  ContrastStretchOptions options_;
};

}  // namespace

extern const Operation kContrastStretch = with_examples(
    image_operation<ContrastStretchOptions, ContrastStretch>(
        "contrast_stretch", "Spreads intensities over the whole range.", {{"source", "the image"}},
        {{"stretched", "the same, black at the low percentile and white at the high one"}},
        {field("low", &ContrastStretchOptions::low, {0, 100}, "%", "share of values that may become black"),
         field("high", &ContrastStretchOptions::high, {0, 100}, "%",
               "share of values up to the one that becomes white"),
         field("per_channel", &ContrastStretchOptions::per_channel,
               "a line for each color channel instead of one for all")}),
    {{"dark.png contrast_stretch", "A dull picture gets the whole range, all but its darkest and brightest percent."},
     {"dark.png contrast_stretch:low=0,high=100,per_channel=true",
      "From the smallest to the largest value of each channel by itself."}});

void contrast_stretch(const ConstAnyView& source, const AnyView& result, const ContrastStretchOptions& options,
                      const Run& run) {
  apply_into(kContrastStretch, &options, {source}, {result}, run);
}

Image contrast_stretch(const Image& source, const ContrastStretchOptions& options, const Run& run) {
  return std::move(apply(kContrastStretch, &options, {&source}, run)[0]);
}

}  // namespace azulejo
