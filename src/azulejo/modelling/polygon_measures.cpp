#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "azulejo/math/predicates.h"
#include "azulejo/modelling/polygon.h"
#include "azulejo/modelling/sweep_line.h"

namespace azulejo {
namespace {

bool is_finite(const glm::vec2& point) { return std::isfinite(point.x) && std::isfinite(point.y); }
bool all_finite(std::span<const glm::vec2> ring) { return std::all_of(ring.begin(), ring.end(), is_finite); }

std::vector<glm::dvec2> finite_points(std::span<const glm::vec2> ring) {
  std::vector<glm::dvec2> points;
  points.reserve(ring.size());
  for (const glm::vec2& point : ring) {
    if (is_finite(point)) points.emplace_back(point);
  }
  return points;
}

bool comes_before(const glm::vec2& a, const glm::vec2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

/// Sweeps over the sides of a ring whose points are all different: each ends two of them.
class SimpleSweep {
 public:
  explicit SimpleSweep(std::span<const glm::vec2> ring) : ring_(ring), node_of_side_(ring.size(), Line::kEnd) {}

  bool run(std::span<const std::uint32_t> order) {
    return std::all_of(order.begin(), order.end(), [&](std::uint32_t point) { return visit(point); });
  }

 private:
  struct Side {
    glm::dvec2 low;
    glm::dvec2 high;
  };
  using Line = plane::SweepLine<Side>;

  static double place(const Side& side, const glm::dvec2& point) { return orient2d(side.low, side.high, point); }

  /// The sides at a point are that from it, of its own index, and that to it.
  bool visit(std::uint32_t point) {
    const auto count = static_cast<std::uint32_t>(ring_.size());
    const std::uint32_t before = point == 0 ? count - 1 : point - 1;
    const std::uint32_t after = point + 1 == count ? 0 : point + 1;
    const bool from_ends = comes_before(ring_[after], ring_[point]);
    const bool to_ends = comes_before(ring_[before], ring_[point]);
    if (from_ends && to_ends) return end_both(node_of_side_[point], node_of_side_[before]);
    if (!from_ends && !to_ends) return begin_both(point, before, after);
    const std::uint32_t node = node_of_side_[from_ends ? point : before];
    line_[node] = {ring_[point], ring_[from_ends ? before : after]};
    node_of_side_[from_ends ? before : point] = node;
    return apart(line_.below(node), node) && apart(node, line_.above(node));
  }

  bool end_both(std::uint32_t a, std::uint32_t b) {
    if (line_.above(b) == a) std::swap(a, b);
    if (line_.above(a) != b) return false;
    const std::uint32_t below = line_.below(a);
    const std::uint32_t above = line_.above(b);
    line_.erase(a);
    line_.erase(b);
    return apart(below, above);
  }

  bool begin_both(std::uint32_t point, std::uint32_t before, std::uint32_t after) {
    const glm::dvec2 here = ring_[point];
    const std::uint32_t below = line_.last_below([&](const Side& side) { return place(side, here) > 0; });
    const std::uint32_t above = line_.above(below);
    if (above != Line::kEnd && place(line_[above], here) == 0) return false;
    const double turn = orient2d(here, ring_[after], ring_[before]);
    if (turn == 0) return false;
    const std::uint32_t lower = line_.insert_above(below, {here, ring_[turn > 0 ? after : before]});
    const std::uint32_t upper = line_.insert_above(lower, {here, ring_[turn > 0 ? before : after]});
    node_of_side_[point] = turn > 0 ? lower : upper;
    node_of_side_[before] = turn > 0 ? upper : lower;
    return apart(below, lower) && apart(upper, above);
  }

  /// Whether neighbours stay apart up to where the first of them ends.
  bool apart(std::uint32_t lower, std::uint32_t upper) const {
    if (lower == Line::kEnd || upper == Line::kEnd) return true;
    const Side& a = line_[lower];
    const Side& b = line_[upper];
    if (a.high == b.high) return true;
    return comes_before(a.high, b.high) ? place(b, a.high) < 0 : place(a, b.high) > 0;
  }

  std::span<const glm::vec2> ring_;
  Line line_;
  std::vector<std::uint32_t> node_of_side_;
};

glm::dvec3 normal_of(std::span<const glm::vec3> ring) {
  glm::dvec3 normal(0);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    normal += glm::cross(glm::dvec3(ring[i]) - glm::dvec3(ring[0]),
                         glm::dvec3(ring[(i + 1) % ring.size()]) - glm::dvec3(ring[0]));
  }
  return normal;
}

bool collinear(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const auto flat = [](const glm::dvec3& p, int u, int v) { return glm::dvec2(p[u], p[v]); };
  for (const auto& [u, v] : {std::pair(0, 1), std::pair(1, 2), std::pair(2, 0)}) {
    if (orient2d(flat(a, u, v), flat(b, u, v), flat(c, u, v)) != 0) return false;
  }
  return true;
}

bool exactly_planar(std::span<const glm::vec3> ring) {
  std::size_t b = 0;
  while (b < ring.size() && ring[b] == ring[0]) ++b;
  std::size_t c = b;
  while (c < ring.size() && collinear(ring[0], ring[b], ring[c])) ++c;
  if (c >= ring.size()) return true;
  return std::all_of(ring.begin(), ring.end(),
                     [&](const glm::vec3& point) { return orient3d(ring[0], ring[b], ring[c], point) == 0; });
}

}  // namespace

double signed_area(std::span<const glm::vec2> ring) {
  const std::vector<glm::dvec2> points = finite_points(ring);
  double area = 0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const glm::dvec2 a = points[i] - points[0];
    const glm::dvec2 b = points[i + 1] - points[0];
    area += 0.5 * (a.x * b.y - a.y * b.x);
  }
  return area;
}

