#pragma once

#include "azulejo/io/model_codec.h"

namespace azulejo {

/// Wavefront OBJ with MTL: a Scene of one mesh, or of one for each `o`.
///
/// Geometry   v (with colours behind, sRGB 0–1, or 0–255 where one exceeds 1: COLOR_0), vt (turned so that (0, 0) is
///            the top left: TEXCOORD_0), vn (NORMAL), f with any number of corners, l, p; negative indices; lines that
///            go on behind \; UTF-8 and UTF-16; all ends of lines
/// Objects    an `o` begins a mesh that has the vertices which its elements use, in the order of the file. A file with
///            one object keeps all vertices; where none has elements, objects are point clouds. `g` divides nothing.
/// Domains    vt and vn are attributes of the vertices where each vertex has one only, else of the corners; corners
///            that name none get zeros
/// Faces      fewer than three corners: left out, with a warning; an index out of range: Error(Data) with the line
/// Smoothing  the face attribute SMOOTHING_GROUP (u32, 0: hard) where faces differ in it
/// Skipped    curves and surfaces, and unknown statements, with one warning
/// Materials  see mtl.h; what is missing is warned of
///
/// Written with nodes in world coordinates, and materials and textures beside it.
extern const ModelCodec kObj;

}  // namespace azulejo
