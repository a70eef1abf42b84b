#include "azulejo/modelling/quick_hull.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "azulejo/core/error.h"
#include "azulejo/math/predicates.h"

namespace azulejo {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFF;
constexpr std::uint32_t kFew = 64;  ///< points that wait at a facet; tuned on spheres, and on cylinders

/// Bits between the largest coordinate and the last bit that any coordinate has; with few of them doubles are exact.
int bits_of(std::span<const glm::vec3> points) {
  int highest = -1000;
  int lowest = 1000;
  for (const glm::vec3& point : points) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto bits = std::bit_cast<std::uint32_t>(point[axis]);
      const auto exponent = static_cast<int>(bits >> 23 & 0xFF);
      const std::uint32_t mantissa = (bits & 0x7FFFFF) | (exponent > 0 ? 0x800000 : 0);
      if (mantissa == 0) continue;
      const int unit = std::max(exponent, 1);
      lowest = std::min(lowest, unit + std::countr_zero(mantissa));
      highest = std::max(highest, unit + static_cast<int>(std::bit_width(mantissa)));
    }
    if (highest - lowest > 24) break;
  }
  return highest - lowest;
}

bool collinear(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return orient2d({a.x, a.y}, {b.x, b.y}, {c.x, c.y}) == 0 && orient2d({a.y, a.z}, {b.y, b.z}, {c.y, c.z}) == 0 &&
         orient2d({a.z, a.x}, {b.z, b.x}, {c.z, c.x}) == 0;
}

class Builder {
 public:
  Builder(std::span<const glm::vec3> points, const Run& run) : points_(points), run_(run) {}

  QuickHull build() {
    QuickHull hull;
    if (points_.empty()) return hull;
    measure();
    hull.simplex = simplex();
    hull.dimension = static_cast<int>(hull.simplex.size()) - 1;
    if (hull.dimension < 3) return hull;
    begin(hull.simplex);
    refine();
    finish();
    store(hull);
    return hull;
  }

 private:
  struct Facet {
    glm::dvec3 normal;  ///< outwards, of twice the area's length
    double bound = 0;   ///< what a distance times that length must exceed to have the right sign
    std::array<std::uint32_t, 3> vertices;
    std::array<std::uint32_t, 3> neighbors;
    std::uint32_t first = kNone;  ///< of the points outside that wait here
    std::uint32_t farthest = kNone;
    double height = 0;          ///< of that
    std::uint32_t waiting = 0;  ///< points
    std::uint32_t seen = 0;
    bool alive = true;
  };

  glm::dvec3 at(std::uint32_t point) const { return points_[point]; }
  std::vector<std::uint32_t> simplex() const;
  void measure();
  void begin(const std::vector<std::uint32_t>& simplex);
  void set_plane(Facet& facet) const;
  bool decide(const Facet& facet, std::uint32_t point, double distance) const;
  /// Whether a point is strictly outside of a facet's plane.
  bool is_outside(const Facet& facet, std::uint32_t point, double& distance) const {
    distance = glm::dot(facet.normal, at(point) - at(facet.vertices[0]));
    if (distance > facet.bound) return true;
    if (distance < -facet.bound) return false;
    return decide(facet, point, distance);
  }
  void put(std::uint32_t facet, std::uint32_t point, double distance);
  std::uint32_t new_facet();
  void see(std::uint32_t point, std::uint32_t from);
  void close_with(std::uint32_t point);
  void hand_on(std::uint32_t point);
  void add_to(std::uint32_t facet);
  void refine();
  void finish();
  void store(QuickHull& hull) const;

  std::span<const glm::vec3> points_;
  const Run& run_;
  glm::dvec3 extent_{0};
  bool exact_ = false;  ///< doubles are
  std::vector<Facet> facets_;
  std::vector<std::uint32_t> free_;
  Array<std::uint32_t> next_;           ///< the next point of the same facet
  Array<std::uint32_t> facet_from_;     ///< of a vertex on the horizon, the new facet whose horizon edge begins there
  std::vector<std::uint32_t> visible_;  ///< facets seen from the new point
  struct Edge {
    std::uint32_t from;
    std::uint32_t to;
    std::uint32_t beyond;  ///< the facet that stays
  };
  std::vector<Edge> horizon_;
  std::vector<std::uint32_t> made_;
  std::uint32_t round_ = 0;
  std::size_t added_ = 0;
};

