#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "azulejo/charting/axis.h"
#include "azulejo/charting/text.h"
#include "azulejo/core/run.h"
#include "azulejo/data/drawing.h"
#include "azulejo/math/color.h"

namespace azulejo {

struct PlotOptions {
  float width = 640;
  float height = 400;
  std::string title;
  AxisOptions x;
  AxisOptions y;
  Color background{1, 1, 1, 1};
  float font_size = 12;
  bool grid = true;
  bool square = false;       ///< a unit of x is as long as one of y
  float right_room = 0;      ///< kept free beside the area
  bool auto_height = false;  ///< of a square plot: as high as it needs
};

/// Sizes of what is around the area, which follow from the font's.
struct PlotSizes {
  explicit PlotSizes(float font_size)
      : tick_text(0.92F * font_size),
        label_text(font_size),
        title_text(1.2F * font_size),
        pad(0.75F * font_size),
        tick(0.35F * font_size),
        gap(0.35F * font_size) {}
  float tick_text;
  float label_text;
  float title_text;
  float pad;   ///< at the edges of the page
  float tick;  ///< length of a mark
  float gap;   ///< between marks and text
};

/// Height of a line of text.
float line_height(float size);

/// Marks of an axis with where they are on the page.
struct PlacedTicks {
  struct Mark {
    float at = 0;
    std::string label;
    float width = 0;  ///< of the label, along its line
  };
  std::vector<Mark> marks;
  std::vector<float> minor;
  int exponent = 0;
  bool slanted = false;  ///< labels rise by an eighth of a turn
  float depth = 0;       ///< room for labels, across the axis
  float widest = 0;      ///< of the labels
};

/// The marks of a horizontal axis: as many as stand beside each other.
/// deepest  room for slanted labels
/// slanted  categories are slanted also where they would fit
PlacedTicks place_x_ticks(const AxisOptions& options, const Axis& axis, float length, const PlotSizes& sizes,
                          float deepest, bool slanted);
/// The marks of a vertical axis. widest  room for categories
PlacedTicks place_y_ticks(const AxisOptions& options, const Axis& axis, float length, const PlotSizes& sizes,
                          float widest);

/// A frame with axes, and an area to draw in. Margins follow from the sizes of texts; texts of an axis never overlap.
///
/// Order  background, grid, what is added to `data`, frame and texts, what is added to `front`
/// ids    of paths: "background", "grid", "frame", "ticks", "x-tick", "y-tick", "x-factor", "y-factor", "x-label",
///        "y-label", "title"
class Plot {
 public:
  Plot(const PlotOptions& options, const Run& run);

  /// NaN where an axis has no place for it.
  glm::vec2 at(double x, double y) const {
    return {static_cast<float>(x_axis.at(x)), static_cast<float>(y_axis.at(y))};
  }
  /// Adds text in the ink's color.
  std::uint32_t write(std::string_view text, const glm::vec2& place, const TextOptions& how, std::string id,
                      std::uint32_t group);

  Drawing drawing;
  Box2 area;
  Axis x_axis;
  Axis y_axis;
  std::uint32_t data = 0;   ///< group, clipped to the area
  std::uint32_t front = 0;  ///< group
  PlotSizes sizes;
  glm::vec4 ink;    ///< of texts: what is seen on the background
  glm::vec4 faint;  ///< of the frame
  glm::vec4 grid;
  glm::vec4 paper;  ///< the background

 private:
  void lay_out();
  void draw_grid();
  void draw_frame();
  void draw_tick_labels();
  void draw_titles();

  PlotOptions options_;
  Run run_;
  PlacedTicks x_ticks_;
  PlacedTicks y_ticks_;
};

/// A closed rectangle.
Path rectangle(const Box2& box);
/// A style that only fills, or only draws lines.
DrawingStyle filled(const glm::vec4& color);
DrawingStyle stroked(const glm::vec4& color, float width);
/// What is seen on it: dark gray or light gray.
glm::vec4 contrast_ink(const glm::vec4& background);

}  // namespace azulejo
