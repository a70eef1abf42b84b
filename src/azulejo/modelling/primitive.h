#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/mesh.h"

namespace azulejo {

enum class PrimitiveKind : std::uint8_t {
  Cube,
  UvSphere,   ///< of circles of longitude and latitude
  IcoSphere,  ///< an icosahedron's faces cut in four, over and over
  Cylinder,
  Cone,
  Torus,
  Plane,  ///< its normal up
  Tetrahedron,
  Octahedron,
  Dodecahedron,
  Icosahedron,
  Teapot,  ///< of 32 Bézier patches
};
constexpr std::array<std::string_view, 12> enum_names(PrimitiveKind) {
  return {"cube",  "uv_sphere",   "ico_sphere", "cylinder",     "cone",        "torus",
          "plane", "tetrahedron", "octahedron", "dodecahedron", "icosahedron", "teapot"};
}

struct PrimitiveOptions {
  PrimitiveKind kind = PrimitiveKind::Cube;
  float size = 2;                              ///< edge of the cube and the plane, length of the teapot
  float radius = 1;                            ///< of round things; of the Platonic solids' corners; of the torus' ring
  float height = 2;                            ///< of cylinder and cone
  float tube_radius = 0.4F;                    ///< of the torus
  std::optional<int> segments = std::nullopt;  ///< around; along the plane; along a patch's side. Auto: 48; 1; 16
  std::optional<int> rings = std::nullopt;     ///< across them. Auto: half as many for sphere and torus; else 1
  int subdivisions = 3;                        ///< of the ico sphere
  bool smooth = true;                          ///< false: every face looks flat
};

/// A simple body around the origin, y up, as faces that turn counter-clockwise seen from outside.
///
/// closed   all but plane and teapot, whose lid is ajar and whose spout is open: one vertex a place, shared by its faces
/// faces    quads, triangles at poles, the bottoms of cylinder and cone as one; the solids' own
/// NORMAL   the exact surface's; of each corner where a vertex has several
/// TEXCOORD_0  of each corner, in 0–1: once around and from top to bottom; a whole texture a face of cube and solids,
///          a patch of the teapot; a piece of it for each of the icosahedron's faces
/// Throws   Error(Argument) for an option out of range, Error(Resource) beyond run.limits.memory_bytes
/// Source   the teapot: M. Newell, 1975; F. Crow, The origins of the teapot, 1987
AZULEJO_EXPORT Mesh primitive(const PrimitiveOptions& options, const Run& run = {});

}  // namespace azulejo
