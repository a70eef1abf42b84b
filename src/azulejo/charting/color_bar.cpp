#include "azulejo/charting/color_bar.h"

#include <algorithm>
#include <numbers>

#include "azulejo/charting/chart_text.h"
#include "azulejo/charting/palette.h"

namespace azulejo {
namespace {

constexpr float kStrip = 1.1F;  // its width, in sizes of the text
constexpr int kStops = 129;     // of the gradient: maps are straight between them, but for the cyclic one's last hues

AxisOptions axis_of(const ColorBar& bar) {
  AxisOptions axis;
  fit_range(axis, {std::min(bar.low, bar.high), std::max(bar.low, bar.high)}, 0);
  return axis;
}

PlacedTicks ticks_of(const ColorBar& bar, float top, float bottom, const PlotSizes& sizes) {
  const AxisOptions options = axis_of(bar);
  const bool turned = bar.low > bar.high;
  const Axis axis(options, turned ? top : bottom, turned ? bottom : top);
  return place_y_ticks(options, axis, bottom - top, sizes, 0);
}

std::string label_of(const ColorBar& bar, int exponent) {
  if (exponent == 0) return bar.label;
  return bar.label + (bar.label.empty() ? "×" : " / ") + power_of_ten(exponent);
}

}  // namespace

float color_bar_width(const ColorBar& bar, float height, const PlotSizes& sizes) {
  const PlacedTicks ticks = ticks_of(bar, 0, std::max(1.0F, height), sizes);
  const float label = label_of(bar, ticks.exponent).empty() ? 0 : line_height(sizes.label_text) + sizes.gap;
  return 1.3F * sizes.pad + kStrip * sizes.label_text + sizes.tick + sizes.gap + ticks.widest + label;
}

void draw_color_bar(Drawing& drawing, std::uint32_t group, const ColorBar& bar, const Box2& area,
                    const PlotSizes& sizes, const glm::vec4& ink, const Run& run) {
  const Box2 strip{{area.upper.x + 1.3F * sizes.pad, area.lower.y},
                   {area.upper.x + 1.3F * sizes.pad + kStrip * sizes.label_text, area.upper.y}};
  Gradient gradient;
  gradient.from = {strip.lower.x, strip.upper.y};
  gradient.to = strip.lower;
  if (bar.bands > 0) {
    const std::vector<glm::vec4> colors = map_colors(bar.map, bar.bands);
    for (std::size_t i = 0; i < colors.size(); ++i) {
      gradient.stops.push_back({static_cast<float>(i) / static_cast<float>(colors.size()), colors[i]});
      gradient.stops.push_back({static_cast<float>(i + 1) / static_cast<float>(colors.size()), colors[i]});
    }
  } else {
    const std::vector<glm::vec4> colors = map_colors(bar.map, kStops);
    for (int i = 0; i < kStops; ++i) {
      gradient.stops.push_back(
          {static_cast<float>(i) / static_cast<float>(kStops - 1), colors[static_cast<std::size_t>(i)]});
    }
  }
  DrawingStyle style;
  style.fill = Paint({0, 0, 0, 1}, drawing.add_pattern(std::move(gradient)));
  drawing.add_path(rectangle(strip), drawing.add_style(style), "color-bar", group);
  const glm::vec4 faint(ink.x, ink.y, ink.z, 0.6F);
  const std::uint32_t line = drawing.add_style(stroked(faint, 0.8F));
  drawing.add_path(rectangle(strip), line, "color-bar", group);

  const PlacedTicks ticks = ticks_of(bar, strip.lower.y, strip.upper.y, sizes);
  Path marks;
  const std::uint32_t text = drawing.add_style(filled(ink));
  const float outside = strip.upper.x + sizes.tick + sizes.gap;
  for (const PlacedTicks::Mark& mark : ticks.marks) {
    marks.move_to({strip.upper.x, mark.at}).line_to({strip.upper.x + sizes.tick, mark.at});
    add_text(drawing, mark.label, {outside, mark.at}, {.size = sizes.tick_text, .level = TextLevel::Middle}, text,
             "color-tick", group, run);
  }
  drawing.add_path(marks, line, "color-bar", group);
  const std::string label = label_of(bar, ticks.exponent);
  if (label.empty()) return;
  const TextOptions how{.size = sizes.label_text,
                        .anchor = TextAnchor::Middle,
                        .level = TextLevel::Top,
                        .angle = std::numbers::pi_v<float> / 2};
  add_text(drawing, fitted_text(label, how, strip.upper.y - strip.lower.y),
           {outside + ticks.widest + sizes.gap, 0.5F * (strip.lower.y + strip.upper.y)}, how, text, "color-label",
           group, run);
}

}  // namespace azulejo
