#include "azulejo/imaging/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "azulejo/engine/operation.h"
#include "azulejo/imaging/channel_names.h"
#include "azulejo/imaging/histogram_counts.h"
#include "azulejo/math/exact_sum.h"

namespace azulejo {
namespace {

constexpr std::size_t kSteps = 256;

/// Counts of values in order, and what stands for each bin.
struct Distribution {
  std::vector<std::uint64_t> counts;
  std::int64_t total = 0;

  /// The first bin at which `percent` of the values are reached.
  std::size_t bin(double percent) const {
    const double wanted = std::max(1.0, std::ceil(percent / 100 * static_cast<double>(total)));
    double sum = 0;
    for (std::size_t b = 0; b < counts.size(); ++b) {
      sum += static_cast<double>(counts[b]);
      if (sum >= wanted) return b;
    }
    return counts.size() - 1;
  }
};

double entropy(const std::array<std::uint64_t, kSteps>& counts, std::int64_t total) {
  double bits = 0;
  for (const std::uint64_t count : counts) {
    if (count == 0) continue;
    const double share = static_cast<double>(count) / static_cast<double>(total);
    bits -= share * std::log2(share);
  }
  return bits;
}

/// What is gathered of an image, whatever its type.
class Measures : public Analysis {
 public:
  virtual ChannelStatistics channel(int index, const StatisticsOptions& options) const = 0;
  virtual ChannelStatistics all(const StatisticsOptions& options) const = 0;
};

/// Integers: everything is in their histograms.
template <class T>
class WholeMeasures final : public Measures {
 public:
  explicit WholeMeasures(const ImageInfo& info) : counts_(info, true) {}
  void add(const ConstTile& tile, Scratch&) override { counts_.add(tile.pixels); }
  void merge(const Analysis& other) override { counts_.merge(static_cast<const WholeMeasures&>(other).counts_); }
  void finish() override { counts_.finish(); }

  ChannelStatistics channel(int index, const StatisticsOptions& options) const override {
    const auto counts = counts_[static_cast<std::size_t>(index)];
    return measured({counts.begin(), counts.end()}, options);
  }
  ChannelStatistics all(const StatisticsOptions& options) const override {
    std::vector<std::uint64_t> sums(HistogramCounts<T>::kBins, 0);
    for (std::size_t c = 0; c < counts_.size(); ++c) {
      std::ranges::transform(sums, counts_[c], sums.begin(), std::plus<>());
    }
    return measured(std::move(sums), options);
  }

 private:
  static ChannelStatistics measured(std::vector<std::uint64_t> counts, const StatisticsOptions& options) {
    Distribution values{std::move(counts)};
    constexpr double kTop = std::is_same_v<T, std::uint8_t> ? 255 : 65535;
    // Sums of squares of 16 bits fit 64 up to 2³² pixels; beyond, doubles do.
    double sum = 0;
    for (std::size_t v = 0; v < values.counts.size(); ++v) {
      values.total += static_cast<std::int64_t>(values.counts[v]);
      sum += static_cast<double>(values.counts[v]) * static_cast<double>(v);
    }
    ChannelStatistics found;
    found.count = values.total;
    found.percentiles.assign(options.percentiles.size(), 0);
    if (values.total == 0) return found;
    const auto total = static_cast<double>(values.total);
    const double mean = sum / total;
    double squares = 0;
    std::array<std::uint64_t, kSteps> steps{};
    for (std::size_t v = 0; v < values.counts.size(); ++v) {
      const double distance = static_cast<double>(v) - mean;
      squares += static_cast<double>(values.counts[v]) * distance * distance;
      steps[v * kSteps / values.counts.size()] += values.counts[v];
    }
    found.mean = mean / kTop;
    found.standard_deviation = std::sqrt(squares / total) / kTop;
    found.entropy = entropy(steps, values.total);
    found.minimum = static_cast<double>(values.bin(0)) / kTop;
    found.maximum = static_cast<double>(values.bin(100)) / kTop;
    for (std::size_t p = 0; p < options.percentiles.size(); ++p) {
      found.percentiles[p] = static_cast<double>(values.bin(options.percentiles[p])) / kTop;
    }
    return found;
  }

