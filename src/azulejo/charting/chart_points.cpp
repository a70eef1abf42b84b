#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "azulejo/charting/chart_parts.h"

namespace azulejo {
namespace {

constexpr std::size_t kColors = 256;
constexpr double kSizes = 32;
constexpr float kSmallest = 0.3F;  // of the size of points of the largest value

bool is_place(const glm::vec2& point) { return std::isfinite(point.x) && std::isfinite(point.y); }

PointShape shape_of(ChartMarker marker) {
  switch (marker) {
    case ChartMarker::Square: return PointShape::Square;
    case ChartMarker::Diamond: return PointShape::Diamond;
    case ChartMarker::Triangle: return PointShape::Triangle;
    case ChartMarker::Plus: return PointShape::Plus;
    case ChartMarker::Cross: return PointShape::Cross;
    case ChartMarker::None:
    case ChartMarker::Circle: break;
  }
  return PointShape::Circle;
}

/// How lines and points of a chart look.
struct Look {
  bool lines = true;
  ChartMarker marker = ChartMarker::None;
  float size = 5;
  float width = 1.6F;
  float opacity = 1;

  DrawingStyle style(const glm::vec4& color) const {
    DrawingStyle style;
    style.fill.reset();
    if (lines) {
      style.stroke = Paint(color);
      style.stroke_width = width;
      style.join = LineJoin::Round;
      style.cap = LineCap::Round;
    }
    if (marker != ChartMarker::None) {
      style.points = Paint(color);
      style.point_size = size;
      style.point_shape = shape_of(marker);
    }
    style.opacity = opacity;
    return style;
  }
};

/// One path through all places; what has none is a gap, a point between two gaps a line of no length.
Path line_through(const Plot& plot, const ChartSeries& series) {
  Path path;
  path.commands.reserve(series.x.size());
  path.points.reserve(series.x.size());
  std::size_t run = 0;
  const auto end_run = [&] {
    if (run == 1) path.line_to(path.points.back());
    run = 0;
  };
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const glm::vec2 point = plot.at(series.x[i], series.y[i]);
    if (std::isnan(point.x) || std::isnan(point.y)) {
      end_run();
      continue;
    }
    run++ == 0 ? path.move_to(bounded(point)) : path.line_to(bounded(point));
  }
  end_run();
  return path;
}

/// Points of a scatter chart by their look: a path joins those that look alike, and shows only its points.
class PointSorter {
 public:
  PointSorter(const ChartSeries& series, const Extent& colors, const Extent& sizes)
      : series_(series), colors_(colors), sizes_(sizes) {}

  /// Color and size steps of a point; nothing: it has no place.
  std::pair<std::size_t, std::size_t> look(std::size_t i) const {
    const std::size_t color =
        series_.colors.empty() ? 0 : color_index(series_.colors[i], colors_.low, colors_.high, kColors);
    std::size_t size = 0;
    if (!series_.sizes.empty()) {
      const double share = sizes_.high > 0 ? std::clamp(series_.sizes[i] / sizes_.high, 0.0, 1.0) : 0;
      size = std::isnan(share) ? 0 : static_cast<std::size_t>(std::sqrt(share) * kSizes + 0.5);
    }
    return {color, size};
  }

 private:
  const ChartSeries& series_;
  const Extent& colors_;
  const Extent& sizes_;
};

void draw_points(Plot& plot, const ChartSeries& series, const Look& look, const glm::vec4& color,
                 const ChartOptions& options, const Extent& colors, const Extent& sizes) {
  const PointSorter sorter(series, colors, sizes);
  std::map<std::pair<std::size_t, std::size_t>, Path> paths;
  Path* path = nullptr;
  std::pair<std::size_t, std::size_t> last;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const glm::vec2 point = plot.at(series.x[i], series.y[i]);
    if (!is_place(point)) continue;
    const auto next = sorter.look(i);
    if (path == nullptr || next != last) path = &paths[next];
    last = next;
    path->commands.empty() ? path->move_to(bounded(point)) : path->line_to(bounded(point));
  }
  const std::vector<glm::vec4> map =
      series.colors.empty() ? std::vector<glm::vec4>() : map_colors(options.map, kColors);
  for (auto& [steps, each] : paths) {
    if (each.points.size() == 1) each.close();
    glm::vec4 shade = color;
    if (!map.empty()) shade = steps.first < map.size() ? map[steps.first] : plot.faint;
    Look scaled = look;
    if (!series.sizes.empty()) {
      scaled.size =
          3 * look.size * std::max(kSmallest / 3, static_cast<float>(static_cast<double>(steps.second) / kSizes));
    }
    plot.drawing.add_path(each, plot.drawing.add_style(scaled.style(shade)), series.name, plot.data);
  }
}

