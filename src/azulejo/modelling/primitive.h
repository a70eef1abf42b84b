#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

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
  Capsule,
  Disk,        ///< its normal up
  CubeSphere,  ///< a cube's faces, cut into squares and blown up
  Tube,        ///< along a curve through points
  TorusKnot,   ///< a tube along it
  Mobius,      ///< strip
  KleinBottle,
  Helicoid,
  Catenoid,
  Enneper,
};
constexpr std::array<std::string_view, 22> enum_names(PrimitiveKind) {
  return {"cube",       "uv_sphere",    "ico_sphere",   "cylinder", "cone",     "torus",  "plane",       "tetrahedron",
          "octahedron", "dodecahedron", "icosahedron",  "teapot",   "capsule",  "disk",   "cube_sphere", "tube",
          "torus_knot", "mobius",       "klein_bottle", "helicoid", "catenoid", "enneper"};
}

struct PrimitiveOptions {
  PrimitiveKind kind = PrimitiveKind::Cube;
  float size = 2;            ///< edge of the cube and the plane; length of the teapot; of the largest side of others
  float radius = 1;          ///< of round things; of the Platonic solids' corners; of the ring of what has one
  float height = 2;          ///< of cylinder, cone, helicoid and catenoid; of the capsule without its ends
  float tube_radius = 0.4F;  ///< of torus, tube and torus_knot; half the width of the Möbius strip
  std::optional<int> segments = std::nullopt;  ///< around; along the plane; along a patch's side. Auto: see below
  std::optional<int> rings = std::nullopt;     ///< across them
  int subdivisions = 3;                        ///< of the ico sphere
  bool smooth = true;                          ///< false: every face looks flat
  /// Of the tube: x, y, z of each.
  std::vector<float> points = {-2, -0.2F, 0, -0.7F, 0.2F, 0.2F, 0.7F, -0.2F, -0.2F, 2, 0.2F, 0};
  bool closed = false;                            ///< the tube: back to its first point
  int around = 2;                                 ///< turns of the torus knot around the axis
  int through = 3;                                ///< and through the hole; without a common divisor
  float turns = 1;                                ///< of the helicoid
  std::optional<float> tolerance = std::nullopt;  ///< of the teapot: as many segments as keep chords this near
};

/// A simple body or surface around the origin, y up, as faces that turn counter-clockwise seen from outside.
///
/// closed   one vertex a place, shared by its faces. Open: the teapot, whose lid is ajar and whose spout is open, plane,
///          disk, helicoid, catenoid, enneper; and mobius and klein_bottle, which have one side: they are cut where its
///          two faces meet, at equal positions
/// faces    quads, triangles at poles, the bottoms of cylinder, cone and tube as one; the solids' own
/// steps    auto: 48 segments; 1 of the plane, 16 of a patch, 12 of a cube sphere's side, 24 around a tube, 96 of
///          Möbius strip and Klein bottle. Rings: half as many for sphere and torus, a quarter for a capsule's end, 8
///          for disk and strip, 24 for a surface, 12 from point to point of a tube, 256 along a knot; else 1
/// NORMAL   the exact surface's; of each corner where a vertex has several
/// TEXCOORD_0  of each corner, in 0–1: the surface's own parameters, once around and from top to bottom; along the tube
///          from bottom to top; a whole texture a face of cube, cube sphere and solids, a patch of the teapot; a piece
///          of it for each of the icosahedron's faces
/// tube     through its points, as catmull_rom with centripetal timing, without turning about itself; where the curve is
///          bent tighter than tube_radius, the surface goes through itself
/// catenoid y = c arcosh(r ÷ c) with the waist c = tube_radius; cut off at height
/// enneper  u − u³/3 + u v², v − v³/3 + v u², u² − v² over |u|, |v| ≤ 1, scaled to size
/// bottle   R. Israel's parametrization, 1996, scaled to size
/// tolerance  bounds |chord − surface| by ⅛ h² (|S_uu| + 2 |S_uv| + |S_vv|); segments must be auto
/// Throws   Error(Argument) for an option out of range, Error(Resource) beyond run.limits.memory_bytes
/// Source   the teapot: M. Newell, 1975; F. Crow, The origins of the teapot, 1987; its tolerance: Filip, Magedson &
///          Markot, Surface algorithms using bounds on derivatives, 1986; the tube's frame: Wang, Jüttler, Zheng & Liu,
///          Computation of rotation minimizing frames, 2008
AZULEJO_EXPORT Mesh primitive(const PrimitiveOptions& options, const Run& run = {});

}  // namespace azulejo
