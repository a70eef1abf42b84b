#include "azulejo/rendering/pixel_area.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "azulejo/rendering/coverage_scan.h"
#include "azulejo/rendering/outline_edges.h"

namespace azulejo {
namespace {

constexpr std::size_t kFewEdges = 10;
constexpr std::size_t kExactEdges = 64;
constexpr std::size_t kCutAtCrossings = 4;
constexpr int kStrips = 64;
constexpr int kFineStrips = 32;
constexpr double kUnit = 1.0 / kEdgeOne;

bool is_inside(int winding, FillRule rule) { return rule == FillRule::NonZero ? winding != 0 : (winding & 1) != 0; }

/// A fold of the sum of windings by the rule is right only between two neighbors; by non-zero, also away from 0.
bool may_fold(int lowest, int highest, FillRule rule) {
  return highest - lowest <= 1 || (rule == FillRule::NonZero && (lowest >= 1 || highest <= -1));
}

using GridPlace = std::array<std::int32_t, 2>;
GridPlace begin_of(const PixelEdge& edge) { return {edge.xa, edge.ya}; }
GridPlace end_of(const PixelEdge& edge) { return {edge.xb, edge.yb}; }

/// Which side of an edge a place is on: positive to the right of it, looking down. Coordinates have 16 bits at most.
std::int64_t side_of(const PixelEdge& edge, const GridPlace& place) {
  return std::int64_t{place[0] - edge.xa} * (edge.yb - edge.ya) -
         std::int64_t{place[1] - edge.ya} * (edge.xb - edge.xa);
}

/// Whether a place on the line of an edge is on the edge, but at none of its ends.
bool is_within(const PixelEdge& edge, const GridPlace& place) {
  if (place == begin_of(edge) || place == end_of(edge)) return false;
  return std::min(edge.xa, edge.xb) <= place[0] && place[0] <= std::max(edge.xa, edge.xb) && edge.ya <= place[1] &&
         place[1] <= edge.yb;
}

/// Whether edges have a point in common beside common ends.
bool meet(const PixelEdge& a, const PixelEdge& b) {
  const std::int64_t begin = side_of(a, begin_of(b));
  const std::int64_t end = side_of(a, end_of(b));
  if ((begin > 0 && end > 0) || (begin < 0 && end < 0)) return false;
  const std::int64_t other_begin = side_of(b, begin_of(a));
  const std::int64_t other_end = side_of(b, end_of(a));
  if ((other_begin > 0 && other_end > 0) || (other_begin < 0 && other_end < 0)) return false;
  if (begin != 0 && end != 0 && other_begin != 0 && other_end != 0) return true;
  if (begin == 0 && end == 0) {
    const bool same = (begin_of(a) == begin_of(b) && end_of(a) == end_of(b)) ||
                      (begin_of(a) == end_of(b) && end_of(a) == begin_of(b));
    if (same) return true;
  }
  return (begin == 0 && is_within(a, begin_of(b))) || (end == 0 && is_within(a, end_of(b))) ||
         (other_begin == 0 && is_within(b, begin_of(a))) || (other_end == 0 && is_within(b, end_of(a)));
}

}  // namespace

int PixelArea::winding_at(double y) const {
  int winding = first_winding_;
  for (const Entry& entry : entries_) {
    if (entry.y < y) winding += entry.change;
  }
  return winding;
}

double PixelArea::cut(std::span<const Line> lines, double top, double bottom, FillRule rule) {
  std::array<double, kCutAtCrossings * kCutAtCrossings + 1> levels{};
  std::size_t count = 0;
  double area = 0;
  double from = top;
  if (crossings_.size() <= kCutAtCrossings) {
    for (std::size_t i = 0; i < crossings_.size(); ++i) {
      for (std::size_t j = i + 1; j < crossings_.size(); ++j) {
        const double above = crossings_[j].top - crossings_[i].top;
        const double below = crossings_[j].bottom - crossings_[i].bottom;
        if (above * below < 0) levels[count++] = top + (bottom - top) * (above / (above - below));
      }
    }
    std::sort(levels.begin(), levels.begin() + static_cast<std::ptrdiff_t>(count));
    levels[count++] = bottom;
    for (std::size_t i = 0; i < count; ++i) {
      const double to = std::clamp(levels[i], from, bottom);
      area += area_of(lines, from, to, rule, false);
      from = to;
    }
    return area;
  }
  const int parts = std::max(2, static_cast<int>(std::ceil((bottom - top) * kFineStrips)));
  for (int i = 1; i <= parts; ++i) {
    const double to = i == parts ? bottom : top + (bottom - top) * i / parts;
    area += area_of(lines, from, to, rule, false);
    from = to;
  }
  return area;
}

double PixelArea::area_of(std::span<const Line> lines, double top, double bottom, FillRule rule, bool may_cut) {
  const double height = bottom - top;
  if (!(height > 0)) return 0;
  const double middle = 0.5 * (top + bottom);
  crossings_.clear();
  for (const Line& line : lines) {
    if (!(line.top < middle && middle < line.bottom)) continue;
    const double above = line.x + (top - line.top) * line.slope;
    const double below = line.x + (bottom - line.top) * line.slope;
    crossings_.push_back({0.5 * (above + below), above, below, line.sign});
  }
  std::sort(crossings_.begin(), crossings_.end(), [](const Crossing& a, const Crossing& b) {
    return a.middle != b.middle ? a.middle < b.middle : a.sign < b.sign;
  });
  if (may_cut) {
    // Rounding of x must not look like a crossing.
    constexpr double kSlack = 1e-9;
    for (std::size_t i = 1; i < crossings_.size(); ++i) {
      const Crossing& a = crossings_[i - 1];
      const Crossing& b = crossings_[i];
      if (a.top > b.top + kSlack || a.bottom > b.bottom + kSlack) return cut(lines, top, bottom, rule);
    }
  }
  int winding = winding_at(middle);
  double inside = 0;
  double left = 0;
  for (const Crossing& crossing : crossings_) {
    const double x = std::clamp(crossing.middle, 0.0, 1.0);
    if (is_inside(winding, rule)) inside += x - left;
    winding += crossing.sign;
    left = x;
  }
  if (is_inside(winding, rule)) inside += 1 - left;
  return inside * height;
}

/// Edges that meet at their ends only have one winding number along each side: all that there are in the pixel.
bool PixelArea::is_simple(std::span<const PixelEdge> edges, FillRule rule) const {
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = i + 1; j < edges.size(); ++j) {
      if (meet(edges[i], edges[j])) return false;
    }
  }
  int lowest = std::numeric_limits<int>::max();
  int highest = std::numeric_limits<int>::min();
  for (const PixelEdge& edge : edges) {
    // Windings at the left of its middle, in doubled units; of a level one, above it and below it.
    const GridPlace middle{edge.xa + edge.xb, edge.ya + edge.yb};
    int above = first_winding_;
    int below = first_winding_;
    for (const Entry& entry : entries_) {
      if (entry.y < middle[1] * (0.5 * kUnit)) above += entry.change;
      if (entry.y <= middle[1] * (0.5 * kUnit)) below += entry.change;
    }
    for (const PixelEdge& other : edges) {
      if (&other == &edge || other.level() || middle[1] < 2 * other.ya || middle[1] > 2 * other.yb) continue;
      const PixelEdge doubled{2 * other.xa, 2 * other.ya, 2 * other.xb, 2 * other.yb, other.sign};
      if (side_of(doubled, middle) <= 0) continue;
      if (middle[1] > 2 * other.ya) above += other.sign;
      if (middle[1] < 2 * other.yb) below += other.sign;
    }
    const int right = edge.level() ? above : below + edge.sign;
    lowest = std::min({lowest, below, right});
    highest = std::max({highest, below, right});
  }
  return may_fold(lowest, highest, rule);
}

