#include "azulejo/imaging/match_histogram.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <numeric>

#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"
#include "azulejo/imaging/value_tables.h"

namespace azulejo {
namespace {

template <class T>
void match(std::span<const std::uint64_t> source, std::span<const std::uint64_t> reference, std::span<T> table) {
  const auto sum = [](auto counts) { return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}); };
  const auto all_source = static_cast<double>(sum(source));
  const auto all_reference = static_cast<double>(sum(reference));
  std::uint64_t below = 0;
  std::size_t z = 0;
  std::uint64_t up_to_z = reference[0];
  for (std::size_t v = 0; v < source.size(); ++v) {
    // G(z) < F(v), both times 2 · all_source · all_reference; z begins at the first value that occurs.
    const double rank = static_cast<double>(2 * below + source[v]) * all_reference;
    while (z + 1 < reference.size() && (up_to_z == 0 || 2 * static_cast<double>(up_to_z) * all_source < rank)) {
      up_to_z += reference[++z];
    }
    table[v] = std::is_same_v<T, float> ? static_cast<T>(static_cast<float>(z) / 65535.0F) : static_cast<T>(z);
    below += source[v];
  }
}

/// The histograms of one of the images; those of the source have the tables, too.
template <class T>
class MatchCounts final : public Analysis {
 public:
  MatchCounts(const ImageInfo& info, bool per_channel) : counts_(info, per_channel) {}

  void add(const ConstTile& tile, Scratch&) override { counts_.add(tile.pixels); }
  void merge(const Analysis& other) override { counts_.merge(static_cast<const MatchCounts&>(other).counts_); }
  void finish() override { counts_.finish(); }

  const HistogramCounts<T>& counts() const { return counts_; }
  /// Made at the first call, which has to wait until both images are counted.
  const ValueTables<T>& tables(const MatchCounts& reference) const {
    std::call_once(made_, [&] {
      tables_ = ValueTables<T>(counts_.size());
      for (std::size_t t = 0; t < counts_.size(); ++t) {
        const auto sees_nothing = [](auto seen) { return std::ranges::all_of(seen, [](auto n) { return n == 0; }); };
        if (sees_nothing(counts_[t]) || sees_nothing(reference.counts_[t])) tables_.keep(t);
        match(counts_[t], reference.counts_[t], tables_[t]);
      }
    });
    return tables_;
  }

 private:
  HistogramCounts<T> counts_;
  mutable std::once_flag made_;
  mutable ValueTables<T> tables_;
};

class MatchHistogram final : public TileNode {
 public:
  MatchHistogram(const MatchHistogramOptions& options, std::span<const ImageInfo> sources)
      : TileNode(sources), options_(options) {
    const ImageInfo& source = sources[0];
    const ImageInfo& reference = sources[1];
    if (source.type != reference.type || source.color != reference.color ||
        source.color_channels() != reference.color_channels()) {
      throw Error(Error::Argument,
                  fmt::format("reference: {}, expected pixel type, color state and color channels of source: {}",
                              describe(reference), describe(source)));
    }
    set_results({source});
  }

  /// The reference is only counted.
  Rect needs(const Rect& result, int source) const override { return source == 0 ? result : Rect{}; }

  std::unique_ptr<Analysis> analysis(int source) const override {
    const ImageInfo& info = sources()[static_cast<std::size_t>(source)];
    return visit_type(info.type, [&](auto zero) -> std::unique_ptr<Analysis> {
      return std::make_unique<MatchCounts<decltype(zero)>>(info, options_.per_channel);
    });
  }

  void run(std::span<const ConstTile> from, std::span<const Tile> results, const TileContext& context) const override {
    visit_type(sources()[0].type, [&](auto zero) {
      map_values(tables<decltype(zero)>(context.analyses), from[0].pixels, results[0].pixels);
    });
  }
  void run_reference(std::span<const ConstTile> from, std::span<const Tile> results,
                     const TileContext& context) const override {
    visit_type(sources()[0].type, [&](auto zero) {
      map_values_reference(tables<decltype(zero)>(context.analyses), from[0].pixels, results[0].pixels);
    });
  }

  void report_stages(std::span<const Analysis* const> analyses, const StageReporter& reporter) const override {
    visit_type(sources()[0].type, [&](auto zero) {
      report_tables(tables<decltype(zero)>(analyses), of<decltype(zero)>(*analyses[0]).counts(), reporter);
    });
  }

 private:
  template <class T>
  static const MatchCounts<T>& of(const Analysis& analysis) {
    return static_cast<const MatchCounts<T>&>(analysis);
  }
  template <class T>
  static const ValueTables<T>& tables(std::span<const Analysis* const> analyses) {
    return of<T>(*analyses[0]).tables(of<T>(*analyses[1]));
  }

  MatchHistogramOptions options_;
};

}  // namespace

extern const Operation kMatchHistogram = with_examples(
    image_operation<MatchHistogramOptions, MatchHistogram>(
        "match_histogram", "Gives an image the distribution of intensities of another.",
        {{"source", "the image"}, {"reference", "the image whose distribution is taken"}},
        {{"matched", "the source with the reference's histogram"}},
        {field("per_channel", &MatchHistogramOptions::per_channel,
               "a table for each color channel instead of one for all")}),
    {{"dark.png match_histogram:reference=photo.png", "The dark picture gets the light and the colors of the other."}});

void match_histogram(const ConstAnyView& source, const ConstAnyView& reference, const AnyView& result,
                     const MatchHistogramOptions& options, const Run& run) {
  apply_into(kMatchHistogram, &options, {source, reference}, {result}, run);
}

Image match_histogram(const Image& source, const Image& reference, const MatchHistogramOptions& options,
                      const Run& run) {
  return std::move(apply(kMatchHistogram, &options, {&source, &reference}, run)[0]);
}

}  // namespace azulejo
