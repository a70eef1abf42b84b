#include "azulejo/imaging/histogram.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"
#include "azulejo/imaging/channel_names.h"
#include "azulejo/imaging/histogram_counts.h"
#include "azulejo/math/transfer.h"

namespace azulejo {
namespace {

/// The counts of an image in the bins that are asked for.
class Counts : public Analysis {
 public:
  virtual Histogram binned(const ImageInfo& info, int bins) const = 0;
};

template <class T>
class TypedCounts final : public Counts {
 public:
  explicit TypedCounts(const ImageInfo& info) : counts_(info, true) {}
  void add(const ConstTile& tile, Scratch&) override { counts_.add(tile.pixels); }
  void merge(const Analysis& other) override { counts_.merge(static_cast<const TypedCounts&>(other).counts_); }
  void finish() override { counts_.finish(); }

  Histogram binned(const ImageInfo& info, int bins) const override {
    Histogram found;
    found.bins = bins;
    for (std::size_t c = 0; c < counts_.size(); ++c) {
      found.names.push_back(channel_name(info, static_cast<int>(c)));
      auto& counts = found.counts.emplace_back(static_cast<std::size_t>(bins), 0);
      for (std::size_t v = 0; v < HistogramCounts<T>::kBins; ++v) {
        counts[v * static_cast<std::size_t>(bins) / HistogramCounts<T>::kBins] += counts_[c][v];
      }
    }
    return found;
  }

 private:
  HistogramCounts<T> counts_;
};

using Shade = std::array<std::uint8_t, 3>;

/// What is behind a bar of a channel times this is what is seen.
Shade shade(std::size_t channel, std::size_t channels) {
  constexpr Shade kColors[] = {{235, 110, 105}, {105, 200, 110}, {100, 140, 245}};
  if (channels == 3) return kColors[channel];
  return channels == 1 ? Shade{75, 75, 80} : Shade{150, 150, 155};
}

/// Heights of a chart's columns, 0–1; a column is the highest of its bins.
std::vector<double> column_heights(const std::vector<std::uint64_t>& counts, const HistogramOptions& options) {
  const auto width = static_cast<std::size_t>(options.width);
  std::vector<double> columns(width, 0);
  std::vector<double> heights(counts.begin(), counts.end());
  if (options.cumulative) {
    for (std::size_t b = 1; b < heights.size(); ++b) heights[b] += heights[b - 1];
  }
  for (std::size_t x = 0; x < width; ++x) {
    const std::size_t first = x * heights.size() / width;
    const std::size_t last = std::max(first + 1, ((x + 1) * heights.size() + width - 1) / width);
    double highest = *std::max_element(heights.begin() + static_cast<std::ptrdiff_t>(first),
                                       heights.begin() + static_cast<std::ptrdiff_t>(last));
    if (options.logarithmic) highest = static_cast<double>(log2_deterministic(1.0F + static_cast<float>(highest)));
    columns[x] = highest;
  }
  return columns;
}

class HistogramNode final : public TileNode {
 public:
  HistogramNode(const HistogramOptions& options, std::span<const ImageInfo> sources)
      : TileNode(sources), options_(options) {
    if (sources[0].type == PixelType::U8 && options.bins > 256) {
      throw Error(Error::Argument, fmt::format("bins: {}, expected at most 256 for u8", options.bins));
    }
    set_results({ImageInfo{options.width, options.height, 3}});
  }

  Rect needs(const Rect&, int) const override { return {}; }

  std::unique_ptr<Analysis> analysis(int) const override {
    return visit_type(sources()[0].type, [&](auto zero) -> std::unique_ptr<Analysis> {
      return std::make_unique<TypedCounts<decltype(zero)>>(sources()[0]);
    });
  }

  static Histogram found(const ImageInfo& info, const Analysis& analysis, const HistogramOptions& options) {
    return static_cast<const Counts&>(analysis).binned(info, options.bins);
  }
  Report report(std::span<const Analysis* const> analyses) const override {
    return {to_json(found(sources()[0], *analyses[0], options_))};
  }

  void run(std::span<const ConstTile>, std::span<const Tile> results, const TileContext& context) const override {
    const Histogram histogram = found(sources()[0], *context.analyses[0], options_);
    std::vector<std::vector<double>> heights;
    double highest = 1e-300;
    for (const auto& counts : histogram.counts) {
      heights.push_back(column_heights(counts, options_));
      highest = std::max(highest, *std::ranges::max_element(heights.back()));
    }
    const Rect& rect = results[0].rect;
    const auto view = results[0].pixels.as<std::uint8_t>();
    for (int y = 0; y < rect.height; ++y) {
      std::fill_n(view.row(y), rect.width * 3, std::uint8_t{255});
      for (int x = 0; x < rect.width; ++x) {
        for (std::size_t c = 0; c < heights.size(); ++c) {
          const double share = heights[c][static_cast<std::size_t>(x + rect.x)] / highest;
          const int bar = share > 0 ? std::max(1, static_cast<int>(share * options_.height + 0.5)) : 0;
          if (options_.height - (y + rect.y) > bar) continue;
          const Shade color = shade(c, heights.size());
          for (int k = 0; k < 3; ++k) {
            view(x, y, k) = static_cast<std::uint8_t>((view(x, y, k) * color[static_cast<std::size_t>(k)] + 127) / 255);
          }
        }
      }
    }
  }
  void run_reference(std::span<const ConstTile> sources, std::span<const Tile> results,
                     const TileContext& context) const override {
    run(sources, results, context);
  }

 private:
  HistogramOptions options_;
};

}  // namespace

extern const Operation kHistogram = with_examples(
    image_operation<HistogramOptions, HistogramNode>(
        "histogram", "Counts how often values occur, and draws it.", {{"source", "the image"}},
        {{"report", "counts of each channel's bins", ValueKind::Report}, {"chart", "the same as bars"}},
        {field("bins", &HistogramOptions::bins, {1, 65536}, "", "equal parts of the range; of u8 at most 256"),
         field("logarithmic", &HistogramOptions::logarithmic, "bars grow with the logarithm of the count"),
         field("cumulative", &HistogramOptions::cumulative, "bars show how many values are not above"),
         field("width", &HistogramOptions::width, {16, 4096}, "px", "of the chart"),
         field("height", &HistogramOptions::height, {16, 4096}, "px", "of the chart")}),
    {{"photo.png histogram as:h @h.chart", "Where all channels have values, their colors make gray."},
     {"dark.png histogram as:h @h.chart", "An under-exposed picture: everything is at the left."}});

Histogram histogram(const ConstAnyView& source, const HistogramOptions& options, const Run& run) {
  Histogram counted;
  measure(kHistogram, &options, std::span(&source, 1), run, [&](std::span<const Analysis* const> analyses) {
    counted = HistogramNode::found(source.info, *analyses[0], options);
  });
  return counted;
}

Histogram histogram(const Image& source, const HistogramOptions& options, const Run& run) {
  return histogram(source.any(), options, run);
}

Image histogram_chart(const Image& source, const HistogramOptions& options, const Run& run) {
  return std::move(apply(kHistogram, &options, {&source}, run)[0]);
}

Json to_json(const Histogram& histogram) {
  Json channels = Json::array();
  for (std::size_t c = 0; c < histogram.counts.size(); ++c) {
    Json counts = Json::array();
    for (const std::uint64_t count : histogram.counts[c]) counts.push(count);
    channels.push(Json::object().set("channel", histogram.names[c]).set("counts", counts));
  }
  return Json::object().set("bins", histogram.bins).set("channels", channels);
}

}  // namespace azulejo