bool PixelArea::looks_simple(std::span<const PixelEdge> edges, FillRule rule) {
  for (Array<LineCrossing>& line : lines_) line.clear();
  constexpr std::int32_t kStep = kEdgeOne / kLines;
  for (const PixelEdge& edge : edges) {
    if (edge.level()) continue;
    // Lines are in the middle of each sixteenth.
    const auto line_below = [](std::int32_t y) {
      return static_cast<std::int32_t>((static_cast<std::uint32_t>(y) + kStep / 2 - 1) / kStep);
    };
    const std::int32_t first = line_below(edge.ya);
    const std::int32_t last = line_below(edge.yb);
    if (first == last) continue;
    const float slope = static_cast<float>(edge.xb - edge.xa) / static_cast<float>(edge.yb - edge.ya);
    for (std::int32_t line = first; line < last; ++line) {
      const std::int32_t down = line * kStep + kStep / 2 - edge.ya;
      lines_[static_cast<std::size_t>(line)].push_back(
          {static_cast<float>(edge.xa) + slope * static_cast<float>(down), edge.sign});
    }
  }
  int lowest = std::numeric_limits<int>::max();
  int highest = std::numeric_limits<int>::min();
  for (int i = 0; i < kLines; ++i) {
    Array<LineCrossing>& line = lines_[static_cast<std::size_t>(i)];
    std::sort(line.begin(), line.end(),
              [](const LineCrossing& a, const LineCrossing& b) { return a.x != b.x ? a.x < b.x : a.sign < b.sign; });
    int winding = winding_at((i + 0.5) / kLines);
    lowest = std::min(lowest, winding);
    highest = std::max(highest, winding);
    for (const LineCrossing& crossing : line) {
      winding += crossing.sign;
      lowest = std::min(lowest, winding);
      highest = std::max(highest, winding);
    }
    if (!may_fold(lowest, highest, rule)) return false;
  }
  return true;
}