Extent united(const std::vector<ChartSeries>& series, std::vector<double> ChartSeries::*member, AxisScale scale) {
  Extent all;
  for (const ChartSeries& each : series) {
    const Extent extent = extent_of(each.*member, scale);
    if (extent.empty()) continue;
    all.add(extent.low);
    all.add(extent.high);
  }
  return all;
}

}  // namespace

glm::vec2 bounded(const glm::vec2& point) {
  constexpr float kFarthest = 1e6F;
  return {std::clamp(point.x, -kFarthest, kFarthest), std::clamp(point.y, -kFarthest, kFarthest)};
}

void choose_range(AxisOptions& axis, const Extent& extent, const std::optional<glm::vec2>& asked, double margin) {
  fit_range(axis, extent, margin);
  if (!asked) return;
  axis.low = asked->x;
  axis.high = asked->y;
}

ChartContent line_content(ChartData data, const ChartOptions& options, bool scatter) {
  ChartContent content;
  content.x.scale = data.categories.empty() ? options.x_scale : AxisScale::Linear;
  content.y.scale = options.y_scale;
  content.x.label = data.x_name;
  content.y.label = data.y_name;
  content.x.categories = data.categories;
  const double margin = scatter ? 0.04 : 0;
  choose_range(content.x, united(data.series, &ChartSeries::x, content.x.scale), options.x_range, margin);
  if (!data.categories.empty() && !options.x_range) {
    content.x.low = -0.5;
    content.x.high = static_cast<double>(data.categories.size()) - 0.5;
  }
  choose_range(content.y, united(data.series, &ChartSeries::y, content.y.scale), options.y_range, 0.04);

  Look look;
  look.lines = !scatter;
  look.marker = options.marker.value_or(scatter ? ChartMarker::Circle : ChartMarker::None);
  look.size = options.marker_size;
  look.width = options.line_width;
  std::size_t points = 0;
  for (const ChartSeries& series : data.series) points += series.x.size();
  // Where many points lie on each other, it is seen how many.
  look.opacity = !scatter ? 1 : points > 20000 ? 0.3F : points > 1000 ? 0.5F : 0.8F;
  for (std::size_t s = 0; s < data.series.size(); ++s) {
    Look sample = look;
    sample.opacity = 1;
    content.legend.push_back({data.series[s].name, scatter ? LegendEntry::Marker : LegendEntry::Line,
                              sample.style(series_color(options.palette, s))});
  }
  Extent colors = united(data.series, &ChartSeries::colors, AxisScale::Linear);
  const Extent sizes = united(data.series, &ChartSeries::sizes, AxisScale::Linear);
  if (!data.color_name.empty()) {
    if (options.range) colors = {options.range->x, options.range->y};
    if (colors.empty()) colors = {0, 1};
    content.bar = {data.color_name, colors.low, colors.high};
    content.legend.clear();
  }
  const auto shared = std::make_shared<const ChartData>(std::move(data));
  content.occupy = [shared, scatter](const Plot& plot, Occupancy& occupancy) {
    for (const ChartSeries& series : shared->series) {
      for (std::size_t i = 0; i < series.x.size(); ++i) {
        const glm::vec2 point = plot.at(series.x[i], series.y[i]);
        if (scatter || i == 0) {
          occupancy.add(point);
        } else {
          occupancy.add_line(plot.at(series.x[i - 1], series.y[i - 1]), point);
        }
      }
    }
  };
  content.draw = [shared, look, scatter, options, colors, sizes](Plot& plot) {
    for (std::size_t s = 0; s < shared->series.size(); ++s) {
      const ChartSeries& series = shared->series[s];
      const glm::vec4 color = series_color(options.palette, s);
      if (scatter) {
        draw_points(plot, series, look, color, options, colors, sizes);
      } else {
        plot.drawing.add_path(line_through(plot, series), plot.drawing.add_style(look.style(color)), series.name,
                              plot.data);
      }
    }
  };
  return content;
}

}  // namespace azulejo
