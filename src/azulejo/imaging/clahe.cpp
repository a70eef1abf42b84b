#include "azulejo/imaging/clahe.h"

#include "azulejo/engine/operation.h"
#include "azulejo/engine/stages.h"
#include "azulejo/imaging/clahe_tables.h"
#include "azulejo/imaging/histogram_chart.h"
#include "azulejo/imaging/histogram_counts.h"

namespace azulejo {
namespace {

/// Maps a plane of the tile at `rect`.
template <class T, class Map>
void map_plane(const ClaheLayout& layout, const ClaheTables<T>& tables, int plane, const Rect& rect,
               const ImageView<const T>& source, const ImageView<T>& result, Scratch& scratch, Map map) {
  using Mapping = kernels::ClaheMapping<T>;
  auto* const memory = scratch.take<typename Mapping::Entry>(2 * Mapping::kEntries);
  for (const ClaheAxis::Stretch& rows : layout.down.stretches) {
    for (int y = std::max(rows.begin, rect.y); y < std::min(rows.end, rect.bottom()); ++y) {
      for (const ClaheAxis::Stretch& columns : layout.across.stretches) {
        const int begin = std::max(columns.begin, rect.x);
        const int end = std::min(columns.end, rect.right());
        if (begin >= end) continue;
        map(kernels::ClaheStretch<T>{
            source.row(y - rect.y) + (begin - rect.x),
            result.row(y - rect.y) + (begin - rect.x),
            static_cast<std::size_t>(end - begin),
            {tables.table(plane, rows.low, columns.low), tables.table(plane, rows.low, columns.high),
             tables.table(plane, rows.high, columns.low), tables.table(plane, rows.high, columns.high)},
            layout.down.weights[static_cast<std::size_t>(y)],
            layout.across.weights.data() + begin,
            memory});
      }
    }
  }
}

/// Writes what became of a plane into the pixels of a row, value by value.
template <class T>
void unite_row(const ClaheLayout& layout, int plane, const T* pixel, const T* before, const T* after, int pixels,
               T* result) {
  const int channels = layout.info.channels;
  const int colors = layout.info.color_channels();
  const bool premultiplied = layout.info.alpha == AlphaState::Premultiplied;
  for (int x = 0; x < pixels; ++x, pixel += channels, result += channels) {
    const T alpha = colors < channels ? pixel[colors] : T{};
    for (int c = 0; c < colors; ++c) {
      if (!layout.luma && c != plane) continue;
      if (premultiplied && alpha == T{0}) {
        result[c] = T{0};
        continue;
      }
      const T straight = premultiplied ? divided(pixel[c], alpha) : pixel[c];
      const T color = layout.luma ? kernels::clahe_shifted(straight, before[x], after[x]) : after[x];
      result[c] = premultiplied ? multiplied(color, alpha) : color;
    }
    if (colors < channels) result[colors] = alpha;
  }
}

class Clahe final : public TileNode {
 public:
  Clahe(const ClaheOptions& options, std::span<const ImageInfo> sources)
      : TileNode(sources), layout_(sources[0], options) {
    set_results({sources[0]});
  }

  std::unique_ptr<Analysis> analysis(int) const override {
    return visit_type(layout_.info.type, [&](auto zero) -> std::unique_ptr<Analysis> {
      return std::make_unique<ClaheTables<decltype(zero)>>(layout_);
    });
  }

  void run(std::span<const ConstTile> from, std::span<const Tile> results, const TileContext& context) const override {
    map_tile(from[0], results[0], context, false);
  }
  void run_reference(std::span<const ConstTile> from, std::span<const Tile> results,
                     const TileContext& context) const override {
    map_tile(from[0], results[0], context, true);
  }

  void report_stages(std::span<const Analysis* const> analyses, const StageReporter& reporter) const override {
    visit_type(layout_.info.type, [&](auto zero) {
      using Mapping = kernels::ClaheMapping<decltype(zero)>;
      const auto& tables = static_cast<const ClaheTables<decltype(zero)>&>(*analyses[0]);
      const int row = layout_.down.tiles() / 2;
      const int column = layout_.across.tiles() / 2;
      constexpr std::size_t kColumn = Mapping::kBins / kChartWidth;
      std::vector<double> counts(kChartWidth), values(kChartWidth);
      for (std::size_t b = 0; b < Mapping::kBins; ++b) {
        counts[b / kColumn] += static_cast<double>(tables.counts(0, row, column)[b]);
        values[b / kColumn] = static_cast<double>(tables.table(0, row, column)[b]) / (Mapping::kIsByte ? 255 * 128 : 1);
      }
      report_chart(reporter, "tile_histogram", "counts", counts);
      report_chart(reporter, "tile_mapping", "values", values);
    });
  }

 private:
  void map_tile(const ConstTile& from, const Tile& to, const TileContext& context, bool reference) const {
    visit(to.pixels, [&](auto result) {
      using T = std::remove_pointer_t<decltype(result.data)>;
      const auto& tables = static_cast<const ClaheTables<T>&>(*context.analyses[0]);
      Scratch& scratch = context.scratch;
      for (int p = 0; p < layout_.planes; ++p) {
        const auto before = clahe_plane<T>(layout_, from.pixels, p, scratch);
        ImageView<T> after = result;
        if (!layout_.direct) {
          const auto size = static_cast<std::size_t>(result.width) * static_cast<std::size_t>(result.height);
          after = {scratch.take<T>(size), result.width, result.height, 1, result.width};
        }
        map_plane<T>(layout_, tables, p, to.rect, before, after, scratch, [&](const kernels::ClaheStretch<T>& stretch) {
          reference ? kernels::clahe_map_reference(stretch) : kernels::clahe_map(stretch);
        });
        if (!layout_.direct) unite(from.pixels.as<T>(), p, before, after, result, reference);
      }
    });
  }

  template <class T>
  void unite(const ImageView<const T>& source, int plane, const ImageView<const T>& before, const ImageView<T>& after,
             const ImageView<T>& result, bool reference) const {
    const bool vectors = !reference && layout_.luma && layout_.info.alpha != AlphaState::Premultiplied;
    for (int y = 0; y < result.height; ++y) {
      if (vectors) {
        kernels::clahe_shift(kernels::ClaheShift<T>{source.row(y), before.row(y), after.row(y), result.row(y),
                                                    static_cast<std::size_t>(result.width), result.channels});
      } else {
        unite_row(layout_, plane, source.row(y), before.row(y), after.row(y), result.width, result.row(y));
      }
    }
  }

  ClaheLayout layout_;
};

}  // namespace

extern const Operation kClahe = with_examples(
    image_operation<ClaheOptions, Clahe>(
        "clahe", "Spreads intensities within each part of the image, with limited contrast.", {{"source", "the image"}},
        {{"equalized", "the same with even local histograms"}},
        {field("columns", &ClaheOptions::columns, {1, 32}, "", "tiles side by side"),
         field("rows", &ClaheOptions::rows, {1, 32}, "", "tiles above each other"),
         field("clip", &ClaheOptions::clip, {1, 1000}, "", "how many times the contrast may grow at most"),
         field("per_channel", &ClaheOptions::per_channel, "each color channel by itself instead of luma")}),
    {{"dark.png clahe:clip=4", "Shadows and lights both get contrast, as far as the limit allows."}});

void clahe(const ConstAnyView& source, const AnyView& result, const ClaheOptions& options, const Run& run) {
  apply_into(kClahe, &options, {source}, {result}, run);
}

Image clahe(const Image& source, const ClaheOptions& options, const Run& run) {
  return std::move(apply(kClahe, &options, {&source}, run)[0]);
}

}  // namespace azulejo