/// Strip by strip, with the lines that pass each.
double PixelArea::exact_area(FillRule rule) {
  levels_.assign({0.0, 1.0});
  for (const Entry& entry : entries_) levels_.push_back(entry.y);
  for (const Line& line : edges_) levels_.insert(levels_.end(), {line.top, line.bottom});
  std::sort(levels_.begin(), levels_.end());
  levels_.erase(std::unique(levels_.begin(), levels_.end()), levels_.end());
  std::sort(edges_.begin(), edges_.end(), [](const Line& a, const Line& b) { return a.top < b.top; });
  passing_.clear();
  double area = 0;
  std::size_t next = 0;
  for (std::size_t i = 1; i < levels_.size(); ++i) {
    const double top = levels_[i - 1];
    const double bottom = levels_[i];
    passing_.erase(
        std::remove_if(passing_.begin(), passing_.end(), [&](const Line& line) { return line.bottom <= top; }),
        passing_.end());
    for (; next < edges_.size() && edges_[next].top <= top; ++next) passing_.push_back(edges_[next]);
    area += area_of(passing_, top, bottom, rule, true);
  }
  return area;
}

float PixelArea::inside(std::span<const PixelEdge> edges, std::int32_t signed_area, FillRule rule) {
  entries_.clear();
  std::int64_t own = 0;      // in units of the grid, squared and halved
  std::int64_t entered = 0;  // in units of the grid
  const auto enter = [&](std::int32_t y, int change) {
    entries_.push_back({y * kUnit, change});
    entered += std::int64_t{change} * (kEdgeOne - y);
  };
  for (const PixelEdge& edge : edges) {
    if (edge.xa == 0) enter(edge.ya, -edge.sign);
    if (edge.xb == 0) enter(edge.yb, edge.sign);
    own += std::int64_t{edge.sign * (edge.yb - edge.ya)} * (2 * kEdgeOne - edge.xa - edge.xb);
  }
  first_winding_ = static_cast<int>(std::lround(signed_area * 0x1p-16 - static_cast<double>(own) * 0.5 * kUnit * kUnit -
                                                static_cast<double>(entered) * kUnit));
  const bool simple = edges.size() > kFewEdges ? looks_simple(edges, rule) : is_simple(edges, rule);
  if (simple) return kernels::inside_of(signed_area, rule);
  edges_.clear();
  for (const PixelEdge& edge : edges) {
    if (edge.level()) continue;
    const double slope = static_cast<double>(edge.xb - edge.xa) / static_cast<double>(edge.yb - edge.ya);
    edges_.push_back({edge.ya * kUnit, edge.yb * kUnit, edge.xa * kUnit, slope, edge.sign});
  }
  double area = 0;
  if (edges.size() > kExactEdges) {
    constexpr double kHeight = 1.0 / kStrips;
    for (int i = 0; i < kStrips; ++i) area += area_of(edges_, i * kHeight, (i + 1) * kHeight, rule, false);
  } else {
    area = exact_area(rule);
  }
  return static_cast<float>(std::clamp(area, 0.0, 1.0));
}

}  // namespace azulejo
