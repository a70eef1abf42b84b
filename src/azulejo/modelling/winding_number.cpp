#include "azulejo/modelling/winding_number.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "azulejo/modelling/closed_surface.h"
#include "azulejo/modelling/closest_point.h"
#include "azulejo/modelling/exact_crossing.h"
#include "azulejo/modelling/free_cells.h"
#include "azulejo/modelling/self_intersections.h"
#include "azulejo/modelling/solid_angles.h"
#include "azulejo/modelling/triangle_tree.h"

namespace azulejo {
namespace {

bool is_finite(const glm::vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// Triangles in the order of a tree over them.
struct Ordered {
  TriangleTree tree;
  std::vector<SurfaceTriangle> triangles;

  Ordered(const std::vector<SurfaceTriangle>& unordered, const Run& run) : tree(boxes_of(unordered, run), run) {
    triangles.reserve(unordered.size());
    for (const std::uint32_t each : tree.order()) triangles.push_back(unordered[each]);
  }
};

/// A box with all that is so near to a point.
Box3 around_of(const glm::vec3& point, float distance) {
  Box3 box{point, point};
  if (!(distance > 0)) return box;
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    box.lower[axis] = std::nextafter(point[axis] - distance, -kInfinity);
    box.upper[axis] = std::nextafter(point[axis] + distance, kInfinity);
  }
  return box;
}

/// How often the way from a point along x leaves a surface, less how often it enters.
int crossings(const Ordered& surface, const glm::vec3& p) {
  int sum = 0;
  surface.tree.visit_leaves(
      [&](const Box3& box) {
        return box.lower.y <= p.y && p.y <= box.upper.y && box.lower.z <= p.z && p.z <= box.upper.z &&
               p.x <= box.upper.x;
      },
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const SurfaceTriangle& t = surface.triangles[i];
          if (std::max({t[0].y, t[1].y, t[2].y}) < p.y || std::min({t[0].y, t[1].y, t[2].y}) > p.y ||
              std::max({t[0].z, t[1].z, t[2].z}) < p.z || std::min({t[0].z, t[1].z, t[2].z}) > p.z ||
              std::max({t[0].x, t[1].x, t[2].x}) < p.x) {
            continue;
          }
          sum += crossing_along_x(glm::dvec3(p), t);
        }
      });
  return sum;
}

}  // namespace

struct WindingNumber::Parts {
  std::size_t open_edges;
  bool summed;  ///< face by face, without ways
  Ordered surface;
  Ordered lids;
  SolidAngles angles;  ///< of the lids, or of the surface
  FreeCells cells;     ///< that neither is in, with the whole number there

  Parts(const ClosedSurface& closed, const WindingNumberOptions& options, const Run& run)
      : open_edges(closed.open_edges),
        summed(closed.lids.size() > closed.triangles.size() / 2),
        surface(closed.triangles, run),
        lids(summed ? std::vector<SurfaceTriangle>() : closed.lids, run),
        angles(summed ? closed.triangles : closed.lids, std::max(double{options.accuracy}, 1.0), run),
        cells(
            {surface.triangles, lids.triangles}, options.points,
            [this](const glm::vec3& point) { return summed ? 0 : whole(point); }, run) {}

  int whole(const glm::vec3& point) const { return crossings(surface, point) + crossings(lids, point); }
};

WindingNumber::WindingNumber(const Mesh& mesh, const WindingNumberOptions& options, const Run& run)
    : parts_(std::make_unique<const Parts>(closed_surface(mesh, run), options, run)) {}
WindingNumber::~WindingNumber() = default;
WindingNumber::WindingNumber(WindingNumber&&) noexcept = default;
WindingNumber& WindingNumber::operator=(WindingNumber&&) noexcept = default;

std::size_t WindingNumber::open_edges() const { return parts_->open_edges; }

double WindingNumber::operator()(const glm::vec3& point) const {
  if (!is_finite(point)) return 0;
  const Parts& parts = *parts_;
  if (parts.summed) return parts.angles(glm::dvec3(point));
  const std::optional<int> known = parts.cells.find(point);
  return (known ? *known : parts.whole(point)) - parts.angles(glm::dvec3(point));
}

bool WindingNumber::is_near(const glm::vec3& point, float distance) const {
  if (!is_finite(point)) return false;
  if (!(distance > 0) && parts_->cells.find(point)) return false;
  const Ordered& surface = parts_->surface;
  const Box3 around = around_of(point, distance);
  const glm::dvec3 p(point);
  bool found = false;
  surface.tree.visit_leaves([&](const Box3& box) { return !found && TriangleTree::meet(box, around); },
                            [&](std::size_t begin, std::size_t end) {
                              for (std::size_t i = begin; i < end && !found; ++i) {
                                const SurfaceTriangle& t = surface.triangles[i];
                                const std::array<glm::dvec3, 3> corners{t[0], t[1], t[2]};
                                found = distance > 0 ? closest_point(p, corners).squared <= double{distance} * distance
                                                     : triangles_meet(corners, {p, p, p});
                              }
                            });
  return found;
}

}  // namespace azulejo
