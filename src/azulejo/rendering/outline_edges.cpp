#include "azulejo/rendering/outline_edges.h"

#include <algorithm>
#include <cmath>

namespace azulejo {
namespace {

bool is_finite(const glm::vec2& point) { return std::isfinite(point.x) && std::isfinite(point.y); }

std::int32_t on_grid(double coordinate) { return static_cast<std::int32_t>(std::floor(coordinate * kEdgeOne + 0.5)); }

}  // namespace

void EdgeGatherer::add_contour(std::span<const glm::vec2> points) {
  add_lines(points);
  const auto first = std::find_if(points.begin(), points.end(), is_finite);
  const auto last = std::find_if(points.rbegin(), points.rend(), is_finite);
  if (first != points.end() && last != points.rend()) add_line(*last, *first);
  ++chain_;
  direction_ = 0;
}

void EdgeGatherer::add_lines(std::span<const glm::vec2> points) {
  const glm::vec2* before = nullptr;
  for (const glm::vec2& point : points) {
    if (!is_finite(point)) continue;
    if (before != nullptr) add_line(*before, point);
    before = &point;
  }
}

void EdgeGatherer::add_line(const glm::vec2& from, const glm::vec2& to) {
  const auto inside = [&](const glm::vec2& p) {
    return p.x >= 0 && p.y >= 0 && double{p.x} <= width_ && double{p.y} <= height_;
  };
  if (inside(from) && inside(to)) {
    add_edge(from.x, from.y, to.x, to.y);
  } else {
    add_clipped(from.x, from.y, to.x, to.y);
  }
}

void EdgeGatherer::add_clipped(double x0, double y0, double x1, double y1) {
  if ((y0 <= 0 && y1 <= 0) || (y0 >= height_ && y1 >= height_)) return;
  if (std::max(x0, x1) >= width_) reaches_right_ = true;
  if (std::min(x0, x1) >= width_) return;
  const double from_x = x0;
  const double from_y = y0;
  const double dx = x1 - x0;
  const double dy = y1 - y0;
  const auto x_at = [&](double y) { return from_x + (y - from_y) * (dx / dy); };
  const auto y_at = [&](double x) { return from_y + (x - from_x) * (dy / dx); };
  const auto clip_y = [&](double& x, double& y) {
    const double limit = y < 0 ? 0 : height_;
    if (y >= 0 && y <= height_) return;
    x = x_at(limit);
    y = limit;
  };
  clip_y(x0, y0);
  clip_y(x1, y1);
  const auto within = [&](double y) { return std::clamp(y, std::min(y0, y1), std::max(y0, y1)); };
  if (x0 <= 0 && x1 <= 0) return add_edge(0, y0, 0, y1);
  if (x0 < 0) {
    const double y = within(y_at(0));
    add_edge(0, y0, 0, y);
    x0 = 0;
    y0 = y;
  }
  const double left_y = x1 < 0 ? within(y_at(0)) : y1;
  const double left_x = std::max(x1, 0.0);
  if (x0 < width_ || left_x < width_) {
    const double start_y = x0 > width_ ? within(y_at(width_)) : y0;
    const double end_y = left_x > width_ ? within(y_at(width_)) : left_y;
    add_edge(std::min(x0, width_), start_y, std::min(left_x, width_), end_y);
  }
  if (x1 < 0) add_edge(0, left_y, 0, y1);
}

void EdgeGatherer::turn(bool down) {
  const int direction = down ? 1 : -1;
  if (direction_ == -direction) ++chain_;
  direction_ = direction;
}

void EdgeGatherer::add_edge(double x0, double y0, double x1, double y1) {
  OutlineEdge edge{on_grid(x0), on_grid(y0), on_grid(x1), on_grid(y1), 0};
  if (edge.y0 == edge.y1 && edge.x0 == edge.x1) return;
  if (edge.y0 != edge.y1) turn(edge.y1 > edge.y0);
  edge.chain = chain_ & 0x7FFFFFFFU;
  edges_.push_back(edge);
}

bool is_convex(std::span<const OutlineEdge> edges) {
  if (edges.empty()) return true;
  const auto sign = [](std::int64_t value) { return value > 0 ? 1 : value < 0 ? -1 : 0; };
  int turning = 0;
  int turns_of_y = 0;
  const OutlineEdge* before = &edges.back();
  int way = 0;
  for (std::size_t i = edges.size(); way == 0 && i-- > 0;) way = sign(edges[i].y1 - edges[i].y0);
  for (const OutlineEdge& edge : edges) {
    if (edge.x0 != before->x1 || edge.y0 != before->y1) return false;
    const std::int64_t cross = std::int64_t{before->x1 - before->x0} * (edge.y1 - edge.y0) -
                               std::int64_t{before->y1 - before->y0} * (edge.x1 - edge.x0);
    const int turn = sign(cross);
    if (turn * turning < 0) return false;
    if (turn != 0) turning = turn;
    const int now = sign(edge.y1 - edge.y0);
    if (now != 0 && now != way) {
      ++turns_of_y;
      way = now;
    }
    before = &edge;
  }
  return turns_of_y <= 2;
}

Rect pixels_of(std::span<const OutlineEdge> edges) {
  if (edges.empty()) return {};
  std::int32_t left = edges[0].x0;
  std::int32_t right = left;
  std::int32_t top = edges[0].y0;
  std::int32_t bottom = top;
  for (const OutlineEdge& edge : edges) {
    left = std::min({left, edge.x0, edge.x1});
    right = std::max({right, edge.x0, edge.x1});
    top = std::min({top, edge.y0, edge.y1});
    bottom = std::max({bottom, edge.y0, edge.y1});
  }
  const std::int32_t up = kEdgeOne - 1;
  const int x = left >> kEdgeBits;
  const int y = top >> kEdgeBits;
  return {x, y, ((right + up) >> kEdgeBits) - x, ((bottom + up) >> kEdgeBits) - y};
}

}  // namespace azulejo
