#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/mesh.h"
#include "azulejo/math/nurbs_surface.h"

namespace azulejo {

enum class SurfaceKind : std::uint8_t {
  Bezier,      ///< one patch of as many points as there are less one, both ways
  BSpline,     ///< with weights: NURBS
  Revolution,  ///< of a B-spline profile around y, exactly
};
constexpr std::array<std::string_view, 3> enum_names(SurfaceKind) { return {"bezier", "bspline", "revolution"}; }

struct SurfaceOptions {
  SurfaceKind kind = SurfaceKind::Bezier;
  /// x, y and z of each, row by row; of the profile x and y of each, from the top down.
  std::vector<float> points = {-1, 0,    -1, -0.3F, 0.8F,  -1, 0.3F, 0.8F, -1, 1, 0,    -1,
                               -1, 0.2F, 0,  -0.3F, -1.2F, 0,  0.3F, 1.5F, 0,  1, 0,    0,
                               -1, 0.2F, 1,  -0.3F, 0,     1,  0.3F, 0.4F, 1,  1, 0.2F, 1};
  int columns = 4;                  ///< points in a row
  std::vector<float> weights = {};  ///< one a point; empty: 1
  int degree_u = 3;                 ///< of bspline, along the rows
  int degree_v = 3;                 ///< of bspline, from row to row; of revolution along the profile
  float tolerance = 0.01F;          ///< how far faces are from the surface at most
};

/// A smooth surface of control points as faces.
///
/// within   tolerance: by bounds of the second derivatives the steps are even between knots, the same for all of a row
///          or column, so there are no cracks. With weights that differ much they are finer than is needed
/// faces    quads, triangles where an edge is drawn together; seen from the side where u runs to the right and v down.
///          Places that are equal share a vertex
/// NORMAL   exact, of the derivatives; where one vanishes, that of a place 10⁻⁴ of the domain inside
/// TEXCOORD_0  of each corner: the parameters, 0–1
/// Throws   Error(Argument) for points that don't fill rows, weights that don't fit, too few points for a degree, more than
///          1024 steps each way; Error(Resource) beyond run.limits.memory_bytes
/// Source   math/nurbs_surface.h; Filip, Magedson & Markot, Surface algorithms using bounds on derivatives, 1986
AZULEJO_EXPORT Mesh surface(const SurfaceOptions& options = {}, const Run& run = {});

/// The same of any surface that check_surface takes.
AZULEJO_EXPORT Mesh tessellate_surface(const NurbsSurface& surface, double tolerance, const Run& run = {});

}  // namespace azulejo
