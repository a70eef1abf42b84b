#include "azulejo/modelling/primitive.h"

#include <algorithm>
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
constexpr int kAutoSegments = 48;
constexpr int kAutoPatchSteps = 16;

std::string name_of(PrimitiveKind kind) { return std::string(enum_names(kind)[static_cast<std::size_t>(kind)]); }

/// What a kind takes at least of segments and rings; 0: it has none.
struct Least {
  int segments = 0;
  int rings = 0;
};

Least least_of(PrimitiveKind kind) {
  switch (kind) {
    case PrimitiveKind::UvSphere: return {3, 2};
    case PrimitiveKind::Torus: return {3, 3};
    case PrimitiveKind::Cylinder:
    case PrimitiveKind::Cone: return {3, 1};
    case PrimitiveKind::Plane: return {1, 1};
    case PrimitiveKind::Teapot: return {2, 0};
    default: return {};
  }
}

void fill_in(PrimitiveOptions& options) {
  const PrimitiveKind kind = options.kind;
  const bool whole = kind == PrimitiveKind::UvSphere || kind == PrimitiveKind::Torus;
  if (!options.segments) {
    options.segments = kind == PrimitiveKind::Teapot  ? kAutoPatchSteps
                       : kind == PrimitiveKind::Plane ? 1
                                                      : kAutoSegments;
  }
  if (!options.rings) options.rings = whole ? std::max(*options.segments / 2, least_of(kind).rings) : 1;
}

Error refused(PrimitiveKind kind, const std::string& got, const std::string& wanted) {
  return Error(Error::Argument, fmt::format("primitive: {}: {}, expected {}", name_of(kind), got, wanted));
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
}

double faces_of(const PrimitiveOptions& options) {
  const double segments = *options.segments;
  switch (options.kind) {
    case PrimitiveKind::IcoSphere: return 20 * static_cast<double>(std::uint64_t{1} << (2 * options.subdivisions));
    case PrimitiveKind::Teapot: return 32 * segments * segments;
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
        "primitive", "Makes a simple body: a cube, a sphere, a Platonic solid, the teapot.", {},
        {{"mesh", "the body, around the origin, y up", ValueKind::Mesh}},
        {field("kind", &PrimitiveOptions::kind, "which body"),
         field("size", &PrimitiveOptions::size, {1e-30, kLargest}, "", "edge of cube and plane, length of the teapot"),
         field("radius", &PrimitiveOptions::radius, {1e-30, kLargest}, "",
               "of spheres, cylinder, cone, the torus' ring, the solids' corners"),
         field("height", &PrimitiveOptions::height, {1e-30, kLargest}, "", "of cylinder and cone"),
         field("tube_radius", &PrimitiveOptions::tube_radius, {1e-30, kLargest}, "",
               "of the torus; less than its radius"),
         field("segments", &PrimitiveOptions::segments, {1, kMostSteps}, "",
               "faces around, along the plane, along a side of the teapot's patches"),
         field("rings", &PrimitiveOptions::rings, {1, kMostSteps}, "",
               "faces from top to bottom, around the torus' tube, across the plane"),
         field("subdivisions", &PrimitiveOptions::subdivisions, {0, kMostSubdivisions}, "",
               "of the ico sphere: each cuts every face in four"),
         field("smooth", &PrimitiveOptions::smooth, "normals of the curved surface; else of its flat faces")},
        run_primitive),
    {{"primitive:kind=teapot", "The teapot, of 32 Bézier patches."},
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
