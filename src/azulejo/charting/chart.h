#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "azulejo/charting/palette.h"
#include "azulejo/charting/ticks.h"
#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/drawing.h"
#include "azulejo/data/image.h"
#include "azulejo/imaging/pseudo_color.h"
#include "azulejo/io/csv.h"
#include "azulejo/math/color.h"

namespace azulejo {

enum class ChartKind : std::uint8_t {
  Line,       ///< points joined in the order of rows
  Scatter,    ///< points
  Bar,        ///< a bar for each category, from 0
  Histogram,  ///< how many values are in each of equal parts of the range
  Heatmap,    ///< cells of a table or image, as colors
  Contour,    ///< lines of equal value of a table or image
};
constexpr auto enum_names(ChartKind) {
  return std::array<std::string_view, 6>{"line", "scatter", "bar", "histogram", "heatmap", "contour"};
}

enum class ChartLegend : std::uint8_t {
  None,
  Right,  ///< beside the area
  UpperLeft,
  UpperRight,
  LowerLeft,
  LowerRight,
};
constexpr auto enum_names(ChartLegend) {
  return std::array<std::string_view, 6>{"none", "right", "upper_left", "upper_right", "lower_left", "lower_right"};
}

enum class ChartMarker : std::uint8_t { None, Circle, Square, Diamond, Triangle, Plus, Cross };
constexpr auto enum_names(ChartMarker) {
  return std::array<std::string_view, 7>{"none", "circle", "square", "diamond", "triangle", "plus", "cross"};
}

struct ChartOptions {
  std::optional<ChartKind> kind =
      std::nullopt;       ///< auto: of an image its histogram; of a table bars over words, else lines
  std::string data = {};  ///< CSV file; empty: an image is given
  std::optional<bool> header = std::nullopt;  ///< whether its first row names the columns; auto: as it looks
  std::string x = {};                         ///< column; empty: the number of the row, from 1
  std::vector<std::string> y = {};            ///< columns; empty: all of numbers that no other option names
  std::string group = {};                     ///< column whose values tell series apart
  std::string color_by = {};                  ///< scatter: column of the points' colors
  std::string size_by = {};                   ///< scatter: column of the points' areas
  bool stacked = false;                       ///< bars stand on each other
  bool horizontal = false;                    ///< bars grow to the right
  std::optional<int> bins = std::nullopt;  ///< of a histogram; auto: 256 of u8 and u16, else by Freedman and Diaconis
  std::vector<float> levels = {};          ///< of contours; empty: at round numbers
  bool labels = true;                      ///< contours and cells of small heat maps say their values
  ColorMap map = ColorMap::Viridis;        ///< of numbers as colors
  std::optional<glm::vec2> range = std::nullopt;  ///< values that have the map's first and last color; auto: all

  int width = 640;                           ///< px, of the page
  std::optional<int> height = std::nullopt;  ///< auto: 5/8 of the width; of images and tables as they need
  std::string title = {};
  std::optional<std::string> x_label = std::nullopt;  ///< auto: what it shows
  std::optional<std::string> y_label = std::nullopt;
  std::optional<glm::vec2> x_range = std::nullopt;  ///< auto: all, and a little room
  std::optional<glm::vec2> y_range = std::nullopt;
  AxisScale x_scale = AxisScale::Linear;
  AxisScale y_scale = AxisScale::Linear;
  std::optional<ChartLegend> legend = std::nullopt;  ///< auto: of several series, where it hides least
  ChartPalette palette = ChartPalette::OkabeIto;
  Color background{1, 1, 1, 1};
  std::optional<ChartMarker> marker = std::nullopt;  ///< auto: circles on scatter charts
  float marker_size = 5;                             ///< px
  float line_width = 1.6F;                           ///< px
  float font_size = 12;                              ///< px; titles are larger, numbers a little smaller
  bool grid = true;
};

/// Draws data as a chart.
///
/// table    as read_csv gives it. NaN and, on logarithmic axes, what isn't above 0 are gaps. Rows of one category and
///          series of a bar add up. A column of words as x makes categories, in the order in which they come first
/// image    1–4 channels, values as intensities 0–1 (f32 as they are). Heat maps and contours take one channel, alpha
///          aside; pixel (0, 0) is on the upper left, and pixels are squares. Of more pixels than the chart has, a heat
///          map shows means of boxes
/// Result   a page in px with text as outlines. ids of paths: as Plot (charting/plot.h), series by their names
/// Bytes    the same for any number of threads
/// Cost     O(values); 10⁶ points are one path
/// Throws   Error(Argument) for options that don't fit, columns that aren't there; Error(Data) for a table without
///          numbers where some are needed
AZULEJO_EXPORT Drawing chart(const CsvTable& table, const ChartOptions& options = {}, const Run& run = {});
AZULEJO_EXPORT Drawing chart(const Image& image, const ChartOptions& options = {}, const Run& run = {});

}  // namespace azulejo
