#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "azulejo/charting/chart.h"
#include "azulejo/charting/chart_data.h"
#include "azulejo/charting/legend.h"
#include "azulejo/charting/plot.h"

namespace azulejo {

/// What is drawn in a plot: axes, and functions that mark where and draw it.
struct ChartContent {
  AxisOptions x;
  AxisOptions y;
  std::vector<LegendEntry> legend;
  std::function<void(const Plot& plot, Occupancy& occupancy)> occupy;
  std::function<void(Plot& plot)> draw;
  bool square = false;
  bool grid = true;
  /// A color bar beside the area: what it says, and its range.
  struct Bar {
    std::string label;
    double low = 0;
    double high = 1;
  };
  std::optional<Bar> bar;
};

ChartContent line_content(ChartData data, const ChartOptions& options, bool scatter);
ChartContent bar_content(ChartData data, const ChartOptions& options);

/// Counts of equal parts of a range, one list a series.
struct ChartBins {
  double low = 0;
  double high = 1;
  std::vector<std::vector<double>> counts;
  std::vector<std::string> names;
};
/// Parts of the range of all values. `bins` 0: as many as Freedman and Diaconis ask for, at most 200.
ChartBins bin_values(const ChartData& data, int bins, const std::optional<glm::vec2>& range);
ChartContent histogram_content(ChartBins bins, std::string x_name, const ChartOptions& options);

ChartContent heatmap_content(ChartField field, const ChartOptions& options);
ChartContent contour_content(ChartField field, const ChartOptions& options, const Run& run);

/// The page with the content, a legend and a color bar.
Drawing compose(ChartContent content, const ChartOptions& options, const Run& run);

/// Sets the range and scale that options ask for, or that an extent has.
void choose_range(AxisOptions& axis, const Extent& extent, const std::optional<glm::vec2>& asked, double margin);

/// A place that drawings can hold: not beyond 10⁶ px.
glm::vec2 bounded(const glm::vec2& point);

}  // namespace azulejo
