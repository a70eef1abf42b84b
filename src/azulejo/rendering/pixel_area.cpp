#include "azulejo/rendering/pixel_area.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "azulejo/rendering/outline_edges.h"

namespace azulejo {
namespace {

constexpr std::size_t kExactEdges = 64;
constexpr std::size_t kCutAtCrossings = 4;
constexpr int kStrips = 64;
constexpr int kFineStrips = 32;
constexpr double kUnit = 1.0 / kEdgeOne;

bool is_inside(int winding, FillRule rule) { return rule == FillRule::NonZero ? winding != 0 : (winding & 1) != 0; }

double x_at(const PixelEdge& edge, double y) {
  const double top = edge.ya * kUnit;
  return edge.xa * kUnit + (y - top) * static_cast<double>(edge.xb - edge.xa) / static_cast<double>(edge.yb - edge.ya);
}

}  // namespace

int PixelArea::winding_at(double y) const {
  int winding = first_winding_;
  for (const Entry& entry : entries_) {
    if (entry.y < y) winding += entry.change;
  }
  return winding;
}

double PixelArea::cut(std::span<const PixelEdge> edges, double top, double bottom, FillRule rule) {
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
      area += area_of(edges, from, to, rule, false);
      from = to;
    }
    return area;
  }
  const int parts = std::max(2, static_cast<int>(std::ceil((bottom - top) * kFineStrips)));
  for (int i = 1; i <= parts; ++i) {
    const double to = i == parts ? bottom : top + (bottom - top) * i / parts;
    area += area_of(edges, from, to, rule, false);
    from = to;
  }
  return area;
}

double PixelArea::area_of(std::span<const PixelEdge> edges, double top, double bottom, FillRule rule, bool may_cut) {
  const double height = bottom - top;
  if (!(height > 0)) return 0;
  const double middle = 0.5 * (top + bottom);
  crossings_.clear();
  for (const PixelEdge& edge : edges) {
    if (edge.level() || !(edge.ya * kUnit < middle && middle < edge.yb * kUnit)) continue;
    const double above = x_at(edge, top);
    const double below = x_at(edge, bottom);
    crossings_.push_back({0.5 * (above + below), above, below, edge.sign});
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
      if (a.top > b.top + kSlack || a.bottom > b.bottom + kSlack) return cut(edges, top, bottom, rule);
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

float PixelArea::inside(std::span<const PixelEdge> edges, std::int32_t signed_area, FillRule rule) {
  entries_.clear();
  levels_.clear();
  double own = 0;
  double entered = 0;
  const auto enter = [&](std::int32_t y, int change) {
    entries_.push_back({y * kUnit, change});
    entered += change * (1 - y * kUnit);
  };
  levels_.insert(levels_.end(), {0.0, 1.0});
  for (const PixelEdge& edge : edges) {
    const bool first_is_start = edge.sign > 0;
    if (edge.xa == 0) enter(edge.ya, first_is_start ? -1 : 1);
    if (edge.xb == 0) enter(edge.yb, first_is_start ? 1 : -1);
    if (edge.xa == 0) levels_.push_back(edge.ya * kUnit);
    if (edge.xb == 0) levels_.push_back(edge.yb * kUnit);
    if (edge.level()) continue;
    levels_.insert(levels_.end(), {edge.ya * kUnit, edge.yb * kUnit});
    own += edge.sign * (edge.yb - edge.ya) * kUnit * (1 - 0.5 * (edge.xa + edge.xb) * kUnit);
  }
  first_winding_ = static_cast<int>(std::lround(signed_area * 0x1p-16 - own - entered));
  double area = 0;
  if (edges.size() > kExactEdges) {
    for (int i = 0; i < kStrips; ++i)
      area += area_of(edges, i * (1.0 / kStrips), (i + 1) * (1.0 / kStrips), rule, false);
  } else {
    std::sort(levels_.begin(), levels_.end());
    levels_.erase(std::unique(levels_.begin(), levels_.end()), levels_.end());
    for (std::size_t i = 1; i < levels_.size(); ++i) area += area_of(edges, levels_[i - 1], levels_[i], rule, true);
  }
  return static_cast<float>(std::clamp(area, 0.0, 1.0));
}

}  // namespace azulejo
