#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "azulejo/charting/chart_parts.h"
#include "azulejo/charting/contour_labels.h"
#include "azulejo/charting/iso_lines.h"
#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"

namespace azulejo {
namespace {

constexpr std::size_t kColors = 256;
constexpr int kMostLevels = 200;

Extent range_of(const ChartField& field, const ChartOptions& options) {
  if (options.range) return {options.range->x, options.range->y};
  Extent extent;
  for (const float value : field.values) {
    if (std::isfinite(value)) extent.add(static_cast<double>(value));
  }
  return extent.empty() ? Extent{0, 1} : extent;
}

/// Axes of a field: pixels from their corners, cells of tables in the middle of their names.
void set_axes(ChartContent& content, const ChartField& field) {
  content.square = field.is_image;
  content.grid = false;
  content.y.reversed = true;
  if (field.is_image) {
    content.x.high = field.width;
    content.y.high = field.height;
    return;
  }
  const auto set = [](AxisOptions& axis, const std::vector<std::string>& names, int count) {
    axis.low = -0.5;
    axis.high = count - 0.5;
    axis.categories = names;
    for (int i = 1; names.empty() && i <= count; ++i) axis.categories.push_back(std::to_string(i));
  };
  set(content.x, field.x_names, field.width);
  set(content.y, field.y_names, field.height);
}

/// Means of boxes of `step`² cells; what is no number doesn't count.
ChartField reduced(const ChartField& field, int step) {
  ChartField small;
  small.width = (field.width + step - 1) / step;
  small.height = (field.height + step - 1) / step;
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      double sum = 0;
      int count = 0;
      for (int v = y * step; v < std::min(field.height, (y + 1) * step); ++v) {
        for (int u = x * step; u < std::min(field.width, (x + 1) * step); ++u) {
          const float value = field.values[static_cast<std::size_t>(v) * static_cast<std::size_t>(field.width) +
                                           static_cast<std::size_t>(u)];
          if (!std::isfinite(value)) continue;
          sum += static_cast<double>(value);
          ++count;
        }
      }
      small.values.push_back(count > 0 ? static_cast<float>(sum / count) : std::numeric_limits<float>::quiet_NaN());
    }
  }
  return small;
}

/// Cells as rectangles between whole pixels, a path a color; a little longer than need be, so that nothing shows between
/// them when they are enlarged.
void draw_cells(Plot& plot, const ChartField& field, double corner, int step, const Extent& range,
                const std::vector<glm::vec4>& colors) {
  constexpr float kOverlap = 0.1F;
  std::vector<Path> paths(colors.size());
  const auto edge_x = [&](int x) { return std::round(plot.at(corner + x * step, corner).x); };
  const auto edge_y = [&](int y) { return std::round(plot.at(corner, corner + y * step).y); };
  for (int y = 0; y < field.height; ++y) {
    const float* const row = &field.values[static_cast<std::size_t>(y) * static_cast<std::size_t>(field.width)];
    const auto color_at = [&](int x) {
      return std::isfinite(row[x]) ? color_index(static_cast<double>(row[x]), range.low, range.high, colors.size())
                                   : colors.size();
    };
    for (int x = 0; x < field.width;) {
      const std::size_t color = color_at(x);
      int end = x + 1;
      while (end < field.width && color_at(end) == color) ++end;
      if (color < colors.size()) {
        const Path box = rectangle({{edge_x(x), edge_y(y)}, {edge_x(end) + kOverlap, edge_y(y + 1) + kOverlap}});
        paths[color].commands.insert(paths[color].commands.end(), box.commands.begin(), box.commands.end());
        paths[color].points.insert(paths[color].points.end(), box.points.begin(), box.points.end());
      }
      x = end;
    }
  }
  for (std::size_t c = 0; c < colors.size(); ++c) {
    if (!paths[c].commands.empty()) {
      plot.drawing.add_path(paths[c], plot.drawing.add_style(filled(colors[c])), "cells", plot.data);
    }
  }
}

/// The values of cells that are large enough to hold them.
void write_cells(Plot& plot, const ChartField& field, const Extent& range, const std::vector<glm::vec4>& colors) {
  const float width = (plot.area.upper.x - plot.area.lower.x) / static_cast<float>(field.width);
  const float height = (plot.area.upper.y - plot.area.lower.y) / static_cast<float>(field.height);
  const TextOptions how{.size = plot.sizes.tick_text, .anchor = TextAnchor::Middle, .level = TextLevel::Middle};
  if (height < 1.2F * plot.sizes.tick_text || width < 1.5F * plot.sizes.tick_text) return;
  std::vector<std::string> texts;
  for (const float value : field.values) {
    texts.push_back(std::isfinite(value) ? fmt::format("{:.3g}", value) : "");
    if (texts.back().starts_with("-")) texts.back().replace(0, 1, "\xE2\x88\x92");
    if (measure_text(texts.back(), how).width > 0.9F * width) return;
  }
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (texts[i].empty()) continue;
    const std::size_t columns = static_cast<std::size_t>(field.width);
    const std::size_t full_rows = i / columns;
    const auto column = static_cast<double>(i % columns);
    const auto row = static_cast<double>(full_rows);
    const glm::vec4& behind =
        colors[color_index(static_cast<double>(field.values[i]), range.low, range.high, colors.size())];
    add_text(plot.drawing, texts[i], plot.at(column, row), how, plot.drawing.add_style(filled(contrast_ink(behind))),
             "cell-text", plot.front);
  }
}

