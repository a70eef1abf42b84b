#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/mesh.h"
#include "azulejo/engine/report.h"

namespace azulejo {

struct RepairOptions {
  bool weld_borders = true;      ///< vertices at borders that are within the tolerance become one
  float tolerance = 0;           ///< in units of the mesh; 0: at exactly equal positions
  float relative_tolerance = 0;  ///< of the diagonal of the bounding box; the larger of both counts
  bool drop = true;    ///< faces that are degenerate, double or not finite, pieces without volume, unused vertices
  bool orient = true;  ///< neighbors agree, and the outside is outside
  bool split = true;   ///< edges of more than two faces and vertices of several fans
  bool fill = true;    ///< holes
  std::optional<int> max_hole_edges = std::nullopt;  ///< larger holes stay open; auto: none do
  bool fair = true;            ///< patches have triangles like those around them, and go on as the surface does
  bool flat = true;            ///< faces whose corners lie on one line
  bool remove_inside = false;  ///< shells inside of others
  int listed = 100;            ///< places of each kind that the report names
};

/// What was done, or found.
enum class RepairAction : std::uint8_t {
  WeldedVertex,      ///< became part of another one
  NotFiniteFace,     ///< dropped: a coordinate is NaN or infinite
  DegenerateFace,    ///< dropped: fewer than three different vertices in turn
  DuplicateFace,     ///< dropped: of the same vertices as another one
  UnusedVertex,      ///< dropped
  Sheet,             ///< dropped: a piece that encloses nothing
  InsideShell,       ///< dropped, on request
  TurnedFace,        ///< so that it agrees with its neighbors
  TurnedShell,       ///< so that its outside is outside
  SplitEdge,         ///< of more than two faces, or where a one-sided surface was cut
  SplitVertex,       ///< became one more
  FilledHole,        ///< with a patch
  OpenHole,          ///< left: larger than was asked for, or no solid would come of it
  FlatFace,          ///< removed without a gap
  MovedVertex,       ///< by a few last bits: the face would have been flat
  IntersectingFace,  ///< of a patch: meets another face
};
inline constexpr std::size_t kRepairActions = 16;
constexpr std::array<std::string_view, kRepairActions> enum_names(RepairAction) {
  return {"welded_vertices", "not_finite_faces", "degenerate_faces", "duplicate_faces",
          "unused_vertices", "sheets",           "inside_shells",    "turned_faces",
          "turned_shells",   "split_edges",      "split_vertices",   "filled_holes",
          "open_holes",      "flat_faces",       "moved_vertices",   "intersecting_faces"};
}

struct RepairCount {
  std::size_t count = 0;
  std::vector<glm::vec3> places;  ///< of the first ones
};

struct RepairedMesh {
  Mesh mesh;
  std::array<RepairCount, kRepairActions> actions;
  std::size_t added_vertices = 0;  ///< of patches
  std::size_t added_faces = 0;
  bool changed = false;
  bool intersections_counted = true;  ///< false: too many faces lie near those of patches
  bool solid = false;                 ///< every piece is closed and encloses a volume

  const RepairCount& of(RepairAction action) const { return actions[static_cast<std::size_t>(action)]; }
  std::size_t count(RepairAction action) const { return of(action).count; }
};

/// Makes a solid of a faulty surface: closed, manifold, oriented, without degenerate faces; each step can be left out.
///
/// unchanged  a solid, byte for byte, and so the result of a repair; a mesh without faces
/// weld       of borders: only vertices of edges with one face, as `weld` with method=distance; what is whole stays
/// duplicates of faces with the same vertices one stays where their edges have an odd number of other faces, else none:
///            a wall between two solids goes, their skin stays
/// orient     of neighbors that disagree the fewer are turned; where all can't agree, the surface is cut. Shells with a
///            negative volume are turned, unless they lie within others: cavities stay. Nested shells whose faces
///            disagreed become cavities and bodies in turn
/// split      around an edge of more than two faces, those that bound the same piece of the solid stay together
///            (Guéziec, Taubin, Lazarus & Horn, Cutting and stitching, 2001); a vertex for each fan of faces
/// fill       the triangulation whose faces meet each other and those around at the least angles, then of the least area
///            (Barequet & Sharir, Filling gaps in the boundary of a polyhedron, 1995; Liepa, Filling holes in meshes,
///            2003); loops of more than 64 edges are cut into pieces of so many first, flat ones by their ears. No edge
///            is made that there is already
/// fair       patches are refined to the density around them, at most 20 vertices an edge of the hole and 50 000, and
///            laid so that their curvature is least and goes on from the surface; where they meet it at more than 60° on
///            average, so that their area is least. A patch that meets other faces is laid flatter, if that
///            meets fewer; what remains is reported
/// sheets     a closed piece with a volume below 10⁻⁶ · area^1.5 is dropped where another one has a volume; where none
///            has, its holes stay open: a single face is no solid
/// flat       such a face goes into its neighbor across its longest edge; where that can't be, a vertex is moved by a
///            few last bits
/// attributes of the source's elements stay; where welded vertices have different ones they become corners', and morph
///            targets and skins the first vertex's. New vertices have means of those around; faces of a patch the
///            material and the attributes of the face beside its hole that has the most common material there
/// other      polygons stay polygons, new faces are triangles; lines stay, but those with a vertex that isn't finite
/// Result     the same for any number of threads. Self-intersections of the source stay
/// Cost       O(n log n): a solid of 1 M triangles in about 0.2 s, one with 10 000 holes in 0.6 s. Throws Error(Argument)
///            for an option out of range
AZULEJO_EXPORT RepairedMesh repair(const Mesh& mesh, const RepairOptions& options = {}, const Run& run = {});

/// What was done, as JSON; the verdict is whether the result is a solid.
AZULEJO_EXPORT Report report_of(const RepairedMesh& repaired);

}  // namespace azulejo
