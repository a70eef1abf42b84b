#include "azulejo/modelling/solid_angles.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "azulejo/core/parallel.h"
#include "azulejo/math/arctangent.h"
#include "azulejo/modelling/exact_crossing.h"

namespace azulejo {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 12;

/// A sum of angles between −π and π, which are those of complex numbers, in turns: one arctangent for all.
class Turns {
 public:
  void add(double re, double im) {
    // Half a turn is put aside whenever it can be, and what is left stays on the right, where nothing wraps.
    if (re < 0) turn_back(re, im);
    const double product = re_ * re - im_ * im;
    im_ = re_ * im + im_ * re;
    re_ = product;
    if (re_ < 0) turn_back(re_, im_);
    const double size = re_ + std::abs(im_);
    if (size > 0) {
      re_ /= size;
      im_ /= size;
    }
  }
  double sum() const {
    return turns_ + static_cast<double>(atan2_deterministic(static_cast<float>(im_), static_cast<float>(re_))) /
                        (2 * std::numbers::pi);
  }

 private:
  void turn_back(double& re, double& im) {
    turns_ += std::signbit(im) ? -0.5 : 0.5;
    re = -re;
    im = -im;
  }
  double re_ = 1;
  double im_ = 0;
  double turns_ = 0;
};

/// The same for a point on an edge: beside it, where it counts as moved to, the triangle is a half-plane.
void add_at_edge(const glm::dvec3& point, const SurfaceTriangle& triangle, Turns& turns) {
  std::size_t at = 0;
  double least = 2;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 a = glm::dvec3(triangle[i]) - point;
    const glm::dvec3 b = glm::dvec3(triangle[(i + 1) % 3]) - point;
    const double opposite = glm::dot(a, b) / (glm::length(a) * glm::length(b));
    if (opposite >= least) continue;
    least = opposite;
    at = i;
  }
  const glm::dvec3 from(triangle[at]);
  const glm::dvec3 edge = glm::dvec3(triangle[(at + 1) % 3]) - from;
  const auto across_edge = [&](const glm::dvec3& v) { return v - edge * (glm::dot(v, edge) / glm::dot(edge, edge)); };
  const glm::dvec3 inwards = across_edge(glm::dvec3(triangle[(at + 2) % 3]) - from);
  const glm::dvec3 moved = across_edge(edge.x == 0 && edge.z == 0 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0));
  const double product = glm::length(inwards) * glm::length(moved);
  if (!(product > 0)) return;  // the triangle is a line
  const double cosine = std::clamp(glm::dot(inwards, moved) / product, -1.0, 1.0);
  const double sine = std::sqrt(1 - cosine * cosine);
  turns.add(-cosine, lies_behind(point, triangle) ? sine : -sine);
}

/// Adds half the solid angle of a triangle.
void add_triangle(const glm::dvec3& point, const SurfaceTriangle& triangle, Turns& turns) {
  const glm::dvec3 a = glm::dvec3(triangle[0]) - point;
  const glm::dvec3 b = glm::dvec3(triangle[1]) - point;
  const glm::dvec3 c = glm::dvec3(triangle[2]) - point;
  const double la = std::sqrt(glm::dot(a, a));
  const double lb = std::sqrt(glm::dot(b, b));
  const double lc = std::sqrt(glm::dot(c, c));
  const double product = la * lb * lc;
  if (!(product > 0)) return;  // at a corner, where it is whatever one likes
  const double across = glm::dot(a, glm::cross(b, c)) / product;
  const double along = 1 + (glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb) / product;
  if (std::abs(along) < 1e-13 && std::abs(across) < 1e-13) return add_at_edge(point, triangle, turns);
  // On the triangle, or nearly: the side is what counts, half a turn or half a turn back.
  const bool near = along < 0 && std::abs(across) < 1e-9;
  const double size = std::abs(across);
  turns.add(along, near ? (lies_behind(point, triangle) ? size : -size) : across);
}

/// What is needed to make clusters only.
struct Gathered {
  Box3 box;
  glm::dvec3 weighted{0, 0, 0};  ///< sum of the centroids, each times its area's size
  double weight = 0;
  double radius = 0;
};

glm::dvec3 area_of(const SurfaceTriangle& t) {
  const glm::dvec3 a(t[0]);
  return 0.5 * glm::cross(glm::dvec3(t[1]) - a, glm::dvec3(t[2]) - a);
}

glm::dvec3 centroid_of(const SurfaceTriangle& t) {
  return (glm::dvec3(t[0]) + glm::dvec3(t[1]) + glm::dvec3(t[2])) / 3.0;
}

/// The middle of what was gathered, and how far it reaches from there at most.
glm::dvec3 middle_of(Gathered& all) {
  if (all.box.empty()) return glm::dvec3(0);
  const glm::dvec3 middle = all.weight > 0 ? all.weighted / all.weight : glm::dvec3(all.box.center());
  all.radius =
      glm::length(glm::max(glm::abs(glm::dvec3(all.box.lower) - middle), glm::abs(glm::dvec3(all.box.upper) - middle)));
  return middle;
}