  HistogramCounts<T> counts_;
};

/// Sums, and counts by the upper 16 bits of the value, in the order of values.
struct FloatChannel {
  std::vector<std::uint64_t> counts = std::vector<std::uint64_t>(65536, 0);
  std::array<std::uint64_t, kSteps> steps{};
  ExactSum sum;
  ExactSum squares;
  ExactSum large_squares;  ///< in units of 2¹³⁰
  std::int64_t not_finite = 0;
  float minimum = std::numeric_limits<float>::infinity();
  float maximum = -std::numeric_limits<float>::infinity();

  /// Order of the bits of floats as of the numbers.
  static std::uint32_t ordered(std::uint32_t bits) { return bits >> 31 != 0 ? ~bits : bits | 0x80000000U; }

  void add(float value) {
    if (!(std::fabs(value) <= std::numeric_limits<float>::max())) {
      ++not_finite;
      return;
    }
    ++counts[ordered(std::bit_cast<std::uint32_t>(value)) >> 16];
    ++steps[std::min(kSteps - 1, static_cast<std::size_t>(std::clamp(value, 0.0F, 1.0F) * kSteps))];
    minimum = std::min(minimum, value);
    maximum = std::max(maximum, value);
    sum.add(value);
    // A product of two floats is a double, and that a sum of two floats: of large ones, one with a smaller exponent.
    const bool large = std::fabs(value) > 0x1p60F;
    const double square = double{value} * value * (large ? 0x1p-130 : 1);
    const auto high = static_cast<float>(square);
    ExactSum& sum_of_squares = large ? large_squares : squares;
    sum_of_squares.add(high);
    sum_of_squares.add(static_cast<float>(square - double{high}));
  }
  void merge(const FloatChannel& other) {
    std::ranges::transform(counts, other.counts, counts.begin(), std::plus<>());
    std::ranges::transform(steps, other.steps, steps.begin(), std::plus<>());
    sum.merge(other.sum);
    squares.merge(other.squares);
    large_squares.merge(other.large_squares);
    not_finite += other.not_finite;
    minimum = std::min(minimum, other.minimum);
    maximum = std::max(maximum, other.maximum);
  }

  ChannelStatistics measured(const StatisticsOptions& options) const {
    Distribution values{counts};
    for (const std::uint64_t count : counts) values.total += static_cast<std::int64_t>(count);
    ChannelStatistics found;
    found.count = values.total;
    found.not_finite = not_finite;
    found.percentiles.assign(options.percentiles.size(), 0);
    if (values.total == 0) return found;
    const auto total = static_cast<double>(values.total);
    found.mean = sum.value() / total;
    const double square_sum = squares.value() + large_squares.value() * 0x1p130;
    found.standard_deviation = std::sqrt(std::max(0.0, square_sum / total - found.mean * found.mean));
    found.entropy = entropy(steps, values.total);
    found.minimum = static_cast<double>(minimum);
    found.maximum = static_cast<double>(maximum);
    for (std::size_t p = 0; p < options.percentiles.size(); ++p) {
      // The middle of the bin.
      const std::uint32_t key = static_cast<std::uint32_t>(values.bin(options.percentiles[p])) << 16 | 0x8000;
      const float middle = std::bit_cast<float>(key >> 31 != 0 ? key & 0x7FFFFFFFU : ~key);
      found.percentiles[p] = static_cast<double>(std::clamp(middle, minimum, maximum));
    }
    return found;
  }
};

class FloatMeasures final : public Measures {
 public:
  explicit FloatMeasures(const ImageInfo& info)
      : info_(info), channels_(static_cast<std::size_t>(info.color_channels())) {}

  void add(const ConstTile& tile, Scratch&) override {
    const auto view = tile.pixels.as<float>();
    const int colors = info_.color_channels();
    for (int y = 0; y < view.height; ++y) {
      const float* pixel = view.row(y);
      for (int x = 0; x < view.width; ++x, pixel += view.channels) {
        const float alpha = info_.alpha == AlphaState::None ? 1.0F : pixel[colors];
        if (alpha == 0) continue;
        for (int c = 0; c < colors; ++c) {
          channels_[static_cast<std::size_t>(c)].add(info_.alpha == AlphaState::Premultiplied ? pixel[c] / alpha
                                                                                              : pixel[c]);
        }
      }
    }
  }
  void merge(const Analysis& other) override {
    const auto& theirs = static_cast<const FloatMeasures&>(other).channels_;
    for (std::size_t c = 0; c < channels_.size(); ++c) channels_[c].merge(theirs[c]);
  }

