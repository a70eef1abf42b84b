#include "azulejo/charting/chart.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "azulejo/charting/chart_parts.h"
#include "azulejo/charting/chart_text.h"
#include "azulejo/charting/color_bar.h"
#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"
#include "azulejo/imaging/histogram.h"

namespace azulejo {
namespace {

constexpr float kUsualRatio = 0.625F;  // height of a page ÷ width

/// A range that is given must rise, and be one that its axis can show.
void check_range(const std::optional<glm::vec2>& range, AxisScale scale, const char* name) {
  if (!range) return;
  if (!(range->x < range->y) || !std::isfinite(range->y - range->x)) {
    throw Error(Error::Argument, fmt::format("{}: {},{}, expected two rising numbers", name, range->x, range->y));
  }
  if (scale == AxisScale::Log && !(range->x > 0)) {
    throw Error(Error::Argument,
                fmt::format("{}: it begins at {}, expected more than 0 on a logarithmic axis", name, range->x));
  }
  const float largest = std::max(std::abs(range->x), std::abs(range->y));
  if (!(range->y - range->x >= 1e-6F * largest)) {
    throw Error(Error::Argument,
                fmt::format("{}: {} to {} is narrower than a millionth of its numbers", name, range->x, range->y));
  }
}

void check_options(const ChartOptions& options) {
  check_range(options.x_range, options.x_scale, "x_range");
  check_range(options.y_range, options.y_scale, "y_range");
  check_range(options.range, AxisScale::Linear, "range");
}

ChartField field_of(const Image& image, ChartKind kind) {
  if (image.info().color_channels() != 1) {
    throw Error(Error::Argument, fmt::format("{}: {}, expected one channel: grayscale or channels makes one",
                                             enum_names(kind)[static_cast<std::size_t>(kind)], describe(image.info())));
  }
  ChartField field;
  field.is_image = true;
  field.width = image.width();
  field.height = image.height();
  field.values.resize(static_cast<std::size_t>(field.width) * static_cast<std::size_t>(field.height));
  visit(image.any(), [&](const auto& view) {
    const float scale = 1 / full_range(image.type());
    std::size_t i = 0;
    for (int y = 0; y < field.height; ++y) {
      for (int x = 0; x < field.width; ++x) field.values[i++] = static_cast<float>(view(x, y)) * scale;
    }
  });
  return field;
}

ChartBins bins_of(const Image& image, const ChartOptions& options, const Run& run) {
  HistogramOptions asked;
  if (options.bins) asked.bins = *options.bins;
  const Histogram counted = histogram(image, asked, run);
  ChartBins bins;
  bins.names = counted.names;
  for (const auto& counts : counted.counts) bins.counts.emplace_back(counts.begin(), counts.end());
  return bins;
}

ChartKind kind_of(const CsvTable& table, const ChartOptions& options) {
  if (options.kind) return *options.kind;
  const bool words = options.x.empty() ? std::any_of(table.columns.begin(), table.columns.end(),
                                                     [](const CsvColumn& column) { return column.is_text(); })
                                       : table.column(options.x, "x").is_text();
  return words ? ChartKind::Bar : ChartKind::Line;
}

ChartContent content_of(const CsvTable& table, const ChartOptions& options, const Run& run) {
  switch (kind_of(table, options)) {
    case ChartKind::Line: return line_content(point_data(table, options), options, false);
    case ChartKind::Scatter: return line_content(point_data(table, options), options, true);
    case ChartKind::Bar: return bar_content(bar_data(table, options), options);
    case ChartKind::Histogram: {
      const ChartData data = value_data(table, options);
      return histogram_content(bin_values(data, options.bins.value_or(0), options.x_range), data.x_name, options);
    }
    case ChartKind::Heatmap: return heatmap_content(field_data(table, options), options);
    case ChartKind::Contour: return contour_content(field_data(table, options), options, run);
  }
  return {};
}

ChartContent content_of(const Image& image, const ChartOptions& options, const Run& run) {
  switch (options.kind.value_or(ChartKind::Histogram)) {
    case ChartKind::Histogram: return histogram_content(bins_of(image, options, run), "intensity", options);
    case ChartKind::Heatmap: return heatmap_content(field_of(image, ChartKind::Heatmap), options);
    case ChartKind::Contour: return contour_content(field_of(image, ChartKind::Contour), options, run);
    default: break;
  }
  throw Error(Error::Argument, fmt::format("kind: {} of an image, expected histogram, heatmap or contour",
                                           enum_names(*options.kind)[static_cast<std::size_t>(*options.kind)]));
}

PlotOptions page_of(const ChartContent& content, const ChartOptions& options) {
  PlotOptions page;
  page.width = static_cast<float>(options.width);
  page.height = static_cast<float>(
      options.height.value_or(static_cast<int>(std::lround(kUsualRatio * static_cast<float>(options.width)))));
  page.auto_height = !options.height;
  page.title = options.title;
  page.x = content.x;
  page.y = content.y;
  if (options.x_label) page.x.label = *options.x_label;
  if (options.y_label) page.y.label = *options.y_label;
  page.background = options.background;
  page.font_size = options.font_size;
  page.grid = options.grid && content.grid;
  page.square = content.square;
  return page;
}

}  // namespace

Drawing compose(ChartContent content, const ChartOptions& options, const Run& run) {
  PlotOptions page = page_of(content, options);
  ColorBar bar;
  if (content.bar) {
    bar = {content.bar->label, content.bar->low, content.bar->high, options.map};
    page.right_room = color_bar_width(bar, 0.7F * page.height, PlotSizes(page.font_size));
  }
  const bool wants_legend = options.legend ? *options.legend != ChartLegend::None : content.legend.size() > 1;
  const Legend legend(wants_legend ? std::move(content.legend) : std::vector<LegendEntry>(), page);
  std::optional<ChartLegend> place = options.legend;
  if (!legend.empty() && !place) {
    const Plot trial(page, {});
    Occupancy occupancy(trial.area);
    content.occupy(trial, occupancy);
    place = legend.clear_corner(trial, occupancy).value_or(ChartLegend::Right);
  }
  if (!legend.empty() && place == ChartLegend::Right) page.right_room += legend.size().x + page.font_size;
  Plot plot(page, run);
  content.draw(plot);
  if (!legend.empty()) legend.draw(plot, *place);
  if (content.bar) draw_color_bar(plot.drawing, plot.front, bar, plot.area, plot.sizes, plot.ink, run);
  return std::move(plot.drawing);
}

Drawing chart(const CsvTable& table, const ChartOptions& options, const Run& run) {
  check_options(options);
  return compose(content_of(table, options, run), options, run);
}

Drawing chart(const Image& image, const ChartOptions& options, const Run& run) {
  check_options(options);
  return compose(content_of(image, options, run), options, run);
}

}  // namespace azulejo
