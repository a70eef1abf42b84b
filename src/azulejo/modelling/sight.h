#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

namespace azulejo {

/// Three axes of a view without perspective: to the right, up, and to the eye.
struct SightAxes {
  glm::dvec3 right{1, 0, 0};
  glm::dvec3 up{0, 1, 0};
  glm::dvec3 to_eye{0, 0, 1};
};

/// The axes with `up` upright in the picture, or, where the eye is straight above or below, another direction.
SightAxes sight_axes(const glm::dvec3& to_eye, const glm::dvec3& up);

/// Unit vectors to the eye: from azimuth 30°, elevation 20° around `up`, then to the faces, edges and corners of a cube,
/// each followed by the opposite one. 27.
std::vector<glm::dvec3> sight_directions(const glm::dvec3& front, const glm::dvec3& up);

/// What is seen from far away, and from the other side: how near surfaces come, on a grid over a ball. All places are
/// in cells, x and y from 0 to kCells, z to the eye.
class Sight {
 public:
  static constexpr int kCells = 256;  ///< across

  Sight(const glm::dvec3& center, double radius, const SightAxes& axes);
  glm::vec3 cell(const glm::dvec3& place) const;
  /// How many cells `cover` looks at.
  static std::size_t extent(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);
  /// A triangle, seen from either side. What is not finite is left out.
  void cover(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);
  /// Whether nothing is before it by more than `slack` cells, as the eye sees it, or one at the other side.
  bool sees(const glm::vec3& cell, bool from_behind, float slack = 4) const;

 private:
  glm::dvec3 center_;
  double cells_per_unit_;
  SightAxes axes_;
  std::vector<std::array<float, 2>> range_;  ///< farthest and nearest surface, rows from the bottom
};

}  // namespace azulejo
