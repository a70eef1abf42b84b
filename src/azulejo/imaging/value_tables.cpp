#include "azulejo/imaging/value_tables.h"

#include <fmt/format.h>

#include "azulejo/imaging/histogram_chart.h"
#include "azulejo/imaging/lookup.h"

namespace azulejo {

template <class T>
void report_tables(const ValueTables<T>& tables, const HistogramCounts<T>& counts, const StageReporter& reporter) {
  constexpr std::size_t kBins = ValueTables<T>::kBins;
  constexpr std::size_t kColumn = kBins / kChartWidth;  // bins of a column
  for (std::size_t t = 0; t < tables.size(); ++t) {
    const std::string channel = tables.size() == 1 ? "" : fmt::format("_{}", t);
    std::vector<double> before(kChartWidth), mapping(kChartWidth), after(kChartWidth);
    for (std::size_t v = 0; v < kBins; ++v) {
      const double mapped = tables.keeps(t)
                                ? static_cast<double>(v) / (kBins - 1)
                                : static_cast<double>(tables[t][v]) / static_cast<double>(full_range(kPixelTypeOf<T>));
      const auto bin = static_cast<std::size_t>(mapped * (kBins - 1) + 0.5);
      before[v / kColumn] += static_cast<double>(counts[t][v]);
      after[bin / kColumn] += static_cast<double>(counts[t][v]);
      mapping[v / kColumn] = mapped;
    }
    report_chart(reporter, "histogram_before" + channel, "counts", before);
    report_chart(reporter, "mapping" + channel, "values", mapping);
    report_chart(reporter, "histogram_after" + channel, "counts", after);
  }
}

template <class T>
void map_values_reference(const ValueTables<T>& tables, const ConstAnyView& source, const AnyView& result) {
  const ImageInfo& info = result.info;
  const int colors = info.color_channels();
  for (int y = 0; y < info.height; ++y) {
    const T* pixel = source.as<T>().row(y);
    T* place = result.as<T>().row(y);
    for (int x = 0; x < info.width; ++x, pixel += info.channels, place += info.channels) {
      const T alpha = info.alpha == AlphaState::None ? T{} : pixel[colors];
      for (int c = 0; c < colors; ++c) {
        const std::size_t table = tables.table_of(c);
        place[c] = info.alpha == AlphaState::Premultiplied ? tables.mapped(pixel[c], alpha, table)
                                                           : tables.mapped(pixel[c], table);
      }
      if (info.alpha != AlphaState::None) place[colors] = alpha;
    }
  }
}

template <class T>
void map_values(const ValueTables<T>& tables, const ConstAnyView& from, const AnyView& to) {
  if (to.info.alpha == AlphaState::Premultiplied) return map_values_reference(tables, from, to);
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
        kernels::lookup_bytes(row, out, static_cast<std::size_t>(count), tables[0].data());
        continue;
      }
    }
    for (int c = 0; c < channels; ++c) {
      if (c == colors || tables.keeps(tables.table_of(c))) {
        for (int i = c; i < count; i += channels) out[i] = row[i];
      } else {
        const T* const table = tables[tables.table_of(c)].data();
        for (int i = c; i < count; i += channels) out[i] = row[i] != row[i] ? row[i] : table[bin_of(row[i])];
      }
    }
  }
}

#define AZULEJO_VALUE_TABLES(T)                                                                        \
  template void report_tables(const ValueTables<T>&, const HistogramCounts<T>&, const StageReporter&); \
  template void map_values(const ValueTables<T>&, const ConstAnyView&, const AnyView&);                \
  template void map_values_reference(const ValueTables<T>&, const ConstAnyView&, const AnyView&);
AZULEJO_VALUE_TABLES(std::uint8_t)
AZULEJO_VALUE_TABLES(std::uint16_t)
AZULEJO_VALUE_TABLES(float)

}  // namespace azulejo
