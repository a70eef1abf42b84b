#pragma once

#include <string>
#include <vector>

#include "azulejo/charting/chart.h"

namespace azulejo {

/// Points of one color. All lists that aren't empty are as long as x.
struct ChartSeries {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> colors;
  std::vector<double> sizes;
};

struct ChartData {
  std::vector<ChartSeries> series;
  std::vector<std::string> categories;  ///< where x is words: their places are 0, 1, 2 …
  std::string x_name;
  std::string y_name;  ///< of a single column; else empty
  std::string color_name;
};

/// What the options ask for of a table, for lines and points.
ChartData point_data(const CsvTable& table, const ChartOptions& options);
/// The same for bars: x is always categories, each in a series once; y are sums. Without numbers rows are counted.
ChartData bar_data(const CsvTable& table, const ChartOptions& options);
/// Of a histogram: the values are y, x is empty.
ChartData value_data(const CsvTable& table, const ChartOptions& options);

/// Numbers in rows and columns.
struct ChartField {
  int width = 0;
  int height = 0;
  std::vector<float> values;         ///< NaN: none
  std::vector<std::string> x_names;  ///< of columns; empty: they have numbers
  std::vector<std::string> y_names;
  bool is_image = false;
};
ChartField field_data(const CsvTable& table, const ChartOptions& options);

}  // namespace azulejo
