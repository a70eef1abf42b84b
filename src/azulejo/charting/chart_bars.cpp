#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "azulejo/charting/chart_parts.h"

namespace azulejo {
namespace {

constexpr double kGroupWidth = 0.8;  // of the distance of categories

/// A bar in values: from `from` to `to` along `left` to `right` of the axis of categories.
struct BarPlace {
  std::size_t series = 0;
  double left = 0;
  double right = 0;
  double from = 0;
  double to = 0;
};

/// floor  where bars begin: 0, or the lower end of a logarithmic axis
std::vector<BarPlace> place_bars(const ChartData& data, bool stacked, double floor) {
  std::vector<BarPlace> bars;
  const std::size_t count = data.categories.size();
  const auto many = static_cast<double>(data.series.size());
  const double width = stacked ? kGroupWidth : kGroupWidth / many;
  std::vector<double> above(count, 0);
  std::vector<double> below(count, 0);
  for (std::size_t s = 0; s < data.series.size(); ++s) {
    for (std::size_t i = 0; i < count; ++i) {
      const double value = data.series[s].y[i];
      if (!std::isfinite(value)) continue;
      const double middle = static_cast<double>(i);
      const double left = middle - 0.5 * kGroupWidth + (stacked ? 0 : width * static_cast<double>(s));
      BarPlace bar{s, left, left + width, floor, value};
      if (stacked) {
        double& edge = value < 0 ? below[i] : above[i];
        bar.from = edge == 0 ? floor : edge;
        edge += value;
        bar.to = edge;
      }
      bars.push_back(bar);
    }
  }
  return bars;
}

Box2 box_of(const Plot& plot, const BarPlace& bar, bool horizontal) {
  const glm::vec2 a = bounded(horizontal ? plot.at(bar.from, bar.left) : plot.at(bar.left, bar.from));
  const glm::vec2 b = bounded(horizontal ? plot.at(bar.to, bar.right) : plot.at(bar.right, bar.to));
  return {{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}};
}

}  // namespace

ChartContent bar_content(ChartData data, const ChartOptions& options) {
  ChartContent content;
  AxisOptions& along = options.horizontal ? content.y : content.x;
  AxisOptions& up = options.horizontal ? content.x : content.y;
  along.categories = data.categories;
  along.low = -0.5;
  along.high = std::max(0.5, static_cast<double>(data.categories.size()) - 0.5);
  along.label = data.x_name;
  // The first category is on top.
  along.reversed = options.horizontal;
  const std::optional<glm::vec2>& along_asked = options.horizontal ? options.y_range : options.x_range;
  if (along_asked) std::tie(along.low, along.high) = std::pair<double, double>(along_asked->x, along_asked->y);
  up.label = data.y_name;
  up.scale = options.horizontal ? options.x_scale : options.y_scale;
  const bool log = up.scale == AxisScale::Log;
  Extent extent;
  for (const BarPlace& bar : place_bars(data, options.stacked, 0)) {
    if (!log || bar.to > 0) extent.add(bar.to);
  }
  if (!log) extent.add(0);
  choose_range(up, extent, options.horizontal ? options.x_range : options.y_range, 0.04);
  for (std::size_t s = 0; s < data.series.size(); ++s) {
    content.legend.push_back({data.series[s].name, LegendEntry::Box, filled(series_color(options.palette, s))});
  }
  const auto bars = std::make_shared<const std::vector<BarPlace>>(place_bars(data, options.stacked, log ? up.low : 0));
  const auto shared = std::make_shared<const ChartData>(std::move(data));
  const bool horizontal = options.horizontal;
  content.occupy = [bars, horizontal](const Plot& plot, Occupancy& occupancy) {
    for (const BarPlace& bar : *bars) occupancy.add_box(box_of(plot, bar, horizontal));
  };
  content.draw = [bars, shared, horizontal, palette = options.palette](Plot& plot) {
    std::vector<Path> paths(shared->series.size());
    for (const BarPlace& bar : *bars) {
      const Path box = rectangle(box_of(plot, bar, horizontal));
      Path& path = paths[bar.series];
      path.commands.insert(path.commands.end(), box.commands.begin(), box.commands.end());
      path.points.insert(path.points.end(), box.points.begin(), box.points.end());
    }
    for (std::size_t s = 0; s < paths.size(); ++s) {
      plot.drawing.add_path(paths[s], plot.drawing.add_style(filled(series_color(palette, s))), shared->series[s].name,
                            plot.data);
    }
    // Where bars begin, between those above and below.
    const glm::vec2 zero = plot.at(horizontal ? 0 : plot.area.lower.x, horizontal ? plot.area.lower.y : 0);
    Path base;
    if (horizontal && zero.x > plot.area.lower.x && zero.x < plot.area.upper.x) {
      base.move_to({zero.x, plot.area.lower.y}).line_to({zero.x, plot.area.upper.y});
    } else if (!horizontal && zero.y > plot.area.lower.y && zero.y < plot.area.upper.y) {
      base.move_to({plot.area.lower.x, zero.y}).line_to({plot.area.upper.x, zero.y});
    }
    plot.drawing.add_path(base, plot.drawing.add_style(stroked(plot.faint, 0.8F)), "base", plot.data);
  };
  return content;
}

}  // namespace azulejo
