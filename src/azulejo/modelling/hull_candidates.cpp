#include "azulejo/modelling/hull_candidates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numeric>

#include "azulejo/core/parallel.h"
#include "azulejo/modelling/quick_hull.h"

namespace azulejo {
namespace {

constexpr std::size_t kWorthIt = 4096;
constexpr std::size_t kStride = 32;  ///< one of so many is in the sample; tuned on a ball of 10⁶ points
constexpr std::size_t kChunk = std::size_t{1} << 14;

/// How far inside a convex surface reaches at least, in all directions.
class Cube {
 public:
  /// False where the surface is too flat for doubles to tell.
  bool enclose(std::span<const glm::vec3> points, const QuickHull& hull);
  bool contains(const glm::vec3& point) const {
    const glm::dvec3 p = (glm::dvec3(point) - middle_) * scale_;
    const Place place = place_of(p);
    const auto cell = [](double share) {
      return std::min(static_cast<int>((share + 1) * (kCells / 2.0)), kCells - 1);  // shares are from −1 to 1
    };
    if (!(place.along > 0)) return true;  // the middle
    const double inverse = 1 / place.along;
    const int column = cell(place.u * inverse);
    const int row = cell(place.v * inverse);
    return place.along * cells_[static_cast<std::size_t>(at(place.face, column, row))] < 1 - 1e-6;
  }

 private:
  static constexpr int kCells = 48;
  struct Place {
    int face;
    double u;
    double v;
    double along;  ///< the face's axis
  };
  static int at(int face, int column, int row) { return (face * (kCells + 1) + row) * (kCells + 1) + column; }
  static Place place_of(const glm::dvec3& p) {
    const glm::dvec3 size = glm::abs(p);
    if (size.z >= size.x && size.z >= size.y) return {p.z < 0 ? 1 : 0, p.x, p.y, size.z};
    if (size.y >= size.x) return {p.y < 0 ? 3 : 2, p.z, p.x, size.y};
    return {p.x < 0 ? 5 : 4, p.y, p.z, size.x};
  }
  static glm::dvec3 direction(int face, double u, double v) {
    const double along = face % 2 == 0 ? 1 : -1;
    return face < 2 ? glm::dvec3(u, v, along) : face < 4 ? glm::dvec3(v, along, u) : glm::dvec3(along, u, v);
  }
  static bool on_one_face(const std::array<Place, 3>& places) {
    return places[0].face == places[1].face && places[0].face == places[2].face;
  }
  template <class Value>
  void cover(const std::array<Place, 3>& places, Value value);
  bool add_facet(const std::array<glm::dvec3, 3>& corners);

  glm::dvec3 middle_{0};
  glm::dvec3 scale_{1};
  std::vector<double> cells_;  ///< at each node, one over how far the surface is; then the largest of a cell's corners
};

/// Raises the nodes that a facet is seen at to `value(direction)`, and some around them.
template <class Value>
void Cube::cover(const std::array<Place, 3>& places, Value value) {
  const auto fill = [&](int face, int left, int right, int bottom, int top) {
    for (int row = std::max(bottom, 0); row <= std::min(top, kCells); ++row) {
      for (int column = std::max(left, 0); column <= std::min(right, kCells); ++column) {
        double& node = cells_[static_cast<std::size_t>(at(face, column, row))];
        node = std::max(node, value(direction(face, 2.0 * column / kCells - 1, 2.0 * row / kCells - 1)));
      }
    }
  };
  if (!on_one_face(places)) {
    for (int face = 0; face < 6; ++face) fill(face, 0, kCells, 0, kCells);
    return;
  }
  glm::dvec2 lower(1);
  glm::dvec2 upper(-1);
  for (const Place& place : places) {
    lower = glm::min(lower, glm::dvec2(place.u, place.v) / place.along);
    upper = glm::max(upper, glm::dvec2(place.u, place.v) / place.along);
  }
  // A node more on each side: rounding leaves none out.
  const auto node = [](double share) { return static_cast<int>((share + 1) * (kCells / 2.0)); };
  fill(places[0].face, node(lower.x) - 1, node(upper.x) + 2, node(lower.y) - 1, node(upper.y) + 2);
}

bool Cube::add_facet(const std::array<glm::dvec3, 3>& corners) {
  const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double height = glm::dot(normal, corners[0]);
  std::array<Place, 3> places;
  std::transform(corners.begin(), corners.end(), places.begin(), place_of);
  if (height > 1e-8) {  // a normal that is 10⁻¹⁵ off is then at most 10⁻⁷ off in what is stored
    cover(places, [inverse = normal / height](const glm::dvec3& along) { return glm::dot(inverse, along); });
    return true;
  }
  // Of a sliver the normal is worth nothing; but it is nowhere nearer than its nearest corner.
  const double nearest = std::min({places[0].along, places[1].along, places[2].along});
  if (!on_one_face(places) || !(nearest > 1e-6)) return false;
  cover(places, [&](const glm::dvec3&) { return 1 / nearest; });
  return true;
}

bool Cube::enclose(std::span<const glm::vec3> points, const QuickHull& hull) {
  glm::dvec3 lower(points[hull.facets[0][0]]);
  glm::dvec3 upper = lower;
  glm::dvec3 sum(0);
  for (const auto& facet : hull.facets) {
    for (const std::uint32_t vertex : facet) {
      const glm::dvec3 p(points[vertex]);
      lower = glm::min(lower, p);
      upper = glm::max(upper, p);
      sum += p;
    }
  }
  middle_ = sum / (3.0 * static_cast<double>(hull.facets.size()));
  scale_ = 1.0 / (upper - lower);
  cells_.assign(static_cast<std::size_t>(at(6, 0, 0)), 0.0);
  for (const auto& facet : hull.facets) {
    std::array<glm::dvec3, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = (glm::dvec3(points[facet[i]]) - middle_) * scale_;
    if (!add_facet(corners)) return false;
  }
  for (int face = 0; face < 6; ++face) {
    for (int row = 0; row < kCells; ++row) {
      for (int column = 0; column < kCells; ++column) {
        double& cell = cells_[static_cast<std::size_t>(at(face, column, row))];
        for (const int other : {at(face, column + 1, row), at(face, column, row + 1), at(face, column + 1, row + 1)}) {
          cell = std::max(cell, cells_[static_cast<std::size_t>(other)]);
        }
      }
    }
  }
  return true;
}

}  // namespace

std::vector<std::uint32_t> hull_candidates(std::span<const glm::vec3> points, const Run& run) {
  std::vector<std::uint32_t> all(points.size());
  if (points.size() >= kWorthIt) {
    std::vector<glm::vec3> sample;
    for (std::size_t i = 0; i < points.size(); i += kStride) sample.push_back(points[i]);
    std::vector<glm::vec3> kept;
    for (const std::uint32_t each : hull_candidates(sample, run)) kept.push_back(sample[each]);
    const QuickHull hull = quick_hull(kept, run);
    Cube cube;
    if (hull.dimension == 3 && cube.enclose(kept, hull)) {
      std::vector<std::vector<std::uint32_t>> parts((points.size() + kChunk - 1) / kChunk);
      parallel_for(points.size(), kChunk, run, [&](std::size_t begin, std::size_t end) {
        std::vector<std::uint32_t>& part = parts[begin / kChunk];
        for (std::size_t i = begin; i < end; ++i) {
          if (!cube.contains(points[i])) part.push_back(static_cast<std::uint32_t>(i));
        }
      });
      all.clear();
      for (const std::vector<std::uint32_t>& part : parts) all.insert(all.end(), part.begin(), part.end());
      return all;
    }
  }
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

}  // namespace azulejo