/// As many independent points as there are, far apart.
std::vector<std::uint32_t> Builder::simplex() const {
  const auto less = [&](std::uint32_t i, std::uint32_t j) {
    const glm::vec3& a = points_[i];
    const glm::vec3& b = points_[j];
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
  };
  const auto count = static_cast<std::uint32_t>(points_.size());
  std::vector<std::uint32_t> found{0, 0};
  for (std::uint32_t i = 1; i < count; ++i) {
    if (less(i, found[0])) found[0] = i;
    if (less(found[1], i)) found[1] = i;
  }
  if (!less(found[0], found[1])) return {0};
  // The farthest by doubles; where that isn't independent, any that is.
  const auto add = [&](auto&& size, auto&& independent) {
    std::uint32_t farthest = 0;
    double most = -1;
    for (std::uint32_t i = 0; i < count; ++i) {
      const double here = size(i);
      if (here > most) {
        most = here;
        farthest = i;
      }
    }
    for (std::uint32_t i = 0; i < count && !independent(farthest); ++i) farthest = i;
    if (!independent(farthest)) return false;
    found.push_back(farthest);
    return true;
  };
  const glm::dvec3 a = at(found[0]);
  const glm::dvec3 b = at(found[1]);
  const auto square = [](const glm::dvec3& v) { return glm::dot(v, v); };
  if (!add([&](std::uint32_t p) { return square(glm::cross(b - a, at(p) - a)); },
           [&](std::uint32_t p) { return !collinear(a, b, at(p)); })) {
    return found;
  }
  Facet front;
  front.vertices = {found[0], found[1], found[2]};
  set_plane(front);
  Facet back;
  back.vertices = {found[0], found[2], found[1]};
  set_plane(back);
  const auto is_apart = [&](std::uint32_t p) {
    double distance = 0;
    return is_outside(front, p, distance) || is_outside(back, p, distance);
  };
  add([&](std::uint32_t p) { return std::abs(glm::dot(front.normal, at(p) - a)); }, is_apart);
  return found;
}

void Builder::measure() {
  glm::vec3 lower = points_[0];
  glm::vec3 upper = points_[0];
  for (const glm::vec3& point : points_) {
    lower = glm::min(lower, point);
    upper = glm::max(upper, point);
  }
  extent_ = glm::dvec3(upper) - glm::dvec3(lower);
  // Differences of 16 bits, products of two with 32, differences of those with 33, the determinant with 51.
  exact_ = bits_of(points_) <= 15;
}

void Builder::set_plane(Facet& facet) const {
  const glm::dvec3 a = at(facet.vertices[0]);
  const glm::dvec3 b = at(facet.vertices[1]) - a;
  const glm::dvec3 c = at(facet.vertices[2]) - a;
  facet.normal = glm::cross(b, c);
  if (exact_) return;
  // Each product of three differences goes through eight roundings at most on its way.
  const glm::dvec3 u = glm::abs(b);
  const glm::dvec3 v = glm::abs(c);
  const glm::dvec3 sums(u.y * v.z + u.z * v.y, u.z * v.x + u.x * v.z, u.x * v.y + u.y * v.x);
  facet.bound = 10 * predicates::kHalfUlp * glm::dot(sums, extent_);
}

/// Where the bound leaves the side open.
bool Builder::decide(const Facet& facet, std::uint32_t point, double distance) const {
  if (exact_) return distance > 0;
  const glm::dvec3 a = at(facet.vertices[0]);
  const glm::dvec3 b = at(facet.vertices[1]);
  const glm::dvec3 c = at(facet.vertices[2]);
  const glm::dvec3 p = at(point);
  // All of the plane and the point with the same coordinate, which is often so.
  for (int axis = 0; axis < 3; ++axis) {
    if (a[axis] == p[axis] && b[axis] == p[axis] && c[axis] == p[axis]) return false;
  }
  return orient3d(a, b, c, p) < 0;
}

void Builder::put(std::uint32_t facet, std::uint32_t point, double distance) {
  Facet& to = facets_[facet];
  if (to.first == kNone || distance > to.height || (!(distance < to.height) && point < to.farthest)) {
    to.farthest = point;
    to.height = distance;
  }
  next_[point] = to.first;
  to.first = point;
  ++to.waiting;
}

void Builder::begin(const std::vector<std::uint32_t>& simplex) {
  next_.resize(points_.size());
  facet_from_.resize(points_.size());
  std::array<std::uint32_t, 4> v{simplex[0], simplex[1], simplex[2], simplex[3]};
  // The fourth is inside of the first three.
  if (orient3d(at(v[0]), at(v[1]), at(v[2]), at(v[3])) < 0) std::swap(v[1], v[2]);
  facets_.resize(4);
  facets_[0].vertices = {v[0], v[1], v[2]};
  facets_[1].vertices = {v[3], v[1], v[0]};
  facets_[2].vertices = {v[3], v[2], v[1]};
  facets_[3].vertices = {v[3], v[0], v[2]};
  facets_[0].neighbors = {1, 2, 3};
  facets_[1].neighbors = {2, 0, 3};
  facets_[2].neighbors = {3, 0, 1};
  facets_[3].neighbors = {1, 0, 2};
  for (Facet& facet : facets_) set_plane(facet);
  for (std::uint32_t p = 0; p < points_.size(); ++p) {
    for (std::uint32_t f = 0; f < 4; ++f) {
      double distance = 0;
      if (!is_outside(facets_[f], p, distance)) continue;
      put(f, p, distance);
      break;
    }
  }
}