  ChannelStatistics channel(int index, const StatisticsOptions& options) const override {
    return channels_[static_cast<std::size_t>(index)].measured(options);
  }
  ChannelStatistics all(const StatisticsOptions& options) const override {
    FloatChannel sum;
    for (const FloatChannel& each : channels_) sum.merge(each);
    return sum.measured(options);
  }

 private:
  ImageInfo info_;
  std::vector<FloatChannel> channels_;
};

class StatisticsNode final : public TileNode {
 public:
  StatisticsNode(const StatisticsOptions& options, std::span<const ImageInfo> sources)
      : TileNode(sources), options_(options) {}

  std::unique_ptr<Analysis> analysis(int) const override {
    const ImageInfo& info = sources()[0];
    if (info.type == PixelType::U8) return std::make_unique<WholeMeasures<std::uint8_t>>(info);
    if (info.type == PixelType::U16) return std::make_unique<WholeMeasures<std::uint16_t>>(info);
    return std::make_unique<FloatMeasures>(info);
  }

  static Statistics found(const ImageInfo& info, const Analysis& analysis, const StatisticsOptions& options) {
    const auto& measures = static_cast<const Measures&>(analysis);
    Statistics found;
    for (int c = 0; c < info.color_channels(); ++c) {
      found.channels.push_back(measures.channel(c, options));
      found.channels.back().name = channel_name(info, c);
    }
    found.all = measures.all(options);
    found.all.name = "all";
    return found;
  }

  Report report(std::span<const Analysis* const> analyses) const override {
    return {to_json(found(sources()[0], *analyses[0], options_), options_)};
  }

  void run(std::span<const ConstTile>, std::span<const Tile>, const TileContext&) const override {}
  void run_reference(std::span<const ConstTile>, std::span<const Tile>, const TileContext&) const override {}

 private:
  StatisticsOptions options_;
};

Json json_of(const ChannelStatistics& channel, const StatisticsOptions& options) {
  Json percentiles = Json::object();
  for (std::size_t p = 0; p < options.percentiles.size(); ++p) {
    percentiles.set(fmt::format("{}", options.percentiles[p]), channel.percentiles[p]);
  }
  return Json::object()
      .set("channel", channel.name)
      .set("count", channel.count)
      .set("not_finite", channel.not_finite)
      .set("minimum", channel.minimum)
      .set("maximum", channel.maximum)
      .set("mean", channel.mean)
      .set("standard_deviation", channel.standard_deviation)
      .set("entropy", channel.entropy)
      .set("percentiles", percentiles);
}

}  // namespace

extern const Operation kStatistics = with_examples(
    image_operation<StatisticsOptions, StatisticsNode>(
        "statistics", "Measures the values of an image.", {{"source", "the image"}},
        {{"report", "extrema, mean, deviation, entropy, percentiles of each channel and of all", ValueKind::Report}},
        {field("percentiles", &StatisticsOptions::percentiles, {0, 100}, "%", "values that so many are not above")}),
    {{"dark.png statistics:percentiles=1,50,99", "The picture is dark: its median is far below 0.5."}});

Statistics statistics(const ConstAnyView& source, const StatisticsOptions& options, const Run& run) {
  Statistics found;
  measure(kStatistics, &options, std::span(&source, 1), run, [&](std::span<const Analysis* const> analyses) {
    found = StatisticsNode::found(source.info, *analyses[0], options);
  });
  return found;
}

Statistics statistics(const Image& source, const StatisticsOptions& options, const Run& run) {
  return statistics(source.any(), options, run);
}

Json to_json(const Statistics& statistics, const StatisticsOptions& options) {
  Json channels = Json::array();
  for (const ChannelStatistics& each : statistics.channels) channels.push(json_of(each, options));
  return Json::object().set("channels", channels).set("all", json_of(statistics.all, options));
}

}  // namespace azulejo
