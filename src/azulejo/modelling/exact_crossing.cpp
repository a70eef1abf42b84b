#include "azulejo/modelling/exact_crossing.h"

#include <glm/vec2.hpp>

#include "azulejo/math/predicates.h"

namespace azulejo {
namespace {

/// The sign of orient2d where p is moved by (ε, ε²).
int moved_side(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
  const double side = orient2d(a, b, p);
  if (side != 0) return side > 0 ? 1 : -1;
  if (a.y != b.y) return a.y < b.y ? -1 : 1;
  return a.x < b.x ? 1 : a.x > b.x ? -1 : 0;
}

}  // namespace

bool lies_behind(const glm::dvec3& point, const SurfaceTriangle& triangle) {
  const glm::dvec3 a(triangle[0]);
  const glm::dvec3 b(triangle[1]);
  const glm::dvec3 c(triangle[2]);
  const double side = orient3d(a, b, c, point);
  if (side != 0) return side > 0;
  const double y = orient2d({a.z, a.x}, {b.z, b.x}, {c.z, c.x});  // components of the normal
  if (y != 0) return y < 0;
  const double z = orient2d({a.x, a.y}, {b.x, b.y}, {c.x, c.y});
  if (z != 0) return z < 0;
  return orient2d({a.y, a.z}, {b.y, b.z}, {c.y, c.z}) < 0;
}

int crossing_along_x(const glm::dvec3& point, const SurfaceTriangle& triangle) {
  const glm::dvec2 p(point.y, point.z);
  const glm::dvec2 a(triangle[0].y, triangle[0].z);
  const glm::dvec2 b(triangle[1].y, triangle[1].z);
  const glm::dvec2 c(triangle[2].y, triangle[2].z);
  const int side = moved_side(a, b, p);
  if (side == 0 || moved_side(b, c, p) != side || moved_side(c, a, p) != side) return 0;
  // The front looks along x where it is seen to turn counter-clockwise: the way goes out there.
  return lies_behind(point, triangle) == (side > 0) ? side : 0;
}

}  // namespace azulejo
