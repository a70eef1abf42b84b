// The operation `normals`, and turning a surface inside out.
#include <algorithm>
#include <numbers>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/engine/operation.h"
#include "azulejo/io/weld.h"
#include "azulejo/modelling/normals.h"
#include "azulejo/modelling/picked_attribute.h"

namespace azulejo {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 14;

/// Changes the sign of some components of an attribute of floats.
void negate(Attribute& attribute, int first, int last) {
  auto* const values = std::get_if<Array<float>>(&attribute.values);
  if (values == nullptr || attribute.components < last) return;
  for (std::size_t i = 0; i < attribute.size(); ++i) {
    float* const element = values->data() + i * static_cast<std::size_t>(attribute.components);
    for (int c = first; c < last; ++c) element[c] = -element[c];
  }
}

Attribute of_corners(const Mesh& mesh, const Run& run) {
  const Array<glm::vec3> normals = face_normals(mesh, run);
  Array<float> values(3 * mesh.corner_count());
  parallel_for(mesh.face_count(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      for (std::size_t c = mesh.face_begin(f); c < mesh.face_end(f); ++c) {
        for (int i = 0; i < 3; ++i) values[3 * c + static_cast<std::size_t>(i)] = normals[f][i];
      }
    }
  });
  return {"NORMAL", Domain::Corner, 3, std::move(values)};
}

Attribute of_positions(const Mesh& mesh, const NormalsOptions& options, const Run& run) {
  Welded welded = weld_exactly(mesh.positions, run);
  Mesh joined;
  joined.positions = std::move(welded.positions);
  joined.face_offsets = mesh.face_offsets;
  joined.corners.resize(mesh.corner_count());
  for (std::size_t c = 0; c < mesh.corner_count(); ++c) joined.corners[c] = welded.corners[mesh.corners[c]];
  Attribute normals = vertex_normals(joined, options, run);
  return normals.domain == Domain::Vertex ? picked(normals, welded.corners) : std::move(normals);
}

Attribute normals_of(const Mesh& mesh, const SetNormalsOptions& options, const Run& run) {
  if (options.weight == NormalsFrom::Face) return of_corners(mesh, run);
  NormalsOptions smooth;
  if (options.weight == NormalsFrom::Area) smooth.weight = NormalWeight::Area;
  if (options.weight == NormalsFrom::Uniform) smooth.weight = NormalWeight::Uniform;
  if (options.crease_angle_deg) {
    smooth.crease_angle =
        std::min(*options.crease_angle_deg * (std::numbers::pi_v<float> / 180), std::numbers::pi_v<float>);
  }
  return options.by_position ? of_positions(mesh, smooth, run) : vertex_normals(mesh, smooth, run);
}

}  // namespace

Mesh flipped(const Mesh& mesh, const Run& run) {
  Mesh result = mesh.clone();
  Array<std::uint32_t> from(mesh.corner_count());
  parallel_for(mesh.face_count(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const std::size_t first = mesh.face_begin(f);
      const std::size_t count = mesh.face_end(f) - first;
      for (std::size_t i = 0; i < count; ++i) from[first + i] = static_cast<std::uint32_t>(first + (count - i) % count);
    }
  });
  for (std::size_t c = 0; c < from.size(); ++c) result.corners[c] = mesh.corners[from[c]];
  for (Attribute& each : result.attributes) {
    if (each.domain == Domain::Corner) each = picked(each, from);
    if (each.name == "NORMAL") negate(each, 0, 3);
    if (each.name == "TANGENT") negate(each, 3, 4);
  }
  for (MorphTarget& each : result.morph_targets) {
    for (glm::vec3& normal : each.normals) normal = -normal;
  }
  return result;
}

Mesh normals(const Mesh& mesh, const SetNormalsOptions& options, const Run& run) {
  if (options.crease_angle_deg && !(*options.crease_angle_deg >= 0 && *options.crease_angle_deg <= 180)) {
    throw Error(Error::Argument,
                fmt::format("normals: crease_angle_deg is {}, expected 0 to 180", *options.crease_angle_deg));
  }
  Mesh result = options.flip ? flipped(mesh, run) : mesh.clone();
  if (result.face_count() == 0) return result;
  std::erase_if(result.attributes,
                [](const Attribute& each) { return each.name == "NORMAL" || each.name == "TANGENT"; });
  for (MorphTarget& each : result.morph_targets) each.normals.clear();
  Attribute normals = normals_of(result, options, run);
  result.attributes.push_back(std::move(normals));
  return result;
}

extern const Operation kNormals = with_examples(
    value_operation<SetNormalsOptions>(
        "normals", "Gives a surface new normals.", {{"source", "the mesh", ValueKind::Mesh}},
        {{"mesh", "the mesh with NORMAL of its vertices, or of its corners where a vertex has several",
          ValueKind::Mesh}},
        {field("weight", &SetNormalsOptions::weight,
               "how much faces count for the normal of a vertex; face: each face has its own"),
         field("crease_angle_deg", &SetNormalsOptions::crease_angle_deg, {0, 180}, "deg",
               "faces that meet at more are not smoothed together; auto: all are"),
         field("by_position", &SetNormalsOptions::by_position, "vertices at exactly equal positions have one normal"),
         field("flip", &SetNormalsOptions::flip, "the surface is turned inside out")},
        [](std::span<const Value> inputs, const SetNormalsOptions& options, const Run& run) {
          return std::vector<Value>{Value(normals(*inputs[0].mesh(), options, run))};
        }),
    {{"primitive:kind=cylinder normals render:width=480,height=360",
      "All smoothed together: a cylinder that looks like a barrel."},
     {"primitive:kind=cylinder normals:crease_angle_deg=30 render:width=480,height=360",
      "Its edges are creases again."},
     {"primitive:kind=torus,segments=24 normals:weight=face render:width=480,height=360",
      "Each face with its own normal."}});

}  // namespace azulejo
