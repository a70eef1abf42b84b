#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "azulejo/core/run.h"
#include "azulejo/data/array.h"
#include "azulejo/data/mesh.h"

namespace azulejo::subdivision {

inline constexpr std::size_t kChunk = std::size_t{1} << 13;  ///< elements of one task
inline constexpr std::uint32_t kNone = 0xFFFFFFFF;

/// How a vertex moves.
enum class Rule : std::uint8_t {
  Smooth,
  Dart,    ///< a single sharp edge ends here: moves as a smooth one
  Crease,  ///< between two sharp edges
  Corner,  ///< stays
};

/// How the faces of a level hang together. Every corner uses an edge. An edge is between two different vertices; its
/// first is the lower one at the first level, the older one later.
struct Level {
  std::size_t vertex_count = 0;
  Array<std::uint32_t> corners;
  std::size_t sides = 3;                ///< of each face; 0: `face_offsets` tells
  Array<std::uint32_t> face_offsets;    ///< as a mesh's
  Array<std::uint32_t> face_of_corner;  ///< where sides is 0
  Array<std::array<std::uint32_t, 2>> edges;
  Array<std::uint32_t> edge_of_corner;              ///< from its vertex to the next corner's
  Array<std::uint32_t> first_use, uses;             ///< corners along each edge
  Array<std::uint32_t> first_at_vertex, at_vertex;  ///< corners at each vertex
  Array<std::uint8_t> sharp;                        ///< of each edge: not smoothed across
  Array<Rule> rules;                                ///< of each vertex
  bool oriented = false;  ///< the faces of every smooth edge run along it in opposite directions

  std::size_t corner_count() const { return corners.size(); }
  std::size_t face_count() const { return sides != 0 ? corners.size() / sides : face_offsets.size() - 1; }
  std::span<const std::uint32_t> uses_of(std::size_t edge) const {
    return {uses.data() + first_use[edge], first_use[edge + 1] - first_use[edge]};
  }
  std::span<const std::uint32_t> corners_at(std::size_t vertex) const {
    return {at_vertex.data() + first_at_vertex[vertex], first_at_vertex[vertex + 1] - first_at_vertex[vertex]};
  }
};

/// The corners of a level's faces; kSides 0: any number of them.
template <std::size_t kSides>
class Faces {
 public:
  explicit Faces(const Level& level) : offsets_(level.face_offsets.data()), faces_(level.face_of_corner.data()) {}
  std::size_t begin(std::size_t face) const {
    if constexpr (kSides != 0) return face * kSides;
    return offsets_[face];
  }
  std::size_t end(std::size_t face) const { return begin(face + 1); }
  std::size_t face_of(std::size_t corner) const {
    if constexpr (kSides != 0) return corner / kSides;
    return faces_[corner];
  }
  std::size_t next(std::size_t corner) const {
    const std::size_t face = face_of(corner);
    return corner + 1 == end(face) ? begin(face) : corner + 1;
  }
  std::size_t previous(std::size_t corner) const {
    const std::size_t face = face_of(corner);
    return corner == begin(face) ? end(face) - 1 : corner - 1;
  }

 private:
  const std::uint32_t* offsets_;
  const std::uint32_t* faces_;
};

/// Calls body with the Faces of a level.
template <class Body>
void with_faces(const Level& level, Body body) {
  switch (level.sides) {
    case 3: return body(Faces<3>(level));
    case 4: return body(Faces<4>(level));
    default: return body(Faces<0>(level));
  }
}

/// Which edges and vertices stay sharp beside borders and edges of more than two faces.
struct Sharpness {
  float least_cosine = -2;  ///< of the normals at a smooth edge
  bool lines = false;       ///< edges that the mesh's lines run along
  bool lone_corners = false;
  bool turned = false;  ///< edges along which both faces run in the same direction
};

/// The first level of a mesh without corners that repeat the one before. line_edges: of each of its lines the edge
/// that it runs along, or kNone.
Level first_level(const Mesh& mesh, const Sharpness& sharpness, Array<std::uint32_t>& line_edges, const Run& run);

/// Of each line between two vertices the edge that it runs along, or kNone; for a level whose edges rise, as those of
/// `first_level` and `connect` do.
Array<std::uint32_t> edges_along(const Level& level, const Array<std::uint32_t>& lines, const Run& run);

/// The edges and the corners at vertices of a level that has its corners, all of triangles; `sharp_corners` of each
/// corner tells whether its edge is sharp. Rules are left as they are.
void connect(Level& level, const Array<std::uint8_t>& sharp_corners, const Run& run);

/// The level below: triangles in four, faces into quads. Vertices: the old ones, one for each edge, of quads one for
/// each face. Without `whole` only the corners, all that the last level needs.
/// Cost  O(corners): nothing is searched or sorted
Level split_triangles(const Level& level, bool whole, const Run& run);
Level split_into_quads(const Level& level, bool whole, const Run& run);

/// The sharp edges at a vertex between two of them; the other ends.
std::array<std::uint32_t, 2> crease_neighbors(const Level& level, std::size_t vertex);

/// The corners around a vertex of smooth edges or a single sharp one, each beside the next; empty where its faces are
/// not one closed ring. Begins behind `first`, an edge.
struct Spoke {
  std::uint32_t corner;    ///< at the vertex
  std::uint32_t edge_in;   ///< of the corner's face at the vertex, shared with the spoke before
  std::uint32_t edge_out;  ///< the other one, shared with the next
};
std::vector<Spoke> ring_around(const Level& level, std::size_t vertex, std::uint32_t first_corner);

}  // namespace azulejo::subdivision
