#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/drawing.h"
#include "azulejo/data/mesh.h"

namespace azulejo {

/// What the faces of a convex hull are.
enum class HullFaces : std::uint8_t {
  Triangles,  ///< what lies in one plane is divided, from its corner with the least x, then y, then z
  Polygons    ///< one face for each plane
};
constexpr std::array<std::string_view, 2> enum_names(HullFaces) { return {"triangles", "polygons"}; }

struct ConvexHullOptions {
  HullFaces faces = HullFaces::Triangles;
};

/// The smallest convex solid that holds all vertices of a mesh, used by faces or not, as a closed surface that looks
/// outwards. Exact: every vertex is inside or on every face by the sign of exact determinants. Its vertices are the
/// corners of the solid only, none in the middle of an edge or a face, and the same whatever order they come in.
///
/// vertices    in their order, with their very coordinates and attributes; of those at one place, the first
/// attributes  of vertices, but not NORMAL and TANGENT, which are another surface's; those of corners and faces,
///             materials, lines and morph targets are left out
/// flat        all in one plane: one polygon, or its triangles, whose normal's largest component is positive; on one
///             line: two vertices and a line; at one place: one vertex; none: nothing
/// NaN, infinite  such vertices are left out; `run.warn` says how many
/// Cost        O(n log n) for points as they come. A ball of 10⁶ random points takes less than a tenth of a second, most
///             of which never get beyond a look at a table (on all threads)
/// Source      see quick_hull.h
/// Throws      Error(Argument) for an option out of range; Error(Cancelled)
AZULEJO_EXPORT Mesh convex_hull(const Mesh& mesh, const ConvexHullOptions& options = {}, const Run& run = {});

struct DrawingHullOptions {
  float tolerance = 0.1F;  ///< of the drawing's unit: how far lines may be from curves
};

/// The smallest convex area that holds all paths of a drawing, as one path in the style of the first. Exact for the
/// points of the paths, once curves are lines. Widths of lines and clips count for nothing (of clips, `run.warn` says
/// so); points with coordinates that aren't finite are left out.
///
/// flat  all on one line: an open path of two points, which strokes show; nothing else: no path
AZULEJO_EXPORT Drawing convex_hull(const Drawing& drawing, const DrawingHullOptions& options = {}, const Run& run = {});

}  // namespace azulejo
