#pragma once

#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "azulejo/charting/ticks.h"

namespace azulejo {

/// What an axis shows. Categories are at 0, 1, 2 …
struct AxisOptions {
  double low = 0;
  double high = 1;
  AxisScale scale = AxisScale::Linear;
  std::string label;
  std::vector<std::string> categories;  ///< names instead of numbers
  bool reversed = false;                ///< of y: the low end is on top
};

/// From values to places on the page.
class Axis {
 public:
  Axis() = default;
  Axis(const AxisOptions& options, double from, double to)
      : log_(options.scale == AxisScale::Log),
        from_(from),
        low_(transformed(options.low)),
        scale_((to - from) / (transformed(options.high) - low_)) {}
  /// NaN of what is NaN, or not above 0 on a logarithmic axis.
  double at(double value) const { return from_ + (transformed(value) - low_) * scale_; }

 private:
  double transformed(double value) const {
    if (!log_) return value;
    return value > 0 ? std::log10(value) : std::numeric_limits<double>::quiet_NaN();
  }

  bool log_ = false;
  double from_ = 0;
  double low_ = 0;
  double scale_ = 1;
};

/// The smallest and the largest of the numbers that an axis can show: finite, and above 0 on a logarithmic one.
struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  bool empty() const { return !(low <= high); }
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};
Extent extent_of(std::span<const double> values, AxisScale scale);

/// The range of an axis that shows an extent: with room at both ends, of a share of its length, but not below 0 where
/// all is above, and the other way around. An empty extent gives 0 to 1 (1 to 10), one value a range around it.
/// margin  share, at each end; 0: none
void fit_range(AxisOptions& axis, const Extent& extent, double margin);

}  // namespace azulejo
