#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "azulejo/charting/chart.h"
#include "azulejo/charting/plot.h"

namespace azulejo {

/// How much of the area is drawn on, in cells.
class Occupancy {
 public:
  explicit Occupancy(const Box2& area) : area_(area) {}
  void add(const glm::vec2& point, float weight = 1);
  void add_line(const glm::vec2& from, const glm::vec2& to);
  void add_box(const Box2& box);
  /// The sum of what is in the box.
  float in(const Box2& box) const;

 private:
  static constexpr int kColumns = 64;
  static constexpr int kRows = 48;
  int column(float x) const;
  int row(float y) const;
  Box2 area_;
  std::array<float, static_cast<std::size_t>(kColumns) * kRows> cells_{};
};

/// What a series looks like in the legend.
struct LegendEntry {
  enum Swatch : std::uint8_t { Line, Marker, Box };
  std::string text;
  Swatch swatch = Line;
  DrawingStyle style;
};

/// The legend of a chart: how large it is, and where.
class Legend {
 public:
  Legend(std::vector<LegendEntry> entries, const PlotOptions& options);
  bool empty() const { return entries_.empty(); }
  glm::vec2 size() const { return size_; }
  /// The corner of the area in which least is hidden; nothing: something is hidden in each.
  std::optional<ChartLegend> clear_corner(const Plot& plot, const Occupancy& occupancy) const;
  void draw(Plot& plot, ChartLegend place) const;

 private:
  Box2 box(const Plot& plot, ChartLegend place) const;
  std::vector<LegendEntry> entries_;
  PlotSizes sizes_;
  float line_ = 0;
  float swatch_ = 0;
  glm::vec2 size_{0, 0};
};

}  // namespace azulejo
