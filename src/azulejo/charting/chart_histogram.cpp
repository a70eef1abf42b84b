#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>
#include <utility>

#include "azulejo/charting/chart_parts.h"

namespace azulejo {
namespace {

constexpr int kMostAutoBins = 200;

/// Source  D. Freedman, P. Diaconis, On the histogram as a density estimator, 1981; where the middle half is one value,
///         H. Sturges, The choice of a class interval, 1926
int auto_bins(std::vector<double> values, double span) {
  const std::size_t count = values.size();
  if (count < 2) return 1;
  const auto quantile = [&](std::size_t numerator) {
    const auto place = values.begin() + static_cast<std::ptrdiff_t>((count - 1) * numerator / 4);
    std::nth_element(values.begin(), place, values.end());
    return *place;
  };
  const double width = 2 * (quantile(3) - quantile(1)) / std::cbrt(static_cast<double>(count));
  const double bins = width > 0 ? std::ceil(span / width) : std::ceil(std::log2(static_cast<double>(count))) + 1;
  return static_cast<int>(std::clamp(bins, 1.0, static_cast<double>(kMostAutoBins)));
}

glm::vec4 color_of(const ChartBins& bins, std::size_t series, ChartPalette palette) {
  const std::string& name = bins.names[series];
  if (name == "red") return {0.84F, 0.18F, 0.15F, 1};
  if (name == "green") return {0.10F, 0.60F, 0.25F, 1};
  if (name == "blue") return {0.12F, 0.35F, 0.80F, 1};
  if (name == "gray") return {0.40F, 0.40F, 0.42F, 1};
  return series_color(palette, series);
}

/// The upper edge of a histogram's bars, from left to right.
Path outline(const Plot& plot, const ChartBins& bins, std::size_t series, double floor, bool closed) {
  const std::vector<double>& counts = bins.counts[series];
  Path path;
  const auto edge = [&](std::size_t i) {
    return bins.low + (bins.high - bins.low) * static_cast<double>(i) / static_cast<double>(counts.size());
  };
  const auto go = [&](double x, double y) {
    const glm::vec2 point = bounded(plot.at(x, std::max(y, floor)));
    path.commands.empty() ? path.move_to(point) : path.line_to(point);
  };
  if (closed) go(edge(0), floor);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    go(edge(i), counts[i]);
    go(edge(i + 1), counts[i]);
  }
  if (closed) {
    go(edge(counts.size()), floor);
    path.close();
  }
  return path;
}

}  // namespace

ChartBins bin_values(const ChartData& data, int bins, const std::optional<glm::vec2>& range) {
  ChartBins result;
  std::vector<double> all;
  for (const ChartSeries& series : data.series) {
    for (const double value : series.y) {
      if (std::isfinite(value)) all.push_back(value);
    }
  }
  Extent extent = extent_of(all, AxisScale::Linear);
  if (range) extent = {range->x, range->y};
  AxisOptions axis;
  fit_range(axis, extent, 0);
  result.low = range ? range->x : axis.low;
  result.high = range ? range->y : axis.high;
  if (bins == 0) bins = auto_bins(std::move(all), result.high - result.low);
  const double scale = bins / (result.high - result.low);
  for (const ChartSeries& series : data.series) {
    std::vector<double> counts(static_cast<std::size_t>(bins), 0);
    for (const double value : series.y) {
      if (!(value >= result.low && value <= result.high)) continue;
      const auto bin = static_cast<std::size_t>((value - result.low) * scale);
      counts[std::min(bin, counts.size() - 1)] += 1;  // the upper end is in the last
    }
    result.counts.push_back(std::move(counts));
    result.names.push_back(series.name);
  }
  return result;
}

ChartContent histogram_content(ChartBins bins, std::string x_name, const ChartOptions& options) {
  ChartContent content;
  content.x.label = std::move(x_name);
  content.y.label = "count";
  content.x.low = bins.low;
  content.x.high = bins.high;
  if (options.x_range)
    std::tie(content.x.low, content.x.high) = std::pair<double, double>(options.x_range->x, options.x_range->y);
  content.y.scale = options.y_scale;
  const bool log = options.y_scale == AxisScale::Log;
  Extent extent;
  extent.add(log ? 0.5 : 0);
  for (const std::vector<double>& counts : bins.counts) {
    for (const double count : counts) {
      if (count > 0) extent.add(count);
    }
  }
  if (!log && extent.high == 0) extent.add(1);
  choose_range(content.y, extent, options.y_range, log ? 0 : 0.04);
  const double floor = log ? content.y.low : 0;
  const bool several = bins.counts.size() > 1;
  const auto look = [options, several](const glm::vec4& color) {
    DrawingStyle style = filled(several ? glm::vec4(color.x, color.y, color.z, 0.25F) : color);
    return style;
  };
  for (std::size_t s = 0; s < bins.counts.size(); ++s) {
    const glm::vec4 color = color_of(bins, s, options.palette);
    LegendEntry entry{bins.names[s], LegendEntry::Box, look(color)};
    if (several) entry.style.stroke = Paint(color);
    content.legend.push_back(std::move(entry));
  }
  const auto shared = std::make_shared<const ChartBins>(std::move(bins));
  content.occupy = [shared, floor](const Plot& plot, Occupancy& occupancy) {
    for (std::size_t s = 0; s < shared->counts.size(); ++s) {
      const std::vector<double>& counts = shared->counts[s];
      const double width = (shared->high - shared->low) / static_cast<double>(counts.size());
      for (std::size_t i = 0; i < counts.size(); ++i) {
        const double left = shared->low + width * static_cast<double>(i);
        const glm::vec2 low = plot.at(left, floor);
        const glm::vec2 high = plot.at(left + width, std::max(counts[i], floor));
        occupancy.add_box({{low.x, high.y}, {high.x, low.y}});
      }
    }
  };
  content.draw = [shared, floor, look, several, options](Plot& plot) {
    Drawing& drawing = plot.drawing;
    for (std::size_t s = 0; s < shared->counts.size(); ++s) {
      const glm::vec4 color = color_of(*shared, s, options.palette);
      drawing.add_path(outline(plot, *shared, s, floor, true), drawing.add_style(look(color)), shared->names[s],
                       plot.data);
    }
    for (std::size_t s = 0; several && s < shared->counts.size(); ++s) {
      const glm::vec4 color = color_of(*shared, s, options.palette);
      drawing.add_path(outline(plot, *shared, s, floor, false),
                       drawing.add_style(stroked(color, 0.75F * options.line_width)), shared->names[s], plot.data);
    }
  };
  return content;
}

}  // namespace azulejo
