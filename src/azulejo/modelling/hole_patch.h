#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

namespace azulejo {

/// The border of a hole, in the direction in which the faces of a patch run along it, and what is beyond.
struct HoleRim {
  std::vector<glm::dvec3> points;
  std::vector<glm::dvec3> normals;       ///< of the face beyond the edge from each point to the next, of length 1, or 0
  std::vector<double> scale;             ///< mean length of the edges that meet at each point
  std::vector<glm::dvec3> outside;       ///< sum of the neighbors beyond
  std::vector<std::uint32_t> neighbors;  ///< how many these are
  /// Whether two of the points have an edge already, other than of the rim.
  std::function<bool(std::uint32_t, std::uint32_t)> joined;

  std::size_t size() const { return points.size(); }
};

/// Faces for a hole. Points of the rim come first.
struct HolePatch {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<glm::dvec3> points;                     ///< new ones
  std::vector<std::array<std::uint32_t, 3>> parents;  ///< of each new one, points that it lies between
};

/// Triangles over the points of the rim alone, but for middles of edges that there are already.
HolePatch triangulate_hole(const HoleRim& rim);

/// Divides the triangles of a patch to the density that the rim has, at most to so many new points.
void refine_patch(const HoleRim& rim, HolePatch& patch, std::size_t most_points);

enum class Fairing : std::uint8_t {
  Curvature,  ///< goes on from the surface beyond the rim, least curved
  Area,       ///< hangs in the rim like a soap film
};
/// Whether the surface goes smoothly across the rim, or has an edge there.
Fairing fairing_of(const HoleRim& rim, const HolePatch& patch);
/// Moves the new points. Source  Liepa, Filling holes in meshes, 2003; Kobbelt, Campagna, Vorsatz & Seidel, Interactive
/// multi-resolution modeling on arbitrary meshes, 1998
void fair_patch(const HoleRim& rim, HolePatch& patch, Fairing fairing);

}  // namespace azulejo
