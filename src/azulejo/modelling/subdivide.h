#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/mesh.h"

namespace azulejo {

enum class SubdivisionScheme : std::uint8_t {
  Loop,          ///< triangles in four, smooth
  CatmullClark,  ///< a face of n corners into n quads, smooth
  Sqrt3,         ///< triangles in three, their edges turned, smooth
  Midpoint,      ///< as Loop or Catmull–Clark, but the surface stays where it is
};
constexpr std::array<std::string_view, 4> enum_names(SubdivisionScheme) {
  return {"loop", "catmull_clark", "sqrt3", "midpoint"};
}

struct SubdivideOptions {
  SubdivisionScheme scheme = SubdivisionScheme::Loop;
  int levels = 1;      ///< 1–16: how often
  bool limit = false;  ///< vertices move to where endless subdivision would take them; midpoint: they are there
  std::optional<float> crease_angle_deg = std::nullopt;  ///< edges whose faces' normals differ by more stay sharp
  bool crease_lines = false;                             ///< edges that `lines` of the mesh run along stay sharp
  bool keep_corners = false;                             ///< so do border vertices of a single face
};

/// Replaces each face by smaller ones, `levels` times.
///
/// loop           V + E vertices, 4 F triangles; weights of Loop. Faces of more corners are triangulated first
/// catmull_clark  V + E + F vertices, a quad for each corner
/// sqrt3          V + F vertices, 3 F triangles; every second level cuts borders and creases in three, the others leave
///                them. Faces of more corners are triangulated first
/// midpoint       a mesh of triangles as loop, any other as catmull_clark, flat: area and volume are kept, but for
///                rounding. Faces that quads around the mean of their corners would not cover exactly once (some of
///                those that are not convex) are triangulated first
/// creases        edges with one face, with more than two, and those that the options name: cubic B-splines along them
///                (loop, catmull_clark: 1 6 1 ÷ 8; sqrt3: 4 19 4 ÷ 27). A vertex with more than two such edges stays, as
///                does one where separate parts of the surface touch; one with a single crease is smooth
/// limit          by the schemes' masks; where a crease ends in a smooth vertex, by subdividing around it until nothing
///                moves. Of sqrt3 after an odd number of levels not exact beside borders and creases
/// order          of vertices: old ones, one for each edge, one for each face; faces that come from one are neighbors
/// seams          vertices at equal positions are not joined: weld the mesh first, or its seams are borders
/// attributes     of vertices, also morph targets: the scheme's own weights. Of corners: linear within each face, so
///                seams stay where they are; sqrt3 keeps those that have one value a vertex, and drops others with a
///                warning. Of faces, and `material`: inherited. u8 is rounded at the end; u32 is taken from one parent.
///                NORMAL: kept linear by midpoint, else made new if there was one, split by crease_angle_deg. TANGENT,
///                JOINTS_n, WEIGHTS_n and the normals of morph targets are dropped
/// lines          along edges follow them in two parts, in three where sqrt3 cuts an edge so; others keep their ends
/// degenerate     corners that repeat the one before are dropped, and faces with fewer than three left. Vertices without
///                a face stay as they are
/// NaN            spreads to what is weighed with it: one ring of faces farther at each level
/// Stages         level_1, level_2, … without attributes
/// Result         the same bytes for any thread count; calculated in f64 and rounded to f32 at each level
/// Throws         Error(Argument) for an option out of range; Error(Resource), before anything is made, beyond
///                run.limits.memory_bytes or 2³² − 2 corners
/// Cost           O(result), on all threads; about 40 bytes a corner of the last level but one beside it
/// Source         Loop, Smooth subdivision surfaces based on triangles, 1987; Catmull & Clark, Recursively generated
///                B-spline surfaces on arbitrary topological meshes, 1978; Kobbelt, √3-subdivision, 2000; creases: Hoppe
///                et al., Piecewise smooth surface reconstruction, 1994, with the midpoint on every crease; limits:
///                Halstead, Kass & DeRose, Efficient, fair interpolation using Catmull–Clark surfaces, 1993
AZULEJO_EXPORT Mesh subdivide(const Mesh& mesh, const SubdivideOptions& options = {}, const Run& run = {});

}  // namespace azulejo
