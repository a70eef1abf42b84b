#pragma once

#include <glm/vec3.hpp>

#include "azulejo/modelling/closed_surface.h"

namespace azulejo {

/// Whether a point lies behind a triangle's front, where its corners turn counter-clockwise, exactly. What is in
/// its plane counts as moved by (0, ε, ε²), then by ε³ along x: the same for all triangles, so that sums of them jump
/// nowhere.
bool lies_behind(const glm::dvec3& point, const SurfaceTriangle& triangle);

/// Of a way from a point along x, moved in the same manner: 1 where it leaves a triangle by its front, −1 where it enters
/// there, else 0. Exact.
int crossing_along_x(const glm::dvec3& point, const SurfaceTriangle& triangle);

}  // namespace azulejo
