#include "azulejo/imaging/exposure.h"

#include <algorithm>
#include <numeric>

#include "azulejo/engine/operation.h"
#include "azulejo/engine/stages.h"
#include "azulejo/imaging/tone_analysis.h"
#include "azulejo/imaging/tone_functions.h"

namespace azulejo {
namespace {

constexpr float kMiddleGray = 0.18F;
constexpr float kMostStops = 8;
constexpr float kWrongStops = 1;      // what the verdict takes for a wrong exposure
constexpr float kLowContrast = 0.5F;  // of the range
constexpr double kMuchClipped = 0.1;  // of the values

float correction(float median_light, float high_light) {
  const auto stops_to = [](float light, float target) {
    constexpr float kDarkest = 0x1p-20F;  // beyond the most stops
    return log2_deterministic(target / std::max(light, kDarkest));
  };
  const float to_gray = stops_to(median_light, kMiddleGray);
  const float room = std::max(0.0F, stops_to(high_light, 1));
  return std::clamp(std::min(to_gray, room), -kMostStops, kMostStops);
}

Tones gain_tones(float stops, ColorState color) {
  const float gain = exp2_deterministic(stops);
  if (color == ColorState::Srgb) return one_tone<GainTone>(GainFunction{gain});
  return one_tone<LinearTone>(LinearFunction{.scale = gain});
}

Json json_of(const ExposureVerdict& verdict) {
  return Json::object()
      .set("exposure", enum_names(Exposure{})[static_cast<std::size_t>(verdict.exposure)])
      .set("contrast", enum_names(Contrast{})[static_cast<std::size_t>(verdict.contrast)])
      .set("stops", verdict.stops)
      .set("low", verdict.low)
      .set("median", verdict.median)
      .set("high", verdict.high)
      .set("black", verdict.black)
      .set("white", verdict.white);
}

ExposureVerdict verdict_of(const Analysis& analysis, ColorState color) {
  return judge_exposure(static_cast<const ToneAnalysis&>(analysis).histograms()[0], color);
}

class Expose final : public TileNode {
 public:
  Expose(const ExposureOptions& options, std::span<const ImageInfo> sources) : TileNode(sources) {
    if (options.stops) map_.emplace(sources[0], gain_tones(*options.stops, sources[0].color));
    set_results({sources[0]});
  }

  std::unique_ptr<Analysis> analysis(int) const override { return map_ ? nullptr : gathered(); }
  std::unique_ptr<Analysis> result_analysis(int) const override { return gathered(); }

  Report report(std::span<const Analysis* const> analyses) const override {
    const ColorState color = sources()[0].color;
    const ExposureVerdict after = verdict_of(*analyses[1], color);
    Report report;
    if (analyses[0] != nullptr) report.json.set("before", json_of(verdict_of(*analyses[0], color)));
    report.json.set("after", json_of(after));
    report.verdict = after.exposure == Exposure::Good && after.contrast == Contrast::Good;
    return report;
  }

  void run(std::span<const ConstTile> from, std::span<const Tile> results, const TileContext& context) const override {
    map(context.analyses).run(from[0].pixels, results[0].pixels, context.scratch);
  }

  void run_reference(std::span<const ConstTile> from, std::span<const Tile> results,
                     const TileContext& context) const override {
    map(context.analyses).run_reference(from[0].pixels, results[0].pixels);
  }

  void report_stages(std::span<const Analysis* const> analyses, const StageReporter& reporter) const override {
    if (map_) return;
    reporter.report("verdict", json_of(verdict_of(*analyses[0], sources()[0].color)));
  }

 private:
  std::unique_ptr<Analysis> gathered() const {
    return ToneAnalysis::make(sources()[0], false, [color = sources()[0].color](std::span<const LevelCounts> all) {
      return gain_tones(judge_exposure(all[0], color).stops, color);
    });
  }

  const ToneMap& map(std::span<const Analysis* const> analyses) const {
    return map_ ? *map_ : static_cast<const ToneAnalysis&>(*analyses[0]).map();
  }

  std::optional<ToneMap> map_;  ///< of the given stops
};

}  // namespace

extern const Operation kExposure =
    with_examples(image_operation<ExposureOptions, Expose>(
                      "exposure", "Multiplies light, as a longer exposure would have.", {{"source", "the image"}},
                      {{"corrected", "the same with more or less light"},
                       {.name = "verdict",
                        .help = "whether exposure and contrast are good, before (with stops=auto) and after",
                        .kind = ValueKind::Report,
                        .on_request = true}},
                      {field("stops", &ExposureOptions::stops, {-16, 16}, "",
                             "doublings of light; auto: the median becomes middle gray, highlights stay below white")}),
                  {{"dark.png exposure", "An under-exposed picture gets the light that its histogram has room for."},
                   {"photo.png exposure:stops=-1.5", "Less than half the light."}});

ExposureVerdict judge_exposure(const Image& source, const Run& run) {
  ExposureVerdict verdict;
  const ExposureOptions options;
  const ConstAnyView view = source.any();
  measure(kExposure, &options, std::span(&view, 1), run,
          [&](std::span<const Analysis* const> analyses) { verdict = verdict_of(*analyses[0], source.info().color); });
  return verdict;
}

ExposureVerdict judge_exposure(std::span<const std::uint64_t> counts, ColorState color) {
  ExposureVerdict verdict;
  const auto all = static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}));
  if (all == 0) return verdict;
  const auto intensity = [&](std::size_t step) {
    return static_cast<float>(step) / static_cast<float>(counts.size() - 1);
  };
  const PercentileSteps most = percentile_steps(counts, 0.01, 0.99);
  verdict.low = intensity(most.low);
  verdict.median = intensity(percentile_steps(counts, 0.5, 1).low);
  verdict.high = intensity(most.high);
  verdict.black = static_cast<double>(counts.front()) / all;
  verdict.white = static_cast<double>(counts.back()) / all;
  const auto light = [&](float v) { return color == ColorState::Srgb ? srgb_to_linear(v) : v; };
  verdict.stops = correction(light(verdict.median), light(verdict.high));
  if (verdict.stops >= kWrongStops) verdict.exposure = Exposure::Under;
  if (verdict.stops <= -kWrongStops) verdict.exposure = Exposure::Over;
  if (verdict.high - verdict.low <= kLowContrast) verdict.contrast = Contrast::Low;
  if (verdict.black + verdict.white >= kMuchClipped) verdict.contrast = Contrast::High;
  return verdict;
}

void exposure(const ConstAnyView& source, const AnyView& result, const ExposureOptions& options, const Run& run) {
  apply_into(kExposure, &options, {source}, {result}, run);
}

Image exposure(const Image& source, const ExposureOptions& options, const Run& run) {
  return std::move(apply(kExposure, &options, {&source}, run)[0]);
}

}  // namespace azulejo
