#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/array.h"
#include "azulejo/data/mesh.h"

namespace azulejo {

/// How much a face counts for the normal of its vertices.
enum class NormalWeight : std::uint8_t {
  Angle,    ///< its angle at the vertex: doesn't depend on how the surface is cut into faces
  Area,     ///< its area
  Uniform,  ///< all the same
};
constexpr std::array<std::string_view, 3> enum_names(NormalWeight) { return {"angle", "area", "uniform"}; }

struct NormalsOptions {
  NormalWeight weight = NormalWeight::Angle;
  std::optional<float> crease_angle = std::nullopt;  ///< radians; faces that meet at more are not smoothed together
};

/// What the operation `normals` makes of a surface.
enum class NormalsFrom : std::uint8_t {
  Angle,
  Area,
  Uniform,
  Face,  ///< each corner has the normal of its own face: the surface looks flat
};
constexpr std::array<std::string_view, 4> enum_names(NormalsFrom) { return {"angle", "area", "uniform", "face"}; }

struct SetNormalsOptions {
  NormalsFrom weight = NormalsFrom::Angle;
  std::optional<float> crease_angle_deg = std::nullopt;  ///< faces that meet at more are not smoothed together
  bool by_position = false;                              ///< vertices at exactly equal positions have one normal
  bool flip = false;                                     ///< the surface is turned inside out first
};

/// The unit normal of each face, by Newell's sum; 0 where a face has no area or a coordinate that is not finite.
AZULEJO_EXPORT Array<glm::vec3> face_normals(const Mesh& mesh, const Run& run = {});

/// The attribute NORMAL: weighted sums of face normals, unit length.
///
/// domain   Vertex where no crease splits a vertex, or none is asked for; else Corner: the normal of a corner sums the
///          faces at its vertex whose normals are within the crease angle of its own face's
/// seams    vertices at equal positions are not joined: weld the mesh first if they should be
/// nothing  0 where no face at the vertex has an area; where faces cancel, the first of them (or the corner's own)
/// fans     at vertices of more than 512 faces the crease angle is kept to within about 0.2 rad only
/// Throws   Error(Argument) for a crease angle outside 0–π
/// Cost     O(corners), with creases times up to the faces at a vertex
/// Source   Thürmer & Wüthrich, Computing vertex normals from polygonal facets, 1998
AZULEJO_EXPORT Attribute vertex_normals(const Mesh& mesh, const NormalsOptions& options = {}, const Run& run = {});

/// The mesh with a new NORMAL, of vertices or, where one has several, of corners; from `vertex_normals`, or face normals.
///
/// flip     see `flipped`
/// faces    a mesh without any keeps the normals that it has
/// left out TANGENT and the normals of morph targets, which belonged to the normals that there were
/// Throws   Error(Argument) for a crease angle outside 0–180
AZULEJO_EXPORT Mesh normals(const Mesh& mesh, const SetNormalsOptions& options = {}, const Run& run = {});

/// The mesh inside out: faces run the other way around, from the same first corners; NORMAL, the normals of morph targets
/// and the sign of TANGENT are turned, all else stays with its corners. Twice is nothing.
/// Cost  O(corners)
AZULEJO_EXPORT Mesh flipped(const Mesh& mesh, const Run& run = {});

}  // namespace azulejo
