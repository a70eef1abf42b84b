#pragma once

#include <string>

#include "azulejo/charting/plot.h"
#include "azulejo/imaging/pseudo_color.h"

namespace azulejo {

/// What colors stand for: a strip with an axis.
struct ColorBar {
  std::string label;
  double low = 0;
  double high = 1;
  ColorMap map = ColorMap::Viridis;
  int bands = 0;  ///< as many colors; 0: all
};

/// Room that it takes beside an area of that height, with a gap.
float color_bar_width(const ColorBar& bar, float height, const PlotSizes& sizes);

/// Draws it beside an area, as high as that. Its paths are "color-bar", its texts "color-tick" and "color-label".
void draw_color_bar(Drawing& drawing, std::uint32_t group, const ColorBar& bar, const Box2& area,
                    const PlotSizes& sizes, const glm::vec4& ink, const Run& run);

}  // namespace azulejo
