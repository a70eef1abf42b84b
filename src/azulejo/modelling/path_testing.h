#pragma once

#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "azulejo/data/drawing.h"
#include "azulejo/modelling/flat_path.h"

/// What tests of paths, lines and points share.
namespace azulejo {

inline PathView view_of(const Path& path) { return {path.commands, path.points}; }

inline double distance_to_segment(const glm::dvec2& point, const glm::dvec2& from, const glm::dvec2& to) {
  const glm::dvec2 along = to - from;
  const double square = glm::dot(along, along);
  const double share = square > 0 ? glm::clamp(glm::dot(point - from, along) / square, 0.0, 1.0) : 0;
  return glm::length(point - (from + share * along));
}

inline double cross_of(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// The integral of the winding number.
inline double signed_area(const FlatPath& path) {
  double area = 0;
  for (std::size_t c = 0; c < path.contour_count(); ++c) {
    const auto contour = path.contour(c);
    for (std::size_t i = 0; i < contour.size(); ++i) {
      area += cross_of(contour[i], contour[(i + 1) % contour.size()]) / 2;
    }
  }
  return area;
}

/// How often a contour, closed, turns around a point.
inline int winding_of(const FlatPath& path, std::size_t contour_index, const glm::dvec2& point) {
  int winding = 0;
  const auto contour = path.contour(contour_index);
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const glm::dvec2 a = contour[i];
    const glm::dvec2 b = contour[(i + 1) % contour.size()];
    if ((a.y <= point.y) == (b.y <= point.y)) continue;
    const double side = cross_of(b - a, point - a);
    if (a.y <= point.y && side > 0) ++winding;
    if (a.y > point.y && side < 0) --winding;
  }
  return winding;
}

/// How often all contours do.
inline int winding_at(const FlatPath& path, const glm::dvec2& point) {
  int winding = 0;
  for (std::size_t c = 0; c < path.contour_count(); ++c) winding += winding_of(path, c, point);
  return winding;
}

inline double distance_to_outline(const FlatPath& path, const glm::dvec2& point) {
  double nearest = 1e300;
  for (std::size_t c = 0; c < path.contour_count(); ++c) {
    const auto contour = path.contour(c);
    for (std::size_t i = 0; i < contour.size(); ++i) {
      nearest = std::fmin(nearest, distance_to_segment(point, contour[i], contour[(i + 1) % contour.size()]));
    }
  }
  return nearest;
}

}  // namespace azulejo
