#include "azulejo/charting/axis.h"

#include <algorithm>

namespace azulejo {
namespace {

constexpr double kLargest = 1e300;
constexpr double kSmallest = 1e-290;  // what is nearer to 0 counts as 0
constexpr double kNarrowest = 1e-9;   // of the numbers: narrower ranges are widened to this

}  // namespace

Extent extent_of(std::span<const double> values, AxisScale scale) {
  Extent extent;
  const double least = scale == AxisScale::Log ? kSmallest : -kLargest;
  for (const double value : values) {
    if (value >= least && value <= kLargest) extent.add(value);
  }
  return extent;
}

void fit_range(AxisOptions& axis, const Extent& extent, double margin) {
  if (axis.scale == AxisScale::Log) {
    axis.low = extent.empty() ? 1 : std::clamp(extent.low, kSmallest, kLargest);
    axis.high = extent.empty() ? 10 : std::clamp(extent.high, kSmallest, kLargest);
    const double ratio = axis.high / axis.low;
    const double room = ratio < 1.0001 ? 2 : std::pow(ratio, margin);
    axis.low = std::max(axis.low / room, kSmallest);
    axis.high = std::min(axis.high * room, kLargest);
    return;
  }
  axis.low = extent.empty() ? 0 : std::clamp(extent.low, -kLargest, kLargest);
  axis.high = extent.empty() ? 1 : std::clamp(extent.high, -kLargest, kLargest);
  const double largest = std::max(std::abs(axis.low), std::abs(axis.high));
  if (!(axis.high - axis.low > std::max(kNarrowest * largest, kSmallest))) {
    const double room = largest > kSmallest ? largest * 0.1 : 0.5;
    axis.low -= room;
    axis.high += room;
    return;
  }
  const double room = (axis.high - axis.low) * margin;
  // Values of one sign don't make the axis cross 0.
  axis.low = axis.low >= 0 ? std::max(0.0, axis.low - room) : axis.low - room;
  axis.high = axis.high <= 0 ? std::min(0.0, axis.high + room) : axis.high + room;
}

}  // namespace azulejo
