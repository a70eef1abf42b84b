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

}  // namespace azulejo
