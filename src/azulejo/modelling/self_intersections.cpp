#include "azulejo/modelling/self_intersections.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/math/predicates.h"
#include "azulejo/modelling/triangle_tree.h"
#include "azulejo/modelling/triangulate.h"

namespace azulejo {
namespace {

constexpr std::size_t kTriangles = std::size_t{1} << 11;  ///< of one task
constexpr std::size_t kMostPairs = std::size_t{1} << 24;
using Triangle = std::array<glm::dvec3, 3>;

int sign(double value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

glm::dvec2 along(const glm::dvec3& p, int axis) { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

/// An axis along which the triangle is seen with an area; −1: it has none.
int open_axis(const Triangle& t) {
  for (int axis = 0; axis < 3; ++axis) {
    if (orient2d(along(t[0], axis), along(t[1], axis), along(t[2], axis)) != 0) return axis;
  }
  return -1;
}

bool in_box(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  for (int axis = 0; axis < 3; ++axis) {
    if (p[axis] < std::min(a[axis], b[axis]) || p[axis] > std::max(a[axis], b[axis])) return false;
  }
  return true;
}

bool collinear(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) { return open_axis({a, b, c}) < 0; }

/// Whether segments that lie in one plane have a point in common.
bool segments_meet(const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& a, const glm::dvec3& b, int axis) {
  const glm::dvec2 p2 = along(p, axis);
  const glm::dvec2 q2 = along(q, axis);
  const glm::dvec2 a2 = along(a, axis);
  const glm::dvec2 b2 = along(b, axis);
  const int sides[4] = {sign(orient2d(p2, q2, a2)), sign(orient2d(p2, q2, b2)), sign(orient2d(a2, b2, p2)),
                        sign(orient2d(a2, b2, q2))};
  if (sides[0] * sides[1] < 0 && sides[2] * sides[3] < 0) return true;
  return (sides[0] == 0 && in_box(a, p, q)) || (sides[1] == 0 && in_box(b, p, q)) ||
         (sides[2] == 0 && in_box(p, a, b)) || (sides[3] == 0 && in_box(q, a, b));
}

/// Whether a point of a triangle's plane is in it, as seen along an axis.
bool in_triangle(const glm::dvec3& p, const Triangle& t, int axis) {
  int lowest = 1;
  int highest = -1;
  for (int i = 0; i < 3; ++i) {
    const int side = sign(orient2d(along(t[static_cast<std::size_t>(i)], axis),
                                   along(t[static_cast<std::size_t>((i + 1) % 3)], axis), along(p, axis)));
    lowest = std::min(lowest, side);
    highest = std::max(highest, side);
  }
  return lowest >= 0 || highest <= 0;
}

/// Whether a segment and a triangle with an area have a point in common.
bool segment_meets(const glm::dvec3& p, const glm::dvec3& q, const Triangle& t, int axis) {
  const int of_p = sign(orient3d(t[0], t[1], t[2], p));
  const int of_q = sign(orient3d(t[0], t[1], t[2], q));
  if (of_p * of_q > 0) return false;
  if (of_p == 0 && in_triangle(p, t, axis)) return true;
  if (of_q == 0 && in_triangle(q, t, axis)) return true;
  if (of_p == 0 && of_q == 0) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (segments_meet(p, q, t[i], t[(i + 1) % 3], axis)) return true;
    }
    return false;
  }
  if (of_p == 0 || of_q == 0) return false;
  int lowest = 1;
  int highest = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    const int side = sign(orient3d(p, q, t[i], t[(i + 1) % 3]));
    lowest = std::min(lowest, side);
    highest = std::max(highest, side);
  }
  return lowest >= 0 || highest <= 0;
}

/// The ends of what three points on a line span.
std::array<glm::dvec3, 2> span_of(const Triangle& t) {
  const auto less = [](const glm::dvec3& a, const glm::dvec3& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
  };
  const auto [lowest, highest] = std::minmax_element(t.begin(), t.end(), less);
  return {*lowest, *highest};
}

/// Whether segments anywhere have a point in common.
bool segments_meet_anywhere(const std::array<glm::dvec3, 2>& a, const std::array<glm::dvec3, 2>& b) {
  if (orient3d(a[0], a[1], b[0], b[1]) != 0) return false;
  for (const Triangle& t : {Triangle{a[0], a[1], b[0]}, Triangle{a[0], a[1], b[1]}, Triangle{b[0], b[1], a[0]}}) {
    if (const int axis = open_axis(t); axis >= 0) return segments_meet(a[0], a[1], b[0], b[1], axis);
  }
  // All on one line, or a point.
  return (collinear(a[0], a[1], b[0]) && in_box(b[0], a[0], a[1])) ||
         (collinear(a[0], a[1], b[1]) && in_box(b[1], a[0], a[1])) ||
         (collinear(b[0], b[1], a[0]) && in_box(a[0], b[0], b[1]));
}

}  // namespace

