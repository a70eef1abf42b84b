#include <algorithm>

#include "azulejo/charting/chart_text.h"
#include "azulejo/charting/plot.h"

namespace azulejo {
namespace {

constexpr float kSlant = 0.70710678F;  // sine and cosine of an eighth of a turn

void measure(PlacedTicks& ticks, const PlotSizes& sizes) {
  ticks.widest = 0;
  for (PlacedTicks::Mark& mark : ticks.marks) {
    mark.width = measure_text(mark.label, {.size = sizes.tick_text}).width;
    ticks.widest = std::max(ticks.widest, mark.width);
  }
}

PlacedTicks placed(const Ticks& ticks, const Axis& axis, const PlotSizes& sizes) {
  PlacedTicks result;
  result.exponent = ticks.exponent;
  for (std::size_t i = 0; i < ticks.values.size(); ++i) {
    result.marks.push_back({static_cast<float>(axis.at(ticks.values[i])), ticks.labels[i], 0});
  }
  for (const double value : ticks.minor) result.minor.push_back(static_cast<float>(axis.at(value)));
  measure(result, sizes);
  return result;
}

/// Whether labels beside each other stand apart.
bool stand_apart(const std::vector<PlacedTicks::Mark>& marks, float gap) {
  for (std::size_t i = 1; i < marks.size(); ++i) {
    if (std::abs(marks[i].at - marks[i - 1].at) < 0.5F * (marks[i].width + marks[i - 1].width) + gap) return false;
  }
  return true;
}

/// Whether lines of text above each other stand apart.
bool lines_stand_apart(const std::vector<PlacedTicks::Mark>& marks, float line) {
  for (std::size_t i = 1; i < marks.size(); ++i) {
    if (std::abs(marks[i].at - marks[i - 1].at) < line) return false;
  }
  return true;
}

/// Categories, every so-many-th that is at least `apart` from the next.
PlacedTicks category_ticks(const AxisOptions& options, const Axis& axis, float length, float apart) {
  const auto count = options.categories.size();
  const double spacing = length / std::max(1e-9, options.high - options.low);
  const auto stride = static_cast<std::size_t>(std::max(1.0, std::ceil(apart / std::max(spacing, 1e-9))));
  PlacedTicks result;
  for (std::size_t i = 0; i < count; i += stride) {
    const auto place = static_cast<double>(i);
    if (place < options.low || place > options.high) continue;
    result.marks.push_back({static_cast<float>(axis.at(place)), drawn_text(options.categories[i]), 0});
  }
  return result;
}

void fit_labels(PlacedTicks& ticks, float room, const PlotSizes& sizes) {
  for (PlacedTicks::Mark& mark : ticks.marks) mark.label = fitted_text(mark.label, {.size = sizes.tick_text}, room);
  measure(ticks, sizes);
}

PlacedTicks place_categories(const AxisOptions& options, const Axis& axis, float length, const PlotSizes& sizes,
                             float deepest, bool slanted) {
  const float line = line_height(sizes.tick_text);
  PlacedTicks ticks = category_ticks(options, axis, length, 0);
  measure(ticks, sizes);
  if (!slanted && stand_apart(ticks.marks, 0.4F * sizes.tick_text)) {
    ticks.depth = line;
    return ticks;
  }
  ticks = category_ticks(options, axis, length, 1.05F * line / kSlant);
  ticks.slanted = true;
  fit_labels(ticks, std::max(0.0F, deepest / kSlant - line), sizes);
  ticks.depth = (ticks.widest + line) * kSlant;
  return ticks;
}

}  // namespace

float line_height(float size) {
  const TextExtent extent = measure_text("", {.size = size});
  return extent.ascent + extent.descent;
}

PlacedTicks place_x_ticks(const AxisOptions& options, const Axis& axis, float length, const PlotSizes& sizes,
                          float deepest, bool slanted) {
  if (!options.categories.empty()) return place_categories(options, axis, length, sizes, deepest, slanted);
  const int most = std::clamp(static_cast<int>(length / (4.5F * sizes.tick_text)), 2, 11);
  PlacedTicks ticks;
  for (int count = most; count >= 2; --count) {
    ticks = placed(make_ticks(options.low, options.high, options.scale, count), axis, sizes);
    if (stand_apart(ticks.marks, 0.8F * sizes.tick_text)) break;
    if (count == 2 && !ticks.marks.empty()) ticks.marks.resize(1);
  }
  ticks.depth = line_height(sizes.tick_text);
  return ticks;
}

PlacedTicks place_y_ticks(const AxisOptions& options, const Axis& axis, float length, const PlotSizes& sizes,
                          float widest) {
  const float line = line_height(sizes.tick_text);
  PlacedTicks ticks;
  if (!options.categories.empty()) {
    ticks = category_ticks(options, axis, length, 1.05F * line);
    fit_labels(ticks, widest, sizes);
  } else {
    const int most = std::clamp(static_cast<int>(length / (2.6F * sizes.tick_text)), 2, 10);
    for (int count = most; count >= 2; --count) {
      ticks = placed(make_ticks(options.low, options.high, options.scale, count), axis, sizes);
      if (lines_stand_apart(ticks.marks, line)) break;
      if (count == 2 && !ticks.marks.empty()) ticks.marks.resize(1);
    }
  }
  ticks.depth = ticks.widest;
  return ticks;
}

}  // namespace azulejo
