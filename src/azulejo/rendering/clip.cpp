#include "azulejo/rendering/clip.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

namespace azulejo {
namespace {

using Planes = std::array<glm::dvec4, 6>;

/// Inside is where the product with a plane is not negative. Near and far together leave w ≥ 0.
Planes planes_of(const ScreenTransform& t) {
  const double guard = kGuardBand;
  return {{
      {0, 0, -1, 1},                           // near: z ≤ w
      {0, 0, 1, 0},                            // far: z ≥ 0
      {t.scale_x, 0, 0, guard + t.offset_x},   // left: x · scale + offset · w ≥ −guard · w
      {-t.scale_x, 0, 0, guard - t.offset_x},  // right
      {0, t.scale_y, 0, guard + t.offset_y},   // top
      {0, -t.scale_y, 0, guard - t.offset_y},  // bottom
  }};
}

struct Ring {
  std::array<glm::dvec4, ClippedPolygon::kMost> corners;
  int count = 0;
  void add(const glm::dvec4& corner) {
    if (count < ClippedPolygon::kMost) corners[static_cast<std::size_t>(count++)] = corner;
  }
};

glm::dvec4 cut(const glm::dvec4& inside, double d_inside, const glm::dvec4& outside, double d_outside) {
  return inside + (outside - inside) * (d_inside / (d_inside - d_outside));
}

bool finite(const glm::vec4& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

ScreenVertex project(const glm::dvec4& clip, const ScreenTransform& t) {
  const double inverse = 1.0 / clip.w;
  // Where an edge was cut, rounding may leave its corner a hair beyond the plane.
  const double depth = std::clamp(clip.z * inverse, 0.0, 1.0);
  return {static_cast<float>(clip.x * inverse * t.scale_x + t.offset_x),
          static_cast<float>(clip.y * inverse * t.scale_y + t.offset_y), static_cast<float>(depth),
          static_cast<float>(inverse)};
}

/// Sutherland and Hodgman's, one plane.
Ring clip_ring(const Ring& ring, const glm::dvec4& plane, bool closed) {
  Ring kept;
  for (int i = 0; i < ring.count; ++i) {
    const bool last = i + 1 == ring.count;
    const glm::dvec4& a = ring.corners[static_cast<std::size_t>(i)];
    const double da = glm::dot(a, plane);
    if (da >= 0) kept.add(a);
    if (last && !closed) break;
    const glm::dvec4& b = ring.corners[static_cast<std::size_t>(last ? 0 : i + 1)];
    const double db = glm::dot(b, plane);
    if (da >= 0 && db < 0) kept.add(cut(a, da, b, db));
    if (da < 0 && db >= 0) kept.add(cut(b, db, a, da));
  }
  return kept;
}

ClippedPolygon clip(Ring ring, const ScreenTransform& transform, bool closed, const glm::vec4* originals) {
  const int least = closed ? 3 : 2;
  for (const glm::dvec4& plane : planes_of(transform)) {
    ring = clip_ring(ring, plane, closed);
    if (ring.count < least) return {};
  }
  ClippedPolygon result;
  for (int i = 0; i < ring.count; ++i) {
    const glm::dvec4& corner = ring.corners[static_cast<std::size_t>(i)];
    if (!(corner.w > 0)) return {};
    ScreenVertex vertex = project(corner, transform);
    // A corner of the triangle itself is where its other triangles have it.
    for (int o = 0; o < least; ++o) {
      if (corner == glm::dvec4(originals[o])) {
        const ScreenVertex known = to_screen(originals[o], transform);
        if (!std::isnan(known.x)) vertex = known;
      }
    }
    result.vertices[static_cast<std::size_t>(result.count++)] = vertex;
  }
  return result;
}

}  // namespace

ClippedPolygon clip_triangle(const std::array<glm::vec4, 3>& corners, const ScreenTransform& transform) {
  Ring ring;
  for (const glm::vec4& corner : corners) {
    if (!finite(corner)) return {};
    ring.add(glm::dvec4(corner));
  }
  return clip(ring, transform, true, corners.data());
}

ClippedPolygon clip_segment(const std::array<glm::vec4, 2>& ends, const ScreenTransform& transform) {
  Ring ring;
  for (const glm::vec4& end : ends) {
    if (!finite(end)) return {};
    ring.add(glm::dvec4(end));
  }
  return clip(ring, transform, false, ends.data());
}

}  // namespace azulejo
