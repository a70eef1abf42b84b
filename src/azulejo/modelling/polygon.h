#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/drawing.h"

namespace azulejo {

/// Closed rings in a plane, whose inside a fill rule tells: outlines and holes, in any number, order and direction,
/// crossing and touching themselves and each other.
struct Polygon {
  std::vector<glm::vec2> points;           ///< ring after ring; the last point of a ring is joined to its first
  std::vector<std::uint32_t> ring_begins;  ///< the first point of each ring

  std::size_t ring_count() const { return ring_begins.size(); }
  std::span<const glm::vec2> ring(std::size_t index) const {
    const std::size_t end = index + 1 < ring_begins.size() ? ring_begins[index + 1] : points.size();
    return {points.data() + ring_begins[index], end - ring_begins[index]};
  }
  void add_ring(std::span<const glm::vec2> ring) {
    ring_begins.push_back(static_cast<std::uint32_t>(points.size()));
    points.insert(points.end(), ring.begin(), ring.end());
  }
};

/// What is computed with polygons is computed on a grid of floats: its step is the power of two between 2⁻²⁴ and 2⁻²³
/// of the largest coordinate. Points are rounded to it, by at most half a step (not at all if they are whole multiples,
/// such as integers below 2²⁴ are); lines that cross are joined at a point of the grid, and move by less than a step
/// there. From there on everything is exact, so that what is said below holds for the very floats of the result.
///
/// NaN, infinite  a point with such a coordinate is left out of its ring
/// degenerate     rings of fewer than three points, without area, doubled points, lines back and forth: no area, nothing
/// Throws         Error(Resource) where lines cross so often that it takes more than run.limits.memory_bytes;
///                Error(Cancelled)
/// Cost           O((n + k) log n), k crossings

/// Triangles that cover the inside of a polygon exactly once.
struct TriangulatedPolygon {
  Array<glm::vec2> points;
  Array<std::uint32_t> corners;  ///< three a triangle, counter-clockwise with y up (clockwise with y down)
};

/// Every triangle has an area; edges of the polygon are edges of triangles; no triangle has a point of another in its
/// side. Without crossings every point of the polygon is there, and no other.
/// Source  see plane_triangulate.h
AZULEJO_EXPORT TriangulatedPolygon tessellate(const Polygon& polygon, FillRule rule = FillRule::NonZero,
                                              const Run& run = {});

/// The same inside as rings that are simple, don't cross and touch in points only: outer ones counter-clockwise with
/// y up (clockwise with y down), holes the other way; both rules say the same of it.
AZULEJO_EXPORT Polygon simplified(const Polygon& polygon, FillRule rule = FillRule::NonZero, const Run& run = {});

enum class BooleanMode : std::uint8_t { Union, Intersection, Difference, Xor };
constexpr std::array<std::string_view, 4> enum_names(BooleanMode) {
  return {"union", "intersection", "difference", "xor"};
}

/// Of the insides of two polygons, by the non-zero rule: what is in one of them, in both, in the first alone, in exactly
/// one. Rings as `simplified` gives them.
AZULEJO_EXPORT Polygon boolean(const Polygon& a, const Polygon& b, BooleanMode mode, const Run& run = {});

/// Measures of one ring, in doubles from its own points (nothing is rounded to a grid).
/// Positive where it turns counter-clockwise with y up; of a ring that crosses itself, areas by winding number.
AZULEJO_EXPORT double signed_area(std::span<const glm::vec2> ring);
/// Of the area; where there is none, of the line; of no points, (0, 0).
AZULEJO_EXPORT glm::dvec2 centroid(std::span<const glm::vec2> ring);
/// Sum of the rings' signed areas.
AZULEJO_EXPORT double signed_area(const Polygon& polygon);

/// Whether a ring turns one way only, and once around; points along a side and doubled points are allowed. Exact.
/// False without area, or with a coordinate that isn't finite.
AZULEJO_EXPORT bool is_convex(std::span<const glm::vec2> ring);
/// Whether a ring doesn't meet itself: no two sides have a point in common but neighbours their end, no side is without
/// length. Exact. False for fewer than three points, or with a coordinate that isn't finite. Cost O(n log n)
AZULEJO_EXPORT bool is_simple(std::span<const glm::vec2> ring);
/// Whether the points of a ring in space lie within `tolerance` of a plane: with 0, exactly in any plane; else in that
/// through their mean, across the ring's normal (M. Newell's). True for what lies on a line; false with a coordinate
/// that isn't finite.
AZULEJO_EXPORT bool is_planar(std::span<const glm::vec3> ring, float tolerance = 0);

}  // namespace azulejo
