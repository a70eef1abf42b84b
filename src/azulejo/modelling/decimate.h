#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/mesh.h"
#include "azulejo/engine/report.h"
#include "azulejo/modelling/distance.h"

namespace azulejo {

struct DecimateOptions {
  std::optional<int> faces = std::nullopt;    ///< triangles that are to be left
  std::optional<float> ratio = std::nullopt;  ///< the same as a share of the source's triangles
  /// How far the surface may get from where it was, as a share of the largest side of the mesh's box: 0.001 of a model of
  /// 2 m is 2 mm. See `Decimation::error`.
  std::optional<float> error = std::nullopt;
  bool keep_topology = true;      ///< false: holes and handles may close, small shells vanish
  bool lock_borders = false;      ///< vertices on borders stay where they are
  float border_weight = 10;       ///< how much borders count against surfaces; seams count a tenth of that
  float attribute_weight = 0.1F;  ///< see `decimate`; 0: attributes don't count
  bool measure = false;           ///< how far the surfaces are apart is measured, both ways
};

/// What ended a decimation.
enum class DecimateStop : std::uint8_t {
  Faces,    ///< as few faces as asked for
  Error,    ///< every further collapse would pass `error`
  Nothing,  ///< nothing could be collapsed without breaking what is kept
};
constexpr std::array<std::string_view, 3> enum_names(DecimateStop) { return {"faces", "error", "nothing_left"}; }

struct Decimation {
  Mesh mesh;
  std::size_t faces_before = 0;  ///< triangles of the source
  std::size_t faces_after = 0;
  std::size_t vertices_before = 0;
  std::size_t vertices_after = 0;
  /// Of all collapses the largest root of the mean squared distance of the new vertex from the planes of the source's
  /// faces that it stands for, weighed as the faces are, with what borders and attributes add: as a share of the largest
  /// side of the mesh's box.
  double error = 0;
  double distance = 0;  ///< the same in the model's unit
  DecimateStop stopped = DecimateStop::Nothing;
  std::optional<MeshDistance> measured;  ///< from the result to the source, and back; where it was asked for
};

/// Fewer triangles for nearly the same surface: edges collapse, those first that do least harm, each into the point that
/// is nearest to the planes of all faces that it stands for.
///
/// targets     of `faces`, `ratio` and `error` what is reached first ends it; none given: half of the triangles. The last
///             collapse may take one triangle more than asked for
/// faces       n-gons are triangulated first; faces that have a position twice go. No face turns by 78° or more at
///             once, or becomes thinner than about 1 : 1000, unless it was before
/// topology    kept: shells, handles, loops of borders. With keep_topology off, edges collapse whatever hangs on them:
///             holes and handles of three edges close, tetrahedra vanish, edges of more than two faces move too
/// bad edges   of three faces and more, or of two that turn differently: their vertices stay where they are (with
///             keep_topology); so do vertices whose faces are no single fan
/// borders     keep their place by planes upright on them; their vertices move along them only, or not at all
/// seams       vertices at exactly equal positions are one for the shape, and stay closed. Where their attributes (or
///             those of corners) differ there is a seam, and where `material` does: its vertices move along it together;
///             where seams meet or end they stay. Vertices apart for no such reason become one
/// attributes  NORMAL, TEXCOORD_n and COLOR_n are part of the error, linear over each face: full range (what the mesh has
///             of it; 1 for normals) counts as attribute_weight times the largest side of the box. The new values are those
///             with the least error, within the range that there was; normals have length 1. Other f32 and u8 values are
///             interpolated; u32 values, WEIGHTS_n and morph targets are the nearer vertex's; those of faces stay with
///             their faces. Values that are not finite become 0
/// flat        normals that differ along more than half of the edges are no seams: they are face normals, and are again
/// the rest    vertices of lines stay; unused ones go; a mesh without faces is given back as it is
/// not finite  vertices stay and count for nothing
/// hubs        around a vertex of more than 512 faces nothing collapses into it
/// Result      all triangles, in the order of the source; the same bytes for any number of threads
/// Throws      Error(Argument) for an option out of range
/// weights     faces count by the root of their area, so that thin features, which small faces are made of, stay longer
/// Cost        O(faces): 0.9 M triangles to 1 % in about 1.3 s on one thread; about 200 bytes a triangle
/// Source      Garland & Heckbert, Surface simplification using quadric error metrics, 1997; attributes: Hoppe, New
///             quadric metric for simplifying meshes with appearance attributes, 1999; link condition: Dey et al.,
///             Topology preserving edge contraction, 1999. Not by a queue: in each of many rounds, of the cheapest edges
///             those collapse that are cheaper than all around them
AZULEJO_EXPORT Decimation decimate(const Mesh& mesh, const DecimateOptions& options = {}, const Run& run = {});

/// As JSON.
AZULEJO_EXPORT Report report_of(const Decimation& decimation);

}  // namespace azulejo