std::uint32_t Builder::new_facet() {
  if (free_.empty()) {
    facets_.emplace_back();
    return static_cast<std::uint32_t>(facets_.size() - 1);
  }
  const std::uint32_t facet = free_.back();
  free_.pop_back();
  facets_[facet] = Facet();
  return facet;
}

/// Finds the facets that a point is strictly outside of, and the edges around them. They hang together: moved inwards
/// by next to nothing the point sees the same ones, and none that it lies in the plane of.
void Builder::see(std::uint32_t point, std::uint32_t from) {
  ++round_;
  visible_.assign(1, from);
  horizon_.clear();
  facets_[from].seen = round_;
  facets_[from].alive = false;
  for (std::size_t i = 0; i < visible_.size(); ++i) {
    const auto vertices = facets_[visible_[i]].vertices;
    const auto neighbors = facets_[visible_[i]].neighbors;
    for (std::size_t edge = 0; edge < 3; ++edge) {
      Facet& beyond = facets_[neighbors[edge]];
      if (beyond.seen != round_) {
        double distance = 0;
        beyond.seen = round_;
        if (is_outside(beyond, point, distance)) {
          beyond.alive = false;
          visible_.push_back(neighbors[edge]);
        }
      }
      if (beyond.alive) horizon_.push_back({vertices[edge], vertices[edge == 2 ? 0 : edge + 1], neighbors[edge]});
    }
  }
}

/// A new facet over each edge of the horizon.
void Builder::close_with(std::uint32_t point) {
  made_.clear();
  for (const Edge& edge : horizon_) {
    const std::uint32_t made = new_facet();
    made_.push_back(made);
    Facet& facet = facets_[made];
    facet.vertices = {point, edge.from, edge.to};
    facet.neighbors[1] = edge.beyond;
    set_plane(facet);
    facet_from_[edge.from] = made;
    Facet& beyond = facets_[edge.beyond];
    for (std::size_t i = 0; i < 3; ++i) {
      if (beyond.vertices[i] == edge.to) beyond.neighbors[i] = made;
    }
  }
  for (const std::uint32_t made : made_) {
    const std::uint32_t next = facet_from_[facets_[made].vertices[2]];
    facets_[made].neighbors[2] = next;
    facets_[next].neighbors[0] = made;
  }
}

/// The points that waited at facets that are gone go to new ones, or are inside now.
void Builder::hand_on(std::uint32_t point) {
  for (const std::uint32_t gone : visible_) {
    for (std::uint32_t each = facets_[gone].first; each != kNone;) {
      const std::uint32_t next = next_[each];
      for (std::size_t i = 0; i < made_.size() && each != point; ++i) {
        double distance = 0;
        if (!is_outside(facets_[made_[i]], each, distance)) continue;
        put(made_[i], each, distance);
        break;
      }
      each = next;
    }
    facets_[gone].waiting = 0;
  }
  free_.insert(free_.end(), visible_.rbegin(), visible_.rend());
}

/// Takes in the farthest of the points that wait at a facet.
void Builder::add_to(std::uint32_t facet) {
  if (++added_ % 1024 == 0) check_cancelled(run_);
  const std::uint32_t point = facets_[facet].farthest;
  see(point, facet);
  close_with(point);
  hand_on(point);
}

/// Until few points wait at each facet, in turn all around: else points that come late would see much of what was
/// finished before.
void Builder::refine() {
  std::vector<std::uint32_t> waiting{0, 1, 2, 3};
  std::vector<std::uint32_t> next;
  for (; !waiting.empty(); std::swap(waiting, next)) {
    next.clear();
    for (const std::uint32_t each : waiting) {
      if (facets_[each].waiting <= kFew) continue;
      add_to(each);
      next.insert(next.end(), made_.begin(), made_.end());
    }
  }
}

/// The rest, facet by facet with what comes of it, while that is in the cache.
void Builder::finish() {
  std::vector<std::uint32_t> part;
  for (std::uint32_t facet = 0; facet < facets_.size(); ++facet) {
    part.assign(1, facet);
    while (!part.empty()) {
      const std::uint32_t each = part.back();
      part.pop_back();
      if (facets_[each].waiting == 0) continue;
      add_to(each);
      part.insert(part.end(), made_.begin(), made_.end());
    }
  }
}

void Builder::store(QuickHull& hull) const {
  std::vector<std::uint32_t> place(facets_.size(), kNone);
  std::uint32_t count = 0;
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    if (facets_[f].alive) place[f] = count++;
  }
  hull.facets.reserve(count);
  hull.neighbors.reserve(count);
  for (const Facet& facet : facets_) {
    if (!facet.alive) continue;
    hull.facets.push_back(facet.vertices);
    hull.neighbors.push_back({place[facet.neighbors[0]], place[facet.neighbors[1]], place[facet.neighbors[2]]});
  }
}

}  // namespace

QuickHull quick_hull(std::span<const glm::vec3> points, const Run& run) { return Builder(points, run).build(); }

}  // namespace azulejo
