#include "azulejo/imaging/tone_analysis.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "azulejo/imaging/histogram_counts.h"

namespace azulejo {
namespace {

template <class T>
class Made final : public ToneAnalysis {
 public:
  Made(const ImageInfo& info, bool per_channel, MakeTones make_tones)
      : info_(info), counts_(info, per_channel), make_tones_(std::move(make_tones)) {}

  void add(const ConstTile& tile, Scratch&) override { counts_.add(tile.pixels); }
  void merge(const Analysis& other) override { counts_.merge(static_cast<const Made&>(other).counts_); }
  void finish() override {
    counts_.finish();
    for (std::size_t t = 0; t < counts_.size(); ++t) histograms_.push_back(counts_[t]);
    map_.emplace(info_, make_tones_(histograms_));
  }

  const std::vector<LevelCounts>& histograms() const override { return histograms_; }
  const ToneMap& map() const override { return *map_; }

 private:
  ImageInfo info_;
  HistogramCounts<T> counts_;
  MakeTones make_tones_;
  std::vector<LevelCounts> histograms_;
  std::optional<ToneMap> map_;
};

}  // namespace

std::unique_ptr<ToneAnalysis> ToneAnalysis::make(const ImageInfo& info, bool per_channel, MakeTones make_tones) {
  return visit_type(info.type, [&](auto zero) -> std::unique_ptr<ToneAnalysis> {
    return std::make_unique<Made<decltype(zero)>>(info, per_channel, std::move(make_tones));
  });
}

PercentileSteps percentile_steps(LevelCounts counts, double low, double high) {
  const auto all = static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}));
  if (all == 0) return {};
  PercentileSteps steps{0, counts.size() - 1};
  std::uint64_t up_to = counts[0];
  while (steps.low + 1 < counts.size() && static_cast<double>(up_to) <= low * all) up_to += counts[++steps.low];
  std::uint64_t from = counts.back();
  while (steps.high > 0 && static_cast<double>(from) <= (1 - high) * all) from += counts[--steps.high];
  steps.high = std::max(steps.low, steps.high);
  return steps;
}

LinearFunction line_between(const PercentileSteps& steps, std::size_t count) {
  if (steps.low == steps.high) return {};
  const auto last = static_cast<float>(count - 1);
  const float black = static_cast<float>(steps.low) / last;
  const float white = static_cast<float>(steps.high) / last;
  const float scale = 1.0F / (white - black);
  return {.scale = scale, .offset = -(black * scale), .low = 0, .high = 1};
}

}  // namespace azulejo
