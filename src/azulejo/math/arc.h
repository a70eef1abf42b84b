#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "azulejo/core/export.h"

namespace azulejo {

/// A part of an ellipse: center + c · x + s · y, for unit vectors (c, s) from `first` to `last`.
struct EllipticalArc {
  glm::dvec2 center{0, 0};
  glm::dvec2 x{1, 0};  ///< half axes, any two vectors
  glm::dvec2 y{0, 1};
  glm::dvec2 first{1, 0};
  glm::dvec2 last{1, 0};
  bool forward = true;  ///< turns from x to y
  bool whole = false;   ///< all around; else, where first and last are equal, nothing
};

/// What SVG's path command A says: the arc from one point to another of an ellipse with these radii, whose x axis is
/// turned by `turns` from the page's x to its y axis.
///
/// large    more than half of it
/// forward  turns from the page's x to its y axis: SVG's sweep flag
/// radii    their signs don't count; too small ones are enlarged until the ellipse reaches
/// Result   nothing where SVG draws a line: a radius of 0, equal ends; or where a number is not finite
/// Same     + − × ÷ √ only
/// Source   SVG 1.1, F.6.5 and F.6.6
AZULEJO_EXPORT std::optional<EllipticalArc> arc_between(const glm::dvec2& from, const glm::dvec2& to, glm::dvec2 radii,
                                                        double turns, bool large, bool forward);

/// The arc around a center that begins at an angle and runs on by `sweep`, both in turns from x to y (± 1 and beyond:
/// the whole ellipse); the axes are turned by `turns`. |angles| < 10⁶ turns; within 10⁻⁹ of them.
AZULEJO_EXPORT EllipticalArc arc_around(const glm::dvec2& center, const glm::dvec2& radii, double turns, double first,
                                        double sweep);

/// The arc as 1, 2, 4, … 64 cubics of equal angles, whose points are within `tolerance` of it (the larger half axis
/// × 2/27 sin⁶(θ/4) ÷ cos²(θ/4) for pieces of angle θ), the ends of pieces on it. Nothing for an arc that is nothing.
/// Source: Goldapp, Approximation of circular arcs by cubic polynomials, 1991 (the one that touches)
AZULEJO_EXPORT std::vector<std::array<glm::dvec2, 4>> arc_to_cubics(const EllipticalArc& arc, double tolerance);

}  // namespace azulejo