bool triangles_meet(const Triangle& a, const Triangle& b) {
  const int axis_a = open_axis(a);
  const int axis_b = open_axis(b);
  if (axis_a < 0 && axis_b < 0) return segments_meet_anywhere(span_of(a), span_of(b));
  if (axis_a < 0) {
    const auto ends = span_of(a);
    return segment_meets(ends[0], ends[1], b, axis_b);
  }
  if (axis_b < 0) {
    const auto ends = span_of(b);
    return segment_meets(ends[0], ends[1], a, axis_a);
  }
  // One plane of them often has the other triangle on one side.
  const auto apart = [](const Triangle& plane, const Triangle& other) {
    const int first = sign(orient3d(plane[0], plane[1], plane[2], other[0]));
    return first != 0 && first == sign(orient3d(plane[0], plane[1], plane[2], other[1])) &&
           first == sign(orient3d(plane[0], plane[1], plane[2], other[2]));
  };
  if (apart(a, b) || apart(b, a)) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (segment_meets(a[i], a[(i + 1) % 3], b, axis_b) || segment_meets(b[i], b[(i + 1) % 3], a, axis_a)) return true;
  }
  return false;
}

bool triangles_meet_beside_corner(const Triangle& a, const Triangle& b) {
  // What they share is a point, or a segment or an area with an end on the far edge of one of them.
  const int axis_a = open_axis(a);
  const int axis_b = open_axis(b);
  if (axis_a < 0 || axis_b < 0) return false;
  return segment_meets(a[1], a[2], b, axis_b) || segment_meets(b[1], b[2], a, axis_a);
}

bool triangles_meet_beside_edge(const Triangle& a, const Triangle& b) {
  const int axis = open_axis(a);
  if (axis < 0 || orient3d(a[0], a[1], a[2], b[2]) != 0) return false;
  const glm::dvec2 from = along(a[0], axis);
  const glm::dvec2 to = along(a[1], axis);
  return sign(orient2d(from, to, along(a[2], axis))) * sign(orient2d(from, to, along(b[2], axis))) > 0;
}

