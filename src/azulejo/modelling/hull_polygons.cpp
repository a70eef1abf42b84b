#include "azulejo/modelling/hull_polygons.h"

#include <array>

#include "azulejo/math/predicates.h"

namespace azulejo {
namespace {

std::size_t next_edge(std::size_t edge) { return edge == 2 ? 0 : edge + 1; }

class Walker {
 public:
  Walker(std::span<const glm::vec3> points, const QuickHull& hull) : points_(points), hull_(hull) {
    mark_inner_edges();
    count_faces();
  }

  HullPolygons polygons() {
    HullPolygons result;
    std::vector<std::uint8_t> done(3 * hull_.facets.size(), 0);
    for (std::uint32_t f = 0; f < hull_.facets.size(); ++f) {
      for (std::size_t edge = 0; edge < 3; ++edge) {
        if (inner_[3 * f + edge] == 0 && done[3 * f + edge] == 0) walk({f, edge}, done, result);
      }
    }
    return result;
  }

 private:
  struct Place {
    std::uint32_t facet;
    std::size_t edge;
    friend bool operator==(const Place&, const Place&) = default;
  };

  glm::dvec3 at(std::uint32_t point) const { return points_[point]; }

  /// The same edge from the other side.
  Place across(const Place& place) const {
    const std::uint32_t beyond = hull_.neighbors[place.facet][place.edge];
    const std::uint32_t end = hull_.facets[place.facet][next_edge(place.edge)];
    std::size_t edge = 0;
    while (edge < 2 && hull_.facets[beyond][edge] != end) ++edge;
    return {beyond, edge};
  }

  /// Edges between triangles of one plane.
  void mark_inner_edges() {
    inner_.assign(3 * hull_.facets.size(), 0);
    for (std::uint32_t f = 0; f < hull_.facets.size(); ++f) {
      const auto& v = hull_.facets[f];
      for (std::size_t edge = 0; edge < 3; ++edge) {
        const Place other = across({f, edge});
        if (other.facet < f) continue;
        const std::uint32_t tip = hull_.facets[other.facet][next_edge(next_edge(other.edge))];
        if (orient3d(at(v[0]), at(v[1]), at(v[2]), at(tip)) != 0) continue;
        inner_[3 * f + edge] = 1;
        inner_[3 * other.facet + other.edge] = 1;
      }
    }
  }

  /// At how many polygons a point is: fewer than three, and it is in the middle of something.
  void count_faces() {
    faces_.assign(points_.size(), 0);
    for (std::size_t f = 0; f < hull_.facets.size(); ++f) {
      for (std::size_t edge = 0; edge < 3; ++edge) {
        if (inner_[3 * f + edge] == 0) ++faces_[hull_.facets[f][edge]];
      }
    }
  }

  void walk(const Place& first, std::vector<std::uint8_t>& done, HullPolygons& result) const {
    Place place = first;
    do {
      done[3 * place.facet + place.edge] = 1;
      const std::uint32_t vertex = hull_.facets[place.facet][place.edge];
      if (faces_[vertex] >= 3) result.corners.push_back(vertex);
      place.edge = next_edge(place.edge);
      while (inner_[3 * place.facet + place.edge] != 0) {
        place = across(place);
        place.edge = next_edge(place.edge);
      }
    } while (!(place == first));
    result.offsets.push_back(static_cast<std::uint32_t>(result.corners.size()));
  }

  std::span<const glm::vec3> points_;
  const QuickHull& hull_;
  std::vector<std::uint8_t> inner_;   ///< of each edge of each facet
  std::vector<std::uint32_t> faces_;  ///< of each point
};

}  // namespace

HullPolygons hull_polygons(std::span<const glm::vec3> points, const QuickHull& hull) {
  return Walker(points, hull).polygons();
}

}  // namespace azulejo
