#pragma once

#include "azulejo/core/run.h"
#include "azulejo/modelling/subdivision_level.h"

namespace azulejo::subdivision {

/// Values of the vertices of a level, `components` (1–4) of each: positions, attributes. `out` has those of the level
/// below: old vertices, edges, faces.

/// Of triangles, without values of faces.
void refine_loop(const Level& level, int components, const float* in, float* out, const Run& run);
void refine_catmull_clark(const Level& level, int components, const float* in, float* out, const Run& run);
/// Means of each edge and, `with_centers`, each face; vertices stay.
void refine_linear(const Level& level, bool with_centers, int components, const float* in, float* out, const Run& run);

/// Where endless subdivision takes the vertices of a level: of triangles, of quads.
void loop_limit(const Level& level, int components, const float* in, float* out, const Run& run);
void catmull_clark_limit(const Level& level, int components, const float* in, float* out, const Run& run);

/// √3: an odd level leaves sharp edges, an even one cuts them in three.
/// Values of the level below come in the order of its vertices: old ones, the centers of faces without a sharp edge (at
/// an odd level of all), two on each sharp edge (at an even level), the one near its first vertex before the other.
struct Sqrt3Step {
  Level next;
  Array<std::uint32_t> centers;  ///< vertex of each face's center; kNone
  Array<std::uint32_t> thirds;   ///< at an even level the first vertex on each sharp edge; kNone
};
/// Corner c of the level gives triangle c of the next: two beside each edge that turns, one beside each sharp edge.
Sqrt3Step split_sqrt3(const Level& level, bool even, bool whole, const Run& run);
void refine_sqrt3(const Level& level, const Sqrt3Step& step, int components, const float* in, float* out,
                  const Run& run);
void sqrt3_limit(const Level& level, int components, const float* in, float* out, const Run& run);

}  // namespace azulejo::subdivision