void add_spread(std::array<double, 6>& spread, const glm::dvec3& from_middle, const glm::dvec3& area) {
  for (int i = 0; i < 3; ++i) {
    const int next = (i + 1) % 3;
    spread[static_cast<std::size_t>(i)] += from_middle[i] * area[i];
    spread[static_cast<std::size_t>(3 + i)] += from_middle[i] * area[next] + from_middle[next] * area[i];
  }
}

}  // namespace

SolidAngles::SolidAngles(const std::vector<SurfaceTriangle>& triangles, double accuracy, const Run& run)
    : tree_(boxes_of(triangles, run), run) {
  triangles_.reserve(triangles.size());
  for (const std::uint32_t each : tree_.order()) triangles_.push_back(triangles[each]);
  make_clusters(accuracy, run);
}

std::span<const SurfaceTriangle> SolidAngles::leaf(std::size_t node) const {
  const std::size_t begin = std::min((node - tree_.leaves()) * TriangleTree::kLeaf, triangles_.size());
  return std::span(triangles_).subspan(begin, std::min(TriangleTree::kLeaf, triangles_.size() - begin));
}

void SolidAngles::make_clusters(double accuracy, const Run& run) {
  const std::size_t leaves = tree_.leaves();
  clusters_.resize(2 * leaves);
  std::vector<Gathered> gathered(2 * leaves);
  const auto make_leaf = [&](std::size_t node) {
    Gathered& all = gathered[node];
    Cluster& cluster = clusters_[node];
    for (const SurfaceTriangle& t : leaf(node)) {
      const glm::dvec3 area = area_of(t);
      const double size = glm::length(area);
      all.weight += size;
      all.weighted += size * centroid_of(t);
      cluster.area += area;
      for (const glm::vec3& corner : t) all.box = united(all.box, corner);
    }
    cluster.middle = middle_of(all);
    for (const SurfaceTriangle& t : leaf(node)) {
      add_spread(cluster.spread, centroid_of(t) - cluster.middle, area_of(t));
    }
  };
  const auto make_node = [&](std::size_t node) {
    Gathered& all = gathered[node];
    Cluster& cluster = clusters_[node];
    for (const std::size_t child : {2 * node, 2 * node + 1}) {
      all.box = united(all.box, gathered[child].box);
      all.weight += gathered[child].weight;
      all.weighted += gathered[child].weighted;
      cluster.area += clusters_[child].area;
    }
    cluster.middle = middle_of(all);
    double radius = 0;
    for (const std::size_t child : {2 * node, 2 * node + 1}) {
      if (gathered[child].box.empty()) continue;
      const glm::dvec3 apart = clusters_[child].middle - cluster.middle;
      radius = std::max(radius, gathered[child].radius + glm::length(apart));
      for (std::size_t i = 0; i < 6; ++i) cluster.spread[i] += clusters_[child].spread[i];
      add_spread(cluster.spread, apart, clusters_[child].area);
    }
    all.radius = std::min(all.radius, radius);
  };
  parallel_for(leaves, kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t node = leaves + begin; node < leaves + end; ++node) make_leaf(node);
  });
  for (std::size_t node = leaves; node-- > 1;) make_node(node);
  for (std::size_t node = 1; node < gathered.size(); ++node) {
    const double reach = accuracy * gathered[node].radius;
    clusters_[node].reach = reach * reach;
  }
}

/// away  from the point to the middle; squared, its length
double SolidAngles::far_angle(const Cluster& cluster, const glm::dvec3& away, double squared) {
  const double inverse = 1 / squared;
  const double cube = inverse * std::sqrt(inverse);
  const std::array<double, 6>& s = cluster.spread;
  const double along = s[0] * away.x * away.x + s[1] * away.y * away.y + s[2] * away.z * away.z +
                       s[3] * away.x * away.y + s[4] * away.y * away.z + s[5] * away.z * away.x;
  return cube * (glm::dot(cluster.area, away) + (s[0] + s[1] + s[2]) - 3 * along * inverse);
}

double SolidAngles::operator()(const glm::dvec3& point) const {
  if (triangles_.empty()) return 0;
  Turns turns;
  double far = 0;
  std::uint32_t waiting[2 * 32];
  int count = 0;
  waiting[count++] = 1;
  const std::size_t leaves = tree_.leaves();
  while (count > 0) {
    const std::size_t node = waiting[--count];
    const glm::dvec3 away = clusters_[node].middle - point;
    const double squared = glm::dot(away, away);
    if (squared > clusters_[node].reach) {
      far += far_angle(clusters_[node], away, squared);
    } else if (node < leaves) {
      waiting[count++] = static_cast<std::uint32_t>(2 * node + 1);
      waiting[count++] = static_cast<std::uint32_t>(2 * node);
    } else {
      for (const SurfaceTriangle& t : leaf(node)) add_triangle(point, t, turns);
    }
  }
  return turns.sum() + far / (4 * std::numbers::pi);
}

}  // namespace azulejo