namespace {

class Search {
 public:
  Search(const Mesh& mesh, std::span<const std::uint32_t> welded, const Run& run)
      : mesh_(mesh), welded_(welded), parts_(triangulate(mesh, run)), boxes_(parts_.face.size()) {
    parallel_for(boxes_.size(), kTriangles, run, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) boxes_[t] = box_of(t);
    });
  }

  std::vector<std::array<std::uint32_t, 2>> pairs(std::uint32_t from, std::size_t most_looks, const Run& run) {
    const auto first =
        static_cast<std::size_t>(std::lower_bound(parts_.face.begin(), parts_.face.end(), from) - parts_.face.begin());
    const TriangleTree tree(boxes_, run);
    std::vector<std::vector<std::array<std::uint32_t, 2>>> parts((boxes_.size() + kTriangles - 1) / kTriangles);
    std::atomic<std::size_t> total = 0;
    std::atomic<std::size_t> looks = 0;
    parallel_for(boxes_.size(), kTriangles, run, [&](std::size_t begin, std::size_t end) {
      std::vector<std::array<std::uint32_t, 2>>& part = parts[begin / kTriangles];
      for (std::size_t t = std::max(begin, first); t < end; ++t) {
        if (boxes_[t].empty() || too_many_) continue;
        std::size_t looked = 0;
        tree.visit(boxes_[t], [&](std::uint32_t other) {
          if (!(other > t || other < first) || !TriangleTree::meet(boxes_[other], boxes_[t])) return;
          ++looked;
          if (meets(static_cast<std::uint32_t>(t), other)) {
            part.push_back(
                {std::min(parts_.face[t], parts_.face[other]), std::max(parts_.face[t], parts_.face[other])});
          }
        });
        if ((looks += looked) > most_looks) too_many_ = true;
      }
      if (total += part.size(); total > kMostPairs) {
        throw Error(Error::Resource, "self-intersections: more than 16777216 pairs of faces meet");
      }
    });
    std::vector<std::array<std::uint32_t, 2>> all;
    for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  /// More pairs than were to be looked at.
  bool gave_up() const { return too_many_; }

 private:
  std::uint32_t vertex(std::size_t triangle, std::size_t corner) const {
    return mesh_.corners[parts_.corners[3 * triangle + corner]];
  }
  std::uint32_t place(std::size_t triangle, std::size_t corner) const { return welded_[vertex(triangle, corner)]; }
  glm::dvec3 at(std::size_t triangle, std::size_t corner) const {
    return glm::dvec3(mesh_.positions[vertex(triangle, corner)]);
  }

  /// Empty where a coordinate is not finite or corners are equal.
  Box3 box_of(std::size_t triangle) const {
    Box3 box;
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::vec3& p = mesh_.positions[vertex(triangle, i)];
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return {};
      if (place(triangle, i) == place(triangle, (i + 1) % 3)) return {};
      box = united(box, p);
    }
    return box;
  }

  bool meets(std::uint32_t t, std::uint32_t u) const {
    if (parts_.face[t] == parts_.face[u]) return false;
    // Common corners come first.
    std::array<std::size_t, 3> of_t{0, 1, 2};
    std::array<std::size_t, 3> of_u{0, 1, 2};
    std::size_t common = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = common; j < 3; ++j) {
        if (place(t, of_t[i]) != place(u, of_u[j])) continue;
        std::swap(of_u[common], of_u[j]);
        std::swap(of_t[common], of_t[i]);
        ++common;
        break;
      }
    }
    if (common == 3) return false;
    const Triangle a{at(t, of_t[0]), at(t, of_t[1]), at(t, of_t[2])};
    const Triangle b{at(u, of_u[0]), at(u, of_u[1]), at(u, of_u[2])};
    return common == 0   ? triangles_meet(a, b)
           : common == 1 ? triangles_meet_beside_corner(a, b)
                         : triangles_meet_beside_edge(a, b);
  }

  const Mesh& mesh_;
  std::span<const std::uint32_t> welded_;
  Triangulation parts_;
  std::vector<Box3> boxes_;
  std::atomic<bool> too_many_ = false;
};

}  // namespace

std::vector<std::array<std::uint32_t, 2>> self_intersections(const Mesh& mesh, std::span<const std::uint32_t> welded,
                                                             const Run& run) {
  return Search(mesh, welded, run).pairs(0, std::numeric_limits<std::size_t>::max(), run);
}

std::optional<std::vector<std::array<std::uint32_t, 2>>> self_intersections_from(std::uint32_t from,
                                                                                 std::size_t most_looks,
                                                                                 const Mesh& mesh,
                                                                                 std::span<const std::uint32_t> welded,
                                                                                 const Run& run) {
  Search search(mesh, welded, run);
  auto pairs = search.pairs(from, most_looks, run);
  if (search.gave_up()) return std::nullopt;
  return pairs;
}

}  // namespace azulejo
