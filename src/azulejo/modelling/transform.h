#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

#include "azulejo/core/export.h"
#include "azulejo/core/run.h"
#include "azulejo/data/drawing.h"
#include "azulejo/data/mesh.h"
#include "azulejo/data/scene.h"
#include "azulejo/math/transform_steps.h"

namespace azulejo {

/// Moves, turns, scales, shears or mirrors a model. Images have affine(), in imaging/affine.h.
///
/// Steps are done in the order in which they are given. As options on the command line, `about` (what stays where it
/// is) and `axis` (of a rotation) belong to the step before them, or to the first: rotate_deg=30,about=1,2
///
/// drawing  everything on the page is moved, the page is not. y points down; positive angles turn counter-clockwise as
///          seen. `center` is the page's
/// mesh     positions, normals, tangents and morph targets. Where it mirrors, faces turn around (their first corner
///          stays the first), so that outside stays outside. `center` is the middle of the bounds
/// scene    a new root above all others carries the matrix; meshes, cameras, lights and animations move with it
/// Numbers  matrices are worked out in double and applied in f32; the same bytes for any thread count
/// NaN      passes
/// Throws   Error(Argument) for a projective matrix, see also picture_transform and space_transform
/// Cost     O(vertices + corners); of drawings and scenes O(1) beside the copy
/// Source   Foley, van Dam, Feiner, Hughes, Computer Graphics: Principles and Practice, 2nd ed., 5; for normals Turkowski,
///          Transformations of surface normal vectors, Apple TR 22 (1990)
AZULEJO_EXPORT Mesh transform(const Mesh& mesh, const glm::dmat4& target_from_source, const Run& run = {});
AZULEJO_EXPORT Mesh transform(const Mesh& mesh, const TransformOptions& options, const Run& run = {});
AZULEJO_EXPORT Scene transform(const Scene& scene, const glm::dmat4& target_from_source);
AZULEJO_EXPORT Scene transform(const Scene& scene, const TransformOptions& options);
AZULEJO_EXPORT Drawing transform(const Drawing& drawing, const glm::dmat3& target_from_source);
AZULEJO_EXPORT Drawing transform(const Drawing& drawing, const TransformOptions& options);

}  // namespace azulejo
