#include "azulejo/modelling/primitive.h"

#include <algorithm>
#include <numeric>
#include <string>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/engine/operation.h"
#include "azulejo/modelling/primitive_shapes.h"

namespace azulejo {
namespace {

constexpr double kLargest = 1e30;  // of a length
constexpr int kMostSteps = 4096;
constexpr int kMostSubdivisions = 10;

std::string name_of(PrimitiveKind kind) { return std::string(enum_names(kind)[static_cast<std::size_t>(kind)]); }

/// What a kind takes at least of segments and rings; 0: it has none.
struct Least {
  int segments = 0;
  int rings = 0;
};

Least least_of(PrimitiveKind kind) {
  switch (kind) {
    case PrimitiveKind::UvSphere: return {3, 2};
    case PrimitiveKind::Torus:
    case PrimitiveKind::KleinBottle: return {3, 3};
    case PrimitiveKind::TorusKnot: return {3, 8};
    case PrimitiveKind::Cylinder:
    case PrimitiveKind::Cone:
    case PrimitiveKind::Capsule:
    case PrimitiveKind::Disk:
    case PrimitiveKind::Tube:
    case PrimitiveKind::Mobius:
    case PrimitiveKind::Catenoid: return {3, 1};
    case PrimitiveKind::Plane:
    case PrimitiveKind::Helicoid:
    case PrimitiveKind::Enneper: return {1, 1};
    case PrimitiveKind::CubeSphere: return {1, 0};
    case PrimitiveKind::Teapot: return {2, 0};
    default: return {};
  }
}

int segments_of(PrimitiveKind kind) {
  switch (kind) {
    case PrimitiveKind::Plane: return 1;
    case PrimitiveKind::CubeSphere: return 12;
    case PrimitiveKind::Teapot: return 16;
    case PrimitiveKind::Tube:
    case PrimitiveKind::TorusKnot: return 24;
    case PrimitiveKind::Mobius:
    case PrimitiveKind::KleinBottle: return 96;
    default: return 48;
  }
}

int rings_of(PrimitiveKind kind, int segments) {
  switch (kind) {
    case PrimitiveKind::UvSphere:
    case PrimitiveKind::Torus: return std::max(segments / 2, least_of(kind).rings);
    case PrimitiveKind::Capsule: return std::max(segments / 4, 1);
    case PrimitiveKind::Disk:
    case PrimitiveKind::Mobius: return 8;
    case PrimitiveKind::Tube: return 12;
    case PrimitiveKind::TorusKnot: return 256;
    case PrimitiveKind::KleinBottle:
    case PrimitiveKind::Helicoid:
    case PrimitiveKind::Catenoid:
    case PrimitiveKind::Enneper: return 24;
    default: return 1;
  }
}

Error refused(PrimitiveKind kind, const std::string& got, const std::string& wanted) {
  return Error(Error::Argument, fmt::format("primitive: {}: {}, expected {}", name_of(kind), got, wanted));
}

/// The teapot's segments, by its tolerance.
int segments_within(const PrimitiveOptions& options) {
  if (options.segments) {
    throw refused(options.kind, fmt::format("segments is {} beside a tolerance", *options.segments), "one of them");
  }
  const double segments = teapot_segments(options);
  if (!(segments <= kMostSteps)) {
    throw refused(options.kind,
                  fmt::format("tolerance is {}, which takes {:.0f} segments", *options.tolerance, segments),
                  fmt::format("{} or fewer", kMostSteps));
  }
  return static_cast<int>(segments);
}

void fill_in(PrimitiveOptions& options) {
  if (options.kind == PrimitiveKind::Teapot && options.tolerance) options.segments = segments_within(options);
  if (!options.segments) options.segments = segments_of(options.kind);
  if (!options.rings) options.rings = rings_of(options.kind, *options.segments);
}

void check_steps(const PrimitiveOptions& options) {
  const Least least = least_of(options.kind);
  if (*options.segments < least.segments) {
    throw refused(options.kind, fmt::format("segments is {}", *options.segments),
                  fmt::format("{} or more", least.segments));
  }
  if (*options.rings < least.rings) {
    throw refused(options.kind, fmt::format("rings is {}", *options.rings), fmt::format("{} or more", least.rings));
  }
  if (options.kind == PrimitiveKind::Torus && !(options.tube_radius < options.radius)) {
    throw refused(options.kind, fmt::format("tube_radius is {}", options.tube_radius),
                  fmt::format("less than radius, {}", options.radius));
  }
  if (options.kind == PrimitiveKind::TorusKnot && std::gcd(options.around, options.through) != 1) {
    throw refused(options.kind, fmt::format("around is {} and through {}", options.around, options.through),
                  "numbers without a common divisor");
  }
  constexpr float kSteepest = 20;  // cosh of it is 2 · 10⁸
  if (options.kind == PrimitiveKind::Catenoid && !(options.height <= 2 * kSteepest * options.tube_radius)) {
    throw refused(options.kind, fmt::format("height is {}", options.height),
                  fmt::format("at most {} times tube_radius, {}", 2 * kSteepest, options.tube_radius));
  }
}

double faces_of(const PrimitiveOptions& options) {
  const double segments = *options.segments;
  switch (options.kind) {
    case PrimitiveKind::IcoSphere: return 20 * static_cast<double>(std::uint64_t{1} << (2 * options.subdivisions));
    case PrimitiveKind::Teapot: return 32 * segments * segments;
    case PrimitiveKind::CubeSphere: return 6 * segments * segments;
    case PrimitiveKind::Capsule: return segments * (2.0 * *options.rings + 1);
    case PrimitiveKind::Tube: {
      const std::size_t points = options.points.size() / 3;
      return segments * *options.rings * static_cast<double>(points);
    }
    default: return segments * *options.rings;
  }
}

void check_size(const PrimitiveOptions& options, const Run& run) {
  constexpr double kBytesPerFace = 300;  // with what is needed on the way
  const double bytes = kBytesPerFace * faces_of(options);
  if (bytes > static_cast<double>(run.limits.memory_bytes)) {
    throw Error(Error::Resource, fmt::format("primitive: {}: {:.0f} faces need about {:.0f} bytes, the limit is {}",
                                             name_of(options.kind), faces_of(options), bytes, run.limits.memory_bytes));
  }
}

Mesh make(const PrimitiveOptions& options) {
  switch (options.kind) {
    case PrimitiveKind::Cube: return make_cube(options);
    case PrimitiveKind::UvSphere: return make_uv_sphere(options);
    case PrimitiveKind::IcoSphere: return make_ico_sphere(options);
    case PrimitiveKind::Cylinder: return make_cylinder(options);
    case PrimitiveKind::Cone: return make_cone(options);
    case PrimitiveKind::Torus: return make_torus(options);
    case PrimitiveKind::Plane: return make_plane(options);
    case PrimitiveKind::Teapot: return make_teapot(options);
    case PrimitiveKind::Capsule: return make_capsule(options);
    case PrimitiveKind::Disk: return make_disk(options);
    case PrimitiveKind::CubeSphere: return make_cube_sphere(options);
    case PrimitiveKind::Tube: return make_tube(options);
    case PrimitiveKind::TorusKnot: return make_torus_knot(options);
    case PrimitiveKind::Mobius: return make_mobius(options);
    case PrimitiveKind::KleinBottle: return make_klein_bottle(options);
    case PrimitiveKind::Helicoid: return make_helicoid(options);
    case PrimitiveKind::Catenoid: return make_catenoid(options);
    case PrimitiveKind::Enneper: return make_enneper(options);
    case PrimitiveKind::Tetrahedron:
    case PrimitiveKind::Octahedron:
    case PrimitiveKind::Dodecahedron:
    case PrimitiveKind::Icosahedron: return make_platonic(options);
  }
  return {};
}

std::vector<Value> run_primitive(std::span<const Value>, const PrimitiveOptions& options, const Run& run) {
  std::vector<Value> results;
  results.emplace_back(primitive(options, run));
  return results;
}

}  // namespace

extern const Operation kPrimitive = with_examples(
    value_operation<PrimitiveOptions>(
        "primitive", "Makes a simple body or surface: a cube, spheres, a Platonic solid, a tube, a knot, the teapot.",
        {}, {{"mesh", "the body, around the origin, y up", ValueKind::Mesh}},
        {field("kind", &PrimitiveOptions::kind, "which body"),
         field("size", &PrimitiveOptions::size, {1e-30, kLargest}, "",
               "edge of cube and plane, length of the teapot, largest side of klein_bottle and enneper"),
         field("radius", &PrimitiveOptions::radius, {1e-30, kLargest}, "",
               "of round bodies, the ring of torus, knot and strip, the helicoid, the solids' corners"),
         field("height", &PrimitiveOptions::height, {1e-30, kLargest}, "",
               "of cylinder, cone, helicoid and catenoid; of the capsule without its ends"),
         field("tube_radius", &PrimitiveOptions::tube_radius, {1e-30, kLargest}, "",
               "of torus, tube and torus_knot; half the strip's width, the catenoid's waist"),
         field("segments", &PrimitiveOptions::segments, {1, kMostSteps}, "",
               "faces around, along the plane, along a side of the teapot's patches and of the cube sphere"),
         field(
             "rings", &PrimitiveOptions::rings, {1, kMostSteps}, "",
             "faces from top to bottom, around the torus' tube, across the plane, along a knot, from point to point of "
             "a tube"),
         field("subdivisions", &PrimitiveOptions::subdivisions, {0, kMostSubdivisions}, "",
               "of the ico sphere: each cuts every face in four"),
         field("smooth", &PrimitiveOptions::smooth, "normals of the curved surface; else of its flat faces"),
         field("points", &PrimitiveOptions::points, {-kLargest, kLargest}, "", "of the tube: x, y and z of each"),
         field("closed", &PrimitiveOptions::closed, "the tube goes back to its first point"),
         field("around", &PrimitiveOptions::around, {1, 100}, "", "turns of the torus knot around the axis"),
         field("through", &PrimitiveOptions::through, {1, 100}, "", "its turns through the hole"),
         field("turns", &PrimitiveOptions::turns, {0.01, 1000}, "", "of the helicoid"),
         field("tolerance", &PrimitiveOptions::tolerance, {1e-30, kLargest}, "",
               "of the teapot, in place of segments: how far faces are from the patches at most")},
        run_primitive),
    {{"primitive:kind=teapot", "The teapot, of 32 Bézier patches."},
     {"primitive:kind=tube,points=-1,0,0,-0.5,1,0,0.5,-1,0,1,0,0,tube_radius=0.15", "A tube through four points."},
     {"primitive:kind=torus_knot,around=3,through=5,tube_radius=0.2", "A knot on a torus."},
     {"primitive:kind=klein_bottle", "A surface without inside and outside."},
     {"primitive:kind=torus,smooth=false,segments=24,rings=12", "A ring of flat faces."}});

Mesh primitive(const PrimitiveOptions& options, const Run& run) {
  kPrimitive.check(&options);
  PrimitiveOptions filled = options;
  fill_in(filled);
  check_steps(filled);
  check_size(filled, run);
  Mesh mesh = make(filled);
  mesh.name = name_of(options.kind);
  return mesh;
}

}  // namespace azulejo