double signed_area(const Polygon& polygon) {
  double area = 0;
  for (std::size_t r = 0; r < polygon.ring_count(); ++r) area += signed_area(polygon.ring(r));
  return area;
}

glm::dvec2 centroid(std::span<const glm::vec2> ring) {
  const std::vector<glm::dvec2> points = finite_points(ring);
  if (points.empty()) return {0, 0};
  glm::dvec2 by_area(0);
  double area = 0;
  glm::dvec2 by_length(0);
  double length = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec2 a = points[i] - points[0];
    const glm::dvec2 b = points[(i + 1) % points.size()] - points[0];
    const double twice = a.x * b.y - a.y * b.x;
    area += twice;
    by_area += twice * (a + b);
    length += glm::length(b - a);
    by_length += glm::length(b - a) * (a + b);
  }
  if (area != 0) return points[0] + by_area / (3 * area);
  return length > 0 ? points[0] + by_length / (2 * length) : points[0];
}

bool is_convex(std::span<const glm::vec2> ring) {
  if (!all_finite(ring)) return false;
  std::vector<glm::dvec2> points;  // without doubled ones
  for (const glm::vec2& point : ring) {
    if (points.empty() || points.back() != glm::dvec2(point)) points.emplace_back(point);
  }
  while (points.size() > 1 && points.back() == points.front()) points.pop_back();
  const std::size_t count = points.size();
  if (count < 3) return false;
  int direction = 0;
  int reversals = 0;  // of the sweep's direction: two in once around
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec2& a = points[i];
    const glm::dvec2& b = points[(i + 1) % count];
    const glm::dvec2& c = points[(i + 2) % count];
    const double turn = orient2d(a, b, c);
    const int sign = turn > 0 ? 1 : turn < 0 ? -1 : 0;
    if (sign != 0 && direction != 0 && sign != direction) return false;
    if (sign != 0) direction = sign;
    const bool reverses = comes_before(a, b) != comes_before(b, c);
    if (reverses && sign == 0) return false;  // back along itself
    reversals += reverses;
  }
  return direction != 0 && reversals == 2;
}

bool is_simple(std::span<const glm::vec2> ring) {
  if (ring.size() < 3 || !all_finite(ring)) return false;
  std::vector<std::uint32_t> order(ring.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return comes_before(ring[a], ring[b]); });
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (ring[order[i]] == ring[order[i - 1]]) return false;
  }
  return SimpleSweep(ring).run(order);
}

bool is_planar(std::span<const glm::vec3> ring, float tolerance) {
  const bool finite = std::all_of(ring.begin(), ring.end(), [](const glm::vec3& point) {
    return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
  });
  if (!finite) return false;
  if (ring.size() < 4) return true;
  if (!(tolerance > 0)) return exactly_planar(ring);
  glm::dvec3 mean(0);
  for (const glm::vec3& point : ring) mean += glm::dvec3(point) / static_cast<double>(ring.size());
  const glm::dvec3 normal = normal_of(ring);
  const double length = glm::length(normal);
  return std::all_of(ring.begin(), ring.end(), [&](const glm::vec3& point) {
    return std::abs(glm::dot(normal, glm::dvec3(point) - mean)) <= static_cast<double>(tolerance) * length;
  });
}

}  // namespace azulejo