std::vector<float> chosen_levels(const Extent& range, const ChartOptions& options) {
  std::vector<float> levels = options.levels;
  if (levels.empty() && range.high > range.low) {
    AxisOptions axis;
    fit_range(axis, range, 0);
    for (const double value : make_ticks(axis.low, axis.high, AxisScale::Linear, 11).values) {
      levels.push_back(static_cast<float>(value));
    }
  }
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  return levels;
}

/// A line on the page, without the points that are nearer than a quarter of a pixel to the one before.
void add_line(Path& path, const Plot& plot, const IsoLines& lines, std::size_t line, double shift) {
  constexpr float kNear = 0.25F;
  const std::size_t begin = lines.starts[line];
  const std::size_t end = lines.starts[line + 1];
  glm::vec2 last{};
  for (std::size_t i = begin; i < end; ++i) {
    const glm::vec2 point =
        plot.at(static_cast<double>(lines.points[i].x) + shift, static_cast<double>(lines.points[i].y) + shift);
    if (i == begin) {
      path.move_to(point);
    } else if (i + 1 < end && std::max(std::abs(point.x - last.x), std::abs(point.y - last.y)) < kNear) {
      continue;
    } else {
      path.line_to(point);
    }
    last = point;
  }
  if (lines.closed[line] != 0) path.close();
}

}  // namespace

ChartContent heatmap_content(ChartField field, const ChartOptions& options) {
  ChartContent content;
  set_axes(content, field);
  const Extent range = range_of(field, options);
  content.bar = {"", range.low, range.high};
  const auto shared = std::make_shared<const ChartField>(std::move(field));
  content.draw = [shared, range, options](Plot& plot) {
    const std::vector<glm::vec4> colors = map_colors(options.map, kColors);
    const glm::vec2 size = plot.area.upper - plot.area.lower;
    // No more cells than pixels. Those of the last row and column may be smaller: they are clipped.
    const auto step_for = [](int count, float pixels) {
      return static_cast<int>(std::ceil(static_cast<float>(count) / std::max(1.0F, std::floor(pixels))));
    };
    const int step = std::max({1, step_for(shared->width, size.x), step_for(shared->height, size.y)});
    draw_cells(plot, step == 1 ? *shared : reduced(*shared, step), shared->is_image ? 0 : -0.5, step, range, colors);
    if (options.labels && !shared->is_image) write_cells(plot, *shared, range, colors);
  };
  return content;
}

ChartContent contour_content(ChartField field, const ChartOptions& options, const Run& run) {
  ChartContent content;
  set_axes(content, field);
  const Extent range = range_of(field, options);
  const std::vector<float> levels = chosen_levels(range, options);
  if (levels.size() > kMostLevels) {
    throw Error(Error::Argument, fmt::format("levels: {} of them, expected at most {}", levels.size(), kMostLevels));
  }
  if (!options.labels) content.bar = {"", range.low, range.high};
  const auto lines = std::make_shared<std::vector<IsoLines>>(levels.size());
  const ImageView<const float> view{field.values.data(), field.width, field.height, 1, field.width};
  parallel_tasks(levels.size(), run, [&](std::size_t level, int) { (*lines)[level] = iso_lines(view, levels[level]); });
  const double shift = field.is_image ? 0.5 : 0;
  content.draw = [lines, levels, range, shift, options](Plot& plot) {
    const std::vector<glm::vec4> colors = map_colors(options.map, kColors);
    ContourLabels labels(plot);
    for (std::size_t l = 0; l < levels.size(); ++l) {
      Path path;
      for (std::size_t line = 0; line < (*lines)[l].size(); ++line) add_line(path, plot, (*lines)[l], line, shift);
      // The light end of a map isn't seen on white.
      const std::size_t color = color_index(static_cast<double>(levels[l]), range.low,
                                            range.low + (range.high - range.low) / 0.9, colors.size());
      plot.drawing.add_path(
          path, plot.drawing.add_style(stroked(colors[std::min(color, colors.size() - 1)], 0.75F * options.line_width)),
          fmt::format("level {}", levels[l]), plot.data);
      if (options.labels) labels.add(path, levels[l]);
    }
    labels.draw();
  };
  return content;
}

}  // namespace azulejo
