#pragma once

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/mesh.h"

namespace azulejo {

struct TangentsOptions {
  int texcoord = 0;  ///< TEXCOORD_n that the normal texture is looked up with
};

/// The mesh with TANGENT, as glTF has it and normal textures are baked for: a unit vector to where u rises, across the
/// normal's plane, and w = ±1, with which cross(NORMAL, TANGENT) · w points to where v falls (up in the image).
///
/// corners   that agree in position, normal and texture coordinate are one, whatever vertex they are of; the faces around
///           one that are joined by edges and have textures of the same handedness share a tangent: the sum of theirs,
///           each turned into the normal's plane, weighted by its angle there
/// domain    vertex where all corners of each vertex agree, else corner
/// faces     quads are two triangles along the diagonal that is shorter in the texture; larger ones as `triangulate`
///           divides them
/// nothing   triangles without an area in the texture take the tangents of their neighbors, those without one in space
///           that of an equal corner; where there is none, any vector across the normal, w = 1
/// NORMAL    computed where the mesh has none, by angle; a mesh without faces or the texture coordinates stays as it is,
///           with a warning
/// Cost      O(corners), for any mesh O(corners · log corners)
/// Source    Mikkelsen, Simulation of wrinkled surfaces revisited, 2008
AZULEJO_EXPORT Mesh tangents(const Mesh& mesh, const TangentsOptions& options = {}, const Run& run = {});

}  // namespace azulejo
