#include "azulejo/modelling/oriented_box.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "azulejo/core/parallel.h"
#include "azulejo/modelling/hull_candidates.h"
#include "azulejo/modelling/plane_hull.h"
#include "azulejo/modelling/quick_hull.h"

namespace azulejo {
namespace {

constexpr std::size_t kMostCandidates = 100'000;
constexpr std::size_t kMostFaces = 500;
constexpr std::size_t kLooks = 2'000'000;
constexpr int kMostSteps = 20;

/// Two directions at right angles to a third, right-handed with it.
std::array<glm::dvec3, 2> across(const glm::dvec3& axis) {
  const glm::dvec3 size = glm::abs(axis);
  const glm::dvec3 other = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                           : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                                : glm::dvec3(0, 0, 1);
  const glm::dvec3 first = glm::normalize(glm::cross(axis, other));
  return {first, glm::cross(axis, first)};
}

/// The corners of the hull, or what is nearly as few, about the first point; and directions across its largest faces.
struct Outline {
  std::vector<glm::dvec3> points;
  std::vector<glm::dvec3> directions;
};

Outline outline_of(std::span<const glm::vec3> points, const Run& run) {
  std::vector<glm::vec3> kept;
  for (const std::uint32_t i : hull_candidates(points, run)) kept.push_back(points[i]);
  const glm::dvec3 origin(points[0]);
  Outline outline;
  if (kept.size() > kMostCandidates) {
    for (const glm::vec3& p : kept) outline.points.push_back(glm::dvec3(p) - origin);
    return outline;
  }
  const QuickHull hull = quick_hull(kept, run);
  if (hull.dimension < 3) {
    for (const glm::vec3& p : kept) outline.points.push_back(glm::dvec3(p) - origin);
    if (hull.dimension == 2) {
      const glm::dvec3 a(kept[hull.simplex[0]]);
      const glm::dvec3 normal =
          glm::cross(glm::dvec3(kept[hull.simplex[1]]) - a, glm::dvec3(kept[hull.simplex[2]]) - a);
      outline.directions.push_back(glm::normalize(normal));
    } else if (hull.dimension == 1) {
      outline.directions.push_back(
          glm::normalize(glm::dvec3(kept[hull.simplex[1]]) - glm::dvec3(kept[hull.simplex[0]])));
    }
    return outline;
  }
  std::vector<std::uint8_t> is_corner(kept.size(), 0);
  std::vector<glm::dvec3> normals;
  for (const auto& facet : hull.facets) {
    for (const std::uint32_t corner : facet) is_corner[corner] = 1;
    const glm::dvec3 a(kept[facet[0]]);
    normals.push_back(glm::cross(glm::dvec3(kept[facet[1]]) - a, glm::dvec3(kept[facet[2]]) - a));
  }
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (is_corner[i] != 0) outline.points.push_back(glm::dvec3(kept[i]) - origin);
  }
  std::stable_sort(normals.begin(), normals.end(),
                   [](const glm::dvec3& a, const glm::dvec3& b) { return glm::dot(a, a) > glm::dot(b, b); });
  const std::size_t most = std::min(kMostFaces, kLooks / outline.points.size());
  for (std::size_t i = 0; i < std::min(most, normals.size()) && glm::dot(normals[i], normals[i]) > 0; ++i) {
    outline.directions.push_back(glm::normalize(normals[i]));
  }
  return outline;
}

/// The direction of the side of the smallest rectangle around a convex polygon: one of its sides lies on an edge.
glm::dvec2 side_of_smallest_rectangle(const std::vector<glm::dvec2>& hull) {
  glm::dvec2 best(1, 0);
  double best_area = std::numeric_limits<double>::infinity();
  const std::size_t count = hull.size();
  std::array<std::size_t, 3> farthest{};  // along the side, across it, against it
  for (std::size_t e = 0; e < count; ++e) {
    const glm::dvec2 edge = hull[(e + 1) % count] - hull[e];
    if (!(glm::dot(edge, edge) > 0)) continue;
    const glm::dvec2 side = glm::normalize(edge);
    const glm::dvec2 normal(-side.y, side.x);
    const std::array<glm::dvec2, 3> directions{side, normal, -side};
    for (std::size_t k = 0; k < 3; ++k) {
      std::size_t& at = farthest[k];
      if (e == 0) at = k == 0 ? 1 % count : farthest[k - 1];
      // The calipers go on while the next corner is farther, around once at most.
      for (std::size_t steps = 0; steps < count; ++steps) {
        if (!(glm::dot(directions[k], hull[(at + 1) % count] - hull[at]) > 0)) break;
        at = (at + 1) % count;
      }
    }
    const double area =
        glm::dot(side, hull[farthest[0]] - hull[farthest[2]]) * glm::dot(normal, hull[farthest[1]] - hull[e]);
    if (area < best_area) {
      best_area = area;
      best = side;
    }
  }
  return best;
}

OrientedBox box_along(const std::vector<glm::dvec3>& points, const glm::dvec3& axis, const Run& run) {
  const auto plane = across(axis);
  double largest = 1e-300;
  for (const glm::dvec3& p : points) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  // As floats, which plane_hull takes exactly; sizes are measured below.
  std::vector<glm::vec2> seen;
  for (const glm::dvec3& p : points) {
    seen.emplace_back(glm::dot(p, plane[0]) / largest, glm::dot(p, plane[1]) / largest);
  }
  std::vector<glm::dvec2> hull;
  for (const std::uint32_t i : plane_hull(seen, run)) hull.emplace_back(seen[i]);
  const glm::dvec2 side = side_of_smallest_rectangle(hull);
  OrientedBox box;
  box.axes = {axis, plane[0] * side.x + plane[1] * side.y, plane[1] * side.x - plane[0] * side.y};
  glm::dvec3 lower(std::numeric_limits<double>::infinity());
  glm::dvec3 upper = -lower;
  for (const glm::dvec3& p : points) {
    const glm::dvec3 place(glm::dot(p, box.axes[0]), glm::dot(p, box.axes[1]), glm::dot(p, box.axes[2]));
    lower = glm::min(lower, place);
    upper = glm::max(upper, place);
  }
  box.size = upper - lower;
  const glm::dvec3 middle = (lower + upper) * 0.5;
  box.center = box.axes[0] * middle.x + box.axes[1] * middle.y + box.axes[2] * middle.z;
  return box;
}

/// Whether a box is clearly smaller: rounding doesn't decide.
bool smaller(const OrientedBox& a, const OrientedBox& b) {
  constexpr double kClearly = 1 - 1e-12;
  if (a.volume() < b.volume() * kClearly) return true;
  if (b.volume() < a.volume() * kClearly) return false;
  const auto surface = [](const OrientedBox& box) {
    return box.size.x * box.size.y + box.size.y * box.size.z + box.size.z * box.size.x;
  };
  if (surface(a) < surface(b) * kClearly) return true;
  if (surface(b) < surface(a) * kClearly) return false;
  return (a.size.x + a.size.y) + a.size.z < ((b.size.x + b.size.y) + b.size.z) * kClearly;
}

}  // namespace

OrientedBox oriented_box(std::span<const glm::vec3> points, std::span<const glm::dvec3> directions, const Run& run) {
  OrientedBox best;
  if (points.empty()) return best;
  Outline outline = outline_of(points, run);
  outline.directions.insert(outline.directions.begin(), directions.begin(), directions.end());
  std::vector<OrientedBox> boxes(outline.directions.size());
  Run alone = run;
  alone.threads = 1;
  parallel_tasks(boxes.size(), run,
                 [&](std::size_t i, int) { boxes[i] = box_along(outline.points, outline.directions[i], alone); });
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (i == 0 || smaller(boxes[i], best)) best = boxes[i];
  }
  // Its other axes may have smaller boxes along them.
  for (int steps = 0; steps < kMostSteps; ++steps) {
    const OrientedBox last = best;
    for (const glm::dvec3& axis : {last.axes[1], last.axes[2]}) {
      if (const OrientedBox box = box_along(outline.points, axis, run); smaller(box, best)) best = box;
    }
    if (!smaller(best, last)) break;
  }
  best.center += glm::dvec3(points[0]);
  return best;
}

}  // namespace azulejo
