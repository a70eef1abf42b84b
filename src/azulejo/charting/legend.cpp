#include "azulejo/charting/legend.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "azulejo/charting/chart_text.h"

namespace azulejo {

int Occupancy::column(float x) const {
  const float share = (x - area_.lower.x) / (area_.upper.x - area_.lower.x);
  return static_cast<int>(std::clamp(share * kColumns, 0.0F, kColumns - 1.0F));
}

int Occupancy::row(float y) const {
  const float share = (y - area_.lower.y) / (area_.upper.y - area_.lower.y);
  return static_cast<int>(std::clamp(share * kRows, 0.0F, kRows - 1.0F));
}

void Occupancy::add(const glm::vec2& point, float weight) {
  if (!(point.x >= area_.lower.x && point.x <= area_.upper.x && point.y >= area_.lower.y && point.y <= area_.upper.y)) {
    return;
  }
  cells_[static_cast<std::size_t>(row(point.y) * kColumns + column(point.x))] += weight;
}

void Occupancy::add_line(const glm::vec2& from, const glm::vec2& to) {
  const glm::vec2 span = area_.upper - area_.lower;
  const glm::vec2 step = to - from;
  const float cells = std::max(std::abs(step.x) / span.x * kColumns, std::abs(step.y) / span.y * kRows);
  if (!std::isfinite(cells)) return;
  // Of a line that goes far outside, some places are left out.
  const int count = static_cast<int>(std::clamp(std::ceil(cells), 1.0F, 4.0F * kColumns));
  for (int i = 0; i <= count; ++i) add(from + step * (static_cast<float>(i) / static_cast<float>(count)));
}

void Occupancy::add_box(const Box2& box) {
  const Box2 seen{{std::max(box.lower.x, area_.lower.x), std::max(box.lower.y, area_.lower.y)},
                  {std::min(box.upper.x, area_.upper.x), std::min(box.upper.y, area_.upper.y)}};
  if (seen.empty()) return;
  for (int y = row(seen.lower.y); y <= row(seen.upper.y); ++y) {
    for (int x = column(seen.lower.x); x <= column(seen.upper.x); ++x) {
      cells_[static_cast<std::size_t>(y * kColumns + x)] += 1;
    }
  }
}

float Occupancy::in(const Box2& box) const {
  float sum = 0;
  for (int y = row(box.lower.y); y <= row(box.upper.y); ++y) {
    for (int x = column(box.lower.x); x <= column(box.upper.x); ++x) {
      sum += cells_[static_cast<std::size_t>(y * kColumns + x)];
    }
  }
  return sum;
}

Legend::Legend(std::vector<LegendEntry> entries, const PlotOptions& options)
    : entries_(std::move(entries)), sizes_(options.font_size) {
  if (entries_.empty()) return;
  const TextOptions how{.size = sizes_.tick_text};
  line_ = 1.15F * line_height(sizes_.tick_text);
  swatch_ = 1.7F * sizes_.tick_text;
  const auto rows = static_cast<std::size_t>(std::max(1.0F, (0.75F * options.height - 2 * sizes_.gap) / line_));
  if (entries_.size() > rows) {
    const std::size_t left_out = entries_.size() - (rows - 1);
    entries_.resize(rows);
    entries_.back() = {fmt::format("… {} more", left_out), LegendEntry::Box, {}};
    entries_.back().style.fill.reset();
  }
  float widest = 0;
  for (LegendEntry& entry : entries_) {
    entry.text = fitted_text(entry.text, how, 0.3F * options.width);
    widest = std::max(widest, measure_text(entry.text, how).width);
  }
  size_ = {swatch_ + widest + 3.5F * sizes_.gap, static_cast<float>(entries_.size()) * line_ + 1.5F * sizes_.gap};
}

Box2 Legend::box(const Plot& plot, ChartLegend place) const {
  const float away = 0.7F * sizes_.pad;
  const Box2& area = plot.area;
  if (place == ChartLegend::Right) {
    const glm::vec2 corner{area.upper.x + away, area.lower.y};
    return {corner, corner + size_};
  }
  const bool left = place == ChartLegend::UpperLeft || place == ChartLegend::LowerLeft;
  const bool upper = place == ChartLegend::UpperLeft || place == ChartLegend::UpperRight;
  const glm::vec2 corner{left ? area.lower.x + away : area.upper.x - away - size_.x,
                         upper ? area.lower.y + away : area.upper.y - away - size_.y};
  return {corner, corner + size_};
}

std::optional<ChartLegend> Legend::clear_corner(const Plot& plot, const Occupancy& occupancy) const {
  const glm::vec2 area = plot.area.upper - plot.area.lower;
  if (size_.x > 0.6F * area.x || size_.y > 0.8F * area.y) return std::nullopt;
  for (const ChartLegend place :
       {ChartLegend::UpperRight, ChartLegend::UpperLeft, ChartLegend::LowerRight, ChartLegend::LowerLeft}) {
    if (occupancy.in(box(plot, place)) == 0) return place;
  }
  return std::nullopt;
}

void Legend::draw(Plot& plot, ChartLegend place) const {
  const Box2 frame = box(plot, place);
  Drawing& drawing = plot.drawing;
  if (place != ChartLegend::Right) {
    DrawingStyle style = filled({plot.paper.x, plot.paper.y, plot.paper.z, 0.85F});
    style.stroke = Paint(plot.grid);
    drawing.add_path(rectangle(frame), drawing.add_style(style), "legend", plot.front);
  }
  float y = frame.lower.y + 0.75F * sizes_.gap + 0.5F * line_;
  for (const LegendEntry& entry : entries_) {
    const float x = frame.lower.x + sizes_.gap;
    Path path;
    switch (entry.swatch) {
      case LegendEntry::Line: path.move_to({x, y}).line_to({x + swatch_, y}); break;
      case LegendEntry::Marker: path.move_to({x + 0.5F * swatch_, y}).close(); break;
      case LegendEntry::Box:
        path = rectangle({{x + 0.15F * swatch_, y - 0.3F * line_}, {x + 0.85F * swatch_, y + 0.3F * line_}});
        break;
    }
    drawing.add_path(path, drawing.add_style(entry.style), "legend", plot.front);
    plot.write(entry.text, {x + swatch_ + sizes_.gap, y}, {.size = sizes_.tick_text, .level = TextLevel::Middle},
               "legend-text", plot.front);
    y += line_;
  }
}

}  // namespace azulejo
