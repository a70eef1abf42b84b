#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/mesh.h"

namespace azulejo {

/// Whether two triangles have a point in common, borders included: exactly, whatever their position. Triangles on one
/// line count as the segments that they are.
AZULEJO_EXPORT bool triangles_meet(const std::array<glm::dvec3, 3>& a, const std::array<glm::dvec3, 3>& b);

/// The same of two that have a corner in common, a[0] = b[0]: beside that corner.
AZULEJO_EXPORT bool triangles_meet_beside_corner(const std::array<glm::dvec3, 3>& a,
                                                 const std::array<glm::dvec3, 3>& b);

/// The same of two that have an edge in common, a[0] = b[0] and a[1] = b[1]: beside that edge, which is where they lie in
/// one plane on one side of it.
AZULEJO_EXPORT bool triangles_meet_beside_edge(const std::array<glm::dvec3, 3>& a, const std::array<glm::dvec3, 3>& b);

/// Pairs of faces that meet where they have no common vertex and no common edge: faces, the lower first, rising. Exact
/// for triangles; other faces are looked at as the triangles that `triangulate` makes of them. Faces with a coordinate
/// that is not finite and those with equal vertices are left out; faces of the same three vertices are no pair.
///
/// welded  of each vertex, the number of its position: Welded::corners
/// Cost    O(n log n + pairs); 1 M triangles in about 1 s on two threads. Throws Error(Resource) beyond 2²⁴ pairs
std::vector<std::array<std::uint32_t, 2>> self_intersections(const Mesh& mesh, std::span<const std::uint32_t> welded,
                                                             const Run& run);

/// The same, but only of pairs with a face from `from` on; nothing where boxes of more than so many pairs meet.
std::optional<std::vector<std::array<std::uint32_t, 2>>> self_intersections_from(std::uint32_t from,
                                                                                 std::size_t most_looks,
                                                                                 const Mesh& mesh,
                                                                                 std::span<const std::uint32_t> welded,
                                                                                 const Run& run);

}  // namespace azulejo
