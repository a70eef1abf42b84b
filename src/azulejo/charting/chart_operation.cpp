#include "azulejo/charting/chart.h"
#include "azulejo/core/error.h"
#include "azulejo/engine/field_group.h"
#include "azulejo/engine/operation.h"

namespace azulejo {
namespace {

std::vector<Field> data_fields() {
  using Options = ChartOptions;
  return {
      field("kind", &Options::kind, "auto: of an image its histogram; of a table bars over words, else lines"),
      field("data", &Options::data, "a CSV file, in place of an image"),
      field("header", &Options::header, "its first row names the columns; auto: where that looks so"),
      field("x", &Options::x, "its column along the x axis, by name or number; empty: the rows' numbers"),
      field("y", &Options::y, "its columns of values, by name or number; none: all other columns of numbers"),
      field("group", &Options::group, "its column whose values tell series apart"),
      field("color_by", &Options::color_by, "scatter: its column of the points' colors"),
      field("size_by", &Options::size_by, "scatter: its column of the points' areas"),
      field("stacked", &Options::stacked, "bars stand on each other"),
      field("horizontal", &Options::horizontal, "bars grow to the right"),
      field("bins", &Options::bins, {1, 65536}, "", "of a histogram; auto: 256 of an image, else by how values spread"),
      field("levels", &Options::levels, {-1e30, 1e30}, "", "of contours; none: round numbers"),
      field("labels", &Options::labels, "contours, and cells of tables as heat maps, say their values"),
      field("map", &Options::map, "colors of numbers"),
      field("range", &Options::range, {-1e30, 1e30}, "", "numbers of the map's first and last color"),
  };
}

std::vector<Field> page_fields() {
  using Options = ChartOptions;
  return {
      field("width", &Options::width, {16, 16384}, "px", "of the page"),
      field("height", &Options::height, {16, 16384}, "px", "of the page; auto: 5/8 of the width, or as an image needs"),
      field("title", &Options::title, "above the chart"),
      field("x_label", &Options::x_label, "below the x axis; auto: what it shows"),
      field("y_label", &Options::y_label, "beside the y axis; auto: what it shows"),
      field("x_range", &Options::x_range, {-1e30, 1e30}, "", "ends of the x axis; auto: all is seen"),
      field("y_range", &Options::y_range, {-1e30, 1e30}, "", "ends of the y axis; auto: all is seen"),
      field("x_scale", &Options::x_scale, "of the x axis"),
      field("y_scale", &Options::y_scale, "of the y axis"),
      field("legend", &Options::legend, "where it is; auto: of several series, where it hides nothing"),
      field("palette", &Options::palette, "colors of series"),
      field("background", &Options::background, "of the page; transparent: none"),
      field("marker", &Options::marker, "shape of points; auto: circles on scatter charts, else none"),
      field("marker_size", &Options::marker_size, {0, 1000}, "px", "width of points"),
      field("line_width", &Options::line_width, {0, 1000}, "px", "of lines"),
      field("font_size", &Options::font_size, {1, 1000}, "px", "of labels; numbers are smaller, the title is larger"),
      field("grid", &Options::grid, "thin lines behind the data"),
  };
}

std::vector<Value> run_chart(std::span<const Value> inputs, const ChartOptions& options, const Run& run) {
  const bool has_image = !inputs.empty() && !inputs[0].empty();
  std::vector<Value> results;
  if (options.data.empty()) {
    if (!has_image) throw Error(Error::Argument, "data: none, and no image either, expected one of them");
    results.emplace_back(chart(*inputs[0].image(), options, run));
    return results;
  }
  if (has_image) {
    throw Error(Error::Argument, "data: a file beside an image, expected one of them");
  }
  results.emplace_back(chart(read_csv(options.data, {.header = options.header}, run), options, run));
  return results;
}

}  // namespace

extern const Operation kChart = with_examples(
    value_operation<ChartOptions>("chart", "Draws numbers: lines, bars, points, histograms, heat maps, contours.",
                                  {{"image", "values, where no data are given", ValueKind::Image, false, true}},
                                  {{"chart", "the page", ValueKind::Drawing}}, joined({data_fields(), page_fields()}),
                                  run_chart),
    {{"photo.png chart:title=Histogram", "How often values occur: those of the options of image operations."},
     {"gray.png gaussian:sigma=8 chart:kind=contour", "Lines of equal brightness."},
     {"gray.png chart:kind=heatmap,map=magma", "Brightness as color, with what it means."}});

}  // namespace azulejo
