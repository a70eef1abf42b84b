#include "azulejo/imaging/equalize.h"

#include <fmt/format.h>

#include "azulejo/engine/operation.h"
#include "azulejo/engine/stages.h"
#include "azulejo/imaging/equalize_tables.h"
#include "azulejo/imaging/histogram_chart.h"
#include "azulejo/imaging/lookup.h"

namespace azulejo {
namespace {

template <class T>
void report_tables(const EqualizeTables<T>& tables, const StageReporter& reporter) {
  constexpr std::size_t kBins = EqualizeTables<T>::kBins;
  constexpr std::size_t kColumn = kBins / kChartWidth;  // bins of a column
  for (std::size_t t = 0; t < tables.size(); ++t) {
    const std::string channel = tables.size() == 1 ? "" : fmt::format("_{}", t);
    std::vector<double> before(kChartWidth), mapping(kChartWidth), after(kChartWidth);
    for (std::size_t v = 0; v < kBins; ++v) {
      const double mapped = tables.constant(t) ? static_cast<double>(v) / (kBins - 1)
                                               : static_cast<double>(tables.table(t)[v]) /
                                                     static_cast<double>(full_range(kPixelTypeOf<T>));
      const auto bin = static_cast<std::size_t>(mapped * (kBins - 1) + 0.5);
      before[v / kColumn] += static_cast<double>(tables.counts(t)[v]);
      after[bin / kColumn] += static_cast<double>(tables.counts(t)[v]);
      mapping[v / kColumn] = mapped;
    }
    report_chart(reporter, "histogram_before" + channel, "counts", before);
    report_chart(reporter, "mapping" + channel, "values", mapping);
    report_chart(reporter, "histogram_after" + channel, "counts", after);
  }
}

/// Values that aren't premultiplied: from the table as they are.
template <class T>
void look_up(const ConstAnyView& from, const AnyView& to, const Analysis& analysis) {
  const auto& tables = static_cast<const EqualizeTables<T>&>(analysis);
  const auto source = from.as<T>();
  const auto result = to.as<T>();
  const int channels = result.channels;
  const int colors = to.info.color_channels();
  for (int y = 0; y < result.height; ++y) {
    const T* const row = source.row(y);
    T* const out = result.row(y);
    const int count = result.width * channels;
    if constexpr (sizeof(T) == 1) {
      if (tables.size() == 1 && colors == channels) {
        kernels::lookup_bytes(row, out, static_cast<std::size_t>(count), tables.table(0).data());
        continue;
      }
    }
    for (int c = 0; c < channels; ++c) {
      if (c == colors || tables.constant(tables.table_of(c))) {
        for (int i = c; i < count; i += channels) out[i] = row[i];
      } else {
        const T* const table = tables.table(tables.table_of(c)).data();
        for (int i = c; i < count; i += channels) out[i] = row[i] != row[i] ? row[i] : table[bin_of(row[i])];
      }
    }
  }
}

class Equalize final : public TileNode {
 public:
  Equalize(const EqualizeOptions& options, std::span<const ImageInfo> sources) : TileNode(sources), options_(options) {
    set_results({sources[0]});
  }

  std::unique_ptr<Analysis> analysis(int) const override {
    return visit_type(sources()[0].type, [&](auto zero) -> std::unique_ptr<Analysis> {
      return std::make_unique<EqualizeTables<decltype(zero)>>(sources()[0], options_.per_channel);
    });
  }

  void run(std::span<const ConstTile> from, std::span<const Tile> results, const TileContext& context) const override {
    if (sources()[0].alpha == AlphaState::Premultiplied) return run_reference(from, results, context);
    visit_type(sources()[0].type,
               [&](auto zero) { look_up<decltype(zero)>(from[0].pixels, results[0].pixels, *context.analyses[0]); });
  }

  void run_reference(std::span<const ConstTile> from, std::span<const Tile> results,
                     const TileContext& context) const override {
    visit(results[0].pixels, [&](auto result) {
      using T = std::remove_pointer_t<decltype(result.data)>;
      const auto& tables = static_cast<const EqualizeTables<T>&>(*context.analyses[0]);
      const auto source = from[0].pixels.as<T>();
      const ImageInfo& info = sources()[0];
      const int colors = info.color_channels();
      for (int y = 0; y < result.height; ++y) {
        for (int x = 0; x < result.width; ++x) {
          const T* const pixel = &source(x, y);
          T* const place = &result(x, y);
          const T alpha = info.alpha == AlphaState::None ? T{} : pixel[colors];
          for (int c = 0; c < colors; ++c) {
            const std::size_t table = tables.table_of(c);
            place[c] = info.alpha == AlphaState::Premultiplied ? tables.mapped(pixel[c], alpha, table)
                                                               : tables.mapped(pixel[c], table);
          }
          if (info.alpha != AlphaState::None) place[colors] = alpha;
        }
      }
    });
  }

  void report_stages(std::span<const Analysis* const> analyses, const StageReporter& reporter) const override {
    visit_type(sources()[0].type, [&](auto zero) {
      report_tables(static_cast<const EqualizeTables<decltype(zero)>&>(*analyses[0]), reporter);
    });
  }

 private:
  EqualizeOptions options_;
};

}  // namespace

extern const Operation kEqualize = image_operation<EqualizeOptions, Equalize>(
    "equalize", "Spreads intensities so that each is about as frequent.", {{"source", "the image"}},
    {{"equalized", "the same with an even histogram"}},
    {field("per_channel", &EqualizeOptions::per_channel, "a table for each color channel instead of one for all")});

void equalize(const ConstAnyView& source, const AnyView& result, const EqualizeOptions& options, const Run& run) {
  apply_into(kEqualize, &options, {source}, {result}, run);
}

Image equalize(const Image& source, const EqualizeOptions& options, const Run& run) {
  return std::move(apply(kEqualize, &options, {&source}, run)[0]);
}

}  // namespace azulejo
