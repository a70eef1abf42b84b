#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "azulejo/data/drawing.h"

namespace azulejo {

/// Dashes and gaps by turns, without end.
///
/// An odd number of lengths is taken twice, as SVG does. Lengths that are negative or not finite count as 0.
class DashPattern {
 public:
  /// `scale` multiplies the style's lengths. None where the lengths sum to 0 or to more than a float holds: a solid line.
  static std::optional<DashPattern> of(const DrawingStyle& style, float scale);

  double period() const { return period_; }
  /// The mean share of a line that is covered by dashes which `extension` makes longer, as caps do.
  float share(double extension) const;

 private:
  friend class DashPosition;
  std::vector<double> lengths_;  ///< an even number
  double period_ = 0;
  double offset_ = 0;  ///< in [0, period)
};

/// A place in the pattern. Dashes of no length are met, too: the place stops there.
class DashPosition {
 public:
  explicit DashPosition(const DashPattern& pattern) : pattern_(&pattern) { restart(); }

  /// Where a line begins.
  void restart();
  bool on() const { return index_ % 2 == 0; }
  /// To the end of the dash or gap.
  double left() const { return left_; }
  /// At most `left()`.
  void advance(double length) { left_ -= length; }
  /// To the next dash or gap.
  void turn();
  /// Any length, by whole periods at once.
  void skip(double length);

 private:
  const DashPattern* pattern_;
  std::size_t index_ = 0;
  double left_ = 0;
};

}  // namespace azulejo
