#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/drawing.h"
#include "azulejo/data/mesh.h"
#include "azulejo/modelling/polygon.h"

namespace azulejo {

struct TessellateOptions {
  float tolerance = 0.1F;  ///< of the drawing's unit: how far lines may be from curves
};

/// What a drawing fills, as triangles in the plane z = 0, upright: a point (x, y) of the drawing is at (x, −y, 0), faces
/// look along +z. Each path has its own vertices and triangles, in the order of painting, as `tessellate` of polygon.h
/// makes them; what lies under another path is there, too.
///
/// COLOR_0     of each vertex, u8: the fill's color with its opacity; of a gradient, its first color; of hatches and
///             stipples their color
/// path        of each face, u32: index of the drawing's path
/// left out    strokes, points, clips (`run.warn` says so), paths without a fill or area
/// Stages      `monotone_pieces`, the polygons that are divided into triangles, as a drawing
/// Throws      as polygon.h; Error(Argument) for an option out of range
/// Cost        O(n log n) and what crossings add; paths on all threads
AZULEJO_EXPORT Mesh tessellate(const Drawing& drawing, const TessellateOptions& options = {}, const Run& run = {});

/// A mesh with its faces divided into triangles over their own corners, as `triangulate` does: all attributes and
/// materials stay; faces of fewer than three corners go.
AZULEJO_EXPORT Mesh tessellate(const Mesh& mesh, const Run& run = {});

}  // namespace azulejo
