#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/mesh.h"
#include "azulejo/engine/report.h"

namespace azulejo {

/// What a mesh is asked to be.
enum class TopologyVerdict : std::uint8_t {
  Printable,  ///< a closed manifold, oriented, with its outside outside, without self-intersections if they were looked for
  Closed,  ///< a manifold without borders
  Manifold,
};
constexpr std::array<std::string_view, 3> enum_names(TopologyVerdict) { return {"printable", "closed", "manifold"}; }

struct TopologyOptions {
  bool by_position = false;  ///< vertices at exactly equal positions are one
  bool self_intersections = false;
  int listed = 100;   ///< elements of each kind that the report names
  int marks = 20000;  ///< and that the operation's picture shows
  TopologyVerdict expect = TopologyVerdict::Printable;
};

/// What an element may be beside regular.
enum class MeshFaultKind : std::uint8_t {
  BorderEdge,        ///< one face
  SingularEdge,      ///< three faces or more
  TurnedEdge,        ///< two faces that run along it in the same direction: one of them is inside out
  SingularVertex,    ///< the faces around it are no single fan, and not for a singular edge
  UnusedVertex,      ///< without a face
  DoubledVertex,     ///< where another one is
  NotFiniteVertex,   ///< NaN or infinite
  DegenerateFace,    ///< fewer than three different vertices in turn
  FlatFace,          ///< all its corners on a line, exactly
  DuplicateFace,     ///< of the same vertices as an earlier one
  LooseEdge,         ///< a line of the mesh: an edge without a face
  IntersectingFace,  ///< meets another one beside a common vertex or edge
};
constexpr std::array<std::string_view, 12> enum_names(MeshFaultKind) {
  return {"border_edges",    "singular_edges",   "turned_edges",        "singular_vertices",
          "unused_vertices", "doubled_vertices", "not_finite_vertices", "degenerate_faces",
          "flat_faces",      "duplicate_faces",  "loose_edges",         "intersecting_faces"};
}
inline constexpr std::size_t kMeshFaultKinds = 12;

/// One of them, and where it is. Of vertices that are taken for one, the first is named.
struct MeshFault {
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::uint32_t index = 0;      ///< a vertex, a face, or an edge's lower vertex
  std::uint32_t other = kNone;  ///< an edge's higher vertex; the earlier vertex or face; the face that is met
  glm::vec3 place{0, 0, 0};     ///< the vertex, the edge's middle, the middle of the face's corners
};

struct MeshFaults {
  std::size_t count = 0;
  std::vector<MeshFault> listed;  ///< the first ones
};

/// A set of faces that are connected by edges.
struct MeshShell {
  std::size_t vertices = 0;
  std::size_t edges = 0;
  std::size_t faces = 0;
  std::size_t holes = 0;   ///< loops of border edges, where it is a manifold
  bool manifold = true;    ///< each point has a disk or half a disk around it
  bool closed = true;      ///< no border
  bool orientable = true;  ///< its faces can be turned so that neighbors agree
  bool oriented = true;    ///< they agree
  /// Handles, counted by tree and cotree, not from Euler's formula; none of what is no manifold. Of a surface that can't
  /// be oriented, the number of its cross-caps.
  std::optional<std::size_t> genus;
  double volume = 0;  ///< signed, of a closed and oriented one: negative if it is inside out; else 0
  double area = 0;
};

/// A loop of border edges.
struct MeshHole {
  std::uint32_t vertex = 0;  ///< the lowest on it
  std::size_t edges = 0;
  double length = 0;
  glm::vec3 place{0, 0, 0};  ///< the middle of its vertices
};

/// How the faces of a mesh hang together. Vertices are those that have faces.
struct AZULEJO_EXPORT Topology {
  std::size_t vertices = 0;
  std::size_t edges = 0;
  std::size_t faces = 0;  ///< with three different vertices in turn and more
  std::size_t loops = 0;  ///< of faces: one each
  std::size_t regular_edges = 0;
  std::size_t regular_vertices = 0;
  std::size_t components = 0;  ///< of faces that are connected by vertices
  std::array<MeshFaults, kMeshFaultKinds> faults;
  std::vector<MeshShell> shells;  ///< in the order of their first faces
  std::vector<MeshHole> holes;    ///< in the order of their first vertices; none where the border has singular vertices
  bool self_intersections_looked_for = false;

  const MeshFaults& of(MeshFaultKind kind) const { return faults[static_cast<std::size_t>(kind)]; }
  std::size_t count(MeshFaultKind kind) const { return of(kind).count; }
  long euler() const {  ///< V + F − E
    return static_cast<long>(vertices) + static_cast<long>(faces) - static_cast<long>(edges);
  }
  bool manifold() const;  ///< no singular edges or vertices, degenerate or duplicate faces
  bool closed() const;    ///< and no borders
  bool oriented() const;  ///< neighbors agree, and each shell has its outside outside
  /// A solid that can be printed: closed, manifold, oriented, its faces with areas, without self-intersections (if they
  /// were looked for).
  bool printable() const;
  /// The genus of all shells; none if one isn't known.
  std::optional<std::size_t> genus() const;
  /// V + F − E − (L − F) − 2 (S − G), each hole counted as a face with its loop: 0 for a manifold that can be oriented.
  /// None if G isn't known.
  std::optional<long> euler_poincare() const;
  /// Why V + F − E need not be 2; empty: it must be.
  std::vector<std::string> euler_preconditions() const;
};

/// Looks at every vertex, edge and face of a mesh.
///
/// Cost  O(corners), for any mesh O(corners · log corners): 1 M triangles in about 0.15 s on two threads; with
///       self-intersections O(n log n) for surfaces that meet themselves in few places
AZULEJO_EXPORT Topology topology(const Mesh& mesh, const TopologyOptions& options = {}, const Run& run = {});

/// As JSON, with the verdict whether the mesh is what is expected, and the first `listed` of each kind of fault.
AZULEJO_EXPORT Report report_of(const Topology& topology, const TopologyOptions& options = {});

}  // namespace azulejo
