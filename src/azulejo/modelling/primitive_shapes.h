#pragma once

#include "azulejo/data/mesh.h"
#include "azulejo/modelling/primitive.h"

namespace azulejo {

// The bodies of primitive(), with `segments` and `rings` given and everything in range.
Mesh make_uv_sphere(const PrimitiveOptions& options);
Mesh make_cylinder(const PrimitiveOptions& options);
Mesh make_cone(const PrimitiveOptions& options);
Mesh make_torus(const PrimitiveOptions& options);
Mesh make_cube(const PrimitiveOptions& options);
Mesh make_plane(const PrimitiveOptions& options);
/// Also the cube's kin: tetrahedron, octahedron, dodecahedron, icosahedron.
Mesh make_platonic(const PrimitiveOptions& options);
Mesh make_ico_sphere(const PrimitiveOptions& options);
Mesh make_teapot(const PrimitiveOptions& options);
/// Segments of a patch's side that keep chords within options.tolerance of the teapot.
double teapot_segments(const PrimitiveOptions& options);
Mesh make_capsule(const PrimitiveOptions& options);
Mesh make_disk(const PrimitiveOptions& options);
Mesh make_catenoid(const PrimitiveOptions& options);
Mesh make_cube_sphere(const PrimitiveOptions& options);
Mesh make_tube(const PrimitiveOptions& options);
Mesh make_torus_knot(const PrimitiveOptions& options);
Mesh make_mobius(const PrimitiveOptions& options);
Mesh make_klein_bottle(const PrimitiveOptions& options);
Mesh make_helicoid(const PrimitiveOptions& options);
Mesh make_enneper(const PrimitiveOptions& options);

}  // namespace azulejo
