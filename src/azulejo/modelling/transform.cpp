#include "azulejo/modelling/transform.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "azulejo/core/error.h"
#include "azulejo/core/parallel.h"
#include "azulejo/engine/operation.h"
#include "azulejo/engine/transform_fields.h"
#include "azulejo/math/transform2d.h"
#include "azulejo/math/transform3d.h"
#include "azulejo/modelling/turn_directions.h"

namespace azulejo {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 14;  // elements

/// The matrix, its last row 0, …, 0, 1. Throws if it is projective.
template <glm::length_t N>
glm::mat<N, N, double> affine_only(const glm::mat<N, N, double>& m) {
  bool projective = m[N - 1][N - 1] == 0;
  for (glm::length_t column = 0; column < N - 1; ++column) projective = projective || m[column][N - 1] != 0;
  if (projective) {
    throw Error(Error::Argument, fmt::format("matrix: its last row is not {}1, expected an affine transformation",
                                             N == 3 ? "0,0," : "0,0,0,"));
  }
  return m / m[N - 1][N - 1];
}

void move_points(const glm::mat4& m, std::span<glm::vec3> points, bool directions, const Run& run) {
  parallel_for(points.size(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    const auto part = points.subspan(begin, end - begin);
    if (directions) {
      transform_directions(m, part, part);
    } else {
      transform_points(m, part, part);
    }
  });
}

std::span<glm::vec3> all_of(Array<glm::vec3>& points) { return {points.data(), points.size()}; }

/// A vector turned by the normal matrix, at the length that it had.
glm::vec3 turned_normal(const glm::dmat3& matrix, const glm::vec3& normal) {
  const glm::dvec3 turned = matrix * glm::dvec3(normal);
  const double length = glm::length(turned);
  return length > 0 ? glm::vec3(turned * (static_cast<double>(glm::length(normal)) / length)) : glm::vec3(0);
}

/// Differences of normals: what is added to the turned normals gives what the sums have become.
void move_morph_normals(const Mesh& mesh, const glm::dmat3& linear, Array<glm::vec3>& differences) {
  const glm::dmat3 matrix = normal_matrix(linear);
  const Attribute* const normals = mesh.find("NORMAL");
  const Array<float>* const values = normals != nullptr && normals->domain == Domain::Vertex && normals->components == 3
                                         ? normals->get<float>()
                                         : nullptr;
  for (std::size_t v = 0; v < differences.size(); ++v) {
    const glm::vec3 base =
        values == nullptr ? glm::vec3(0) : glm::vec3((*values)[3 * v], (*values)[3 * v + 1], (*values)[3 * v + 2]);
    differences[v] = turned_normal(matrix, base + differences[v]) - turned_normal(matrix, base);
  }
}

/// Puts the values of a face's corners behind the first in the opposite order.
template <class T>
void turn_faces(const Mesh& mesh, std::size_t components, Array<T>& values, const Run& run) {
  parallel_for(mesh.face_count(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      std::size_t low = mesh.face_begin(f) + 1;
      std::size_t high = mesh.face_end(f);
      while (low + 1 < high) {
        --high;
        std::swap_ranges(values.begin() + static_cast<std::ptrdiff_t>(low * components),
                         values.begin() + static_cast<std::ptrdiff_t>((low + 1) * components),
                         values.begin() + static_cast<std::ptrdiff_t>(high * components));
        ++low;
      }
    }
  });
}

glm::dvec3 center_of(const Box3& box) { return box.empty() ? glm::dvec3(0) : glm::dvec3(box.center()); }

glm::dvec2 center_of(const Drawing& drawing) { return {0.5 * drawing.width, 0.5 * drawing.height}; }

}  // namespace

Mesh transform(const Mesh& mesh, const glm::dmat4& target_from_source, const Run& run) {
  const glm::dmat4 exact = affine_only(target_from_source);
  const glm::mat4 m(exact);
  const glm::dmat3 linear(exact);
  Mesh result = mesh.clone();
  move_points(m, all_of(result.positions), false, run);
  for (MorphTarget& target : result.morph_targets) {
    move_points(m, all_of(target.positions), true, run);
    move_morph_normals(mesh, linear, target.normals);
  }
  for (Attribute& each : result.attributes) {
    const std::size_t elements = each.size();
    if (auto* const values = std::get_if<Array<float>>(&each.values))
      turn_directions(each.name, each.components, linear, values->data(), elements, run);
  }
  if (!is_mirroring(exact)) return result;
  turn_faces(mesh, 1, result.corners, run);
  for (Attribute& each : result.attributes) {
    if (each.domain != Domain::Corner) continue;
    std::visit([&](auto& values) { turn_faces(mesh, static_cast<std::size_t>(each.components), values, run); },
               each.values);
  }
  return result;
}

Mesh transform(const Mesh& mesh, const TransformOptions& options, const Run& run) {
  return transform(mesh, space_transform(options, center_of(bounds(mesh))), run);
}

Scene transform(const Scene& scene, const glm::dmat4& target_from_source) {
  const glm::mat4 m(affine_only(target_from_source));
  Scene result = scene.clone();
  if (result.roots.empty()) return result;
  Node root;
  root.name = "transform";
  root.placement = m;
  root.children = std::move(result.roots);
  result.roots = {NodeId(result.nodes.size())};
  result.nodes.push_back(std::move(root));
  return result;
}

Scene transform(const Scene& scene, const TransformOptions& options) {
  return transform(scene, space_transform(options, center_of(bounds(scene))));
}

Drawing transform(const Drawing& drawing, const glm::dmat3& target_from_source) {
  const glm::dmat3 m = affine_only(target_from_source);
  Drawing result = drawing.clone();
  glm::mat3x2& page_from_drawing = result.groups[0].parent_from_group;
  page_from_drawing = affine_part(m * matrix_of(page_from_drawing));
  return result;
}

Drawing transform(const Drawing& drawing, const TransformOptions& options) {
  return transform(drawing, picture_transform(options, center_of(drawing)));
}

namespace {

TransformOptions& same(void* options) { return *static_cast<TransformOptions*>(options); }

/// The operation for one kind of value. matrix(value, options) is what `transformed` is called with.
template <class MatrixOf, class Transformed, class ReportOf>
Operation transform_operation(ValueKind kind, std::vector<Field> fields, MatrixOf matrix_of_value,
                              Transformed transformed, ReportOf report_of) {
  return value_operation<TransformOptions>(
      "transform", "Moves, turns, scales, shears or mirrors, in any order.", {{"source", "what is transformed", kind}},
      {{"result", "where it has come to", kind},
       {.name = "report",
        .help = "matrix, class, and what it decomposes into",
        .kind = ValueKind::Report,
        .on_request = true}},
      std::move(fields),
      [matrix_of_value, transformed, report_of](std::span<const Value> inputs, const TransformOptions& options,
                                                const Run& run) {
        const auto m = matrix_of_value(inputs[0], options);
        return std::vector<Value>{transformed(inputs[0], m, run), Value(report_of(m))};
      });
}

}  // namespace

extern const Operation kTransformImage;  // in imaging/affine.cpp

extern const Operation kTransformDrawing = transform_operation(
    ValueKind::Drawing, picture_transform_fields(same),
    [](const Value& value, const TransformOptions& options) {
      return picture_transform(options, center_of(*value.drawing()));
    },
    [](const Value& value, const glm::dmat3& m, const Run&) { return Value(transform(*value.drawing(), m)); },
    picture_transform_report);

extern const Operation kTransformScene = transform_operation(
    ValueKind::Scene, space_transform_fields(same),
    [](const Value& value, const TransformOptions& options) {
      return space_transform(options, center_of(bounds(*value.scene())));
    },
    [](const Value& value, const glm::dmat4& m, const Run&) { return Value(transform(*value.scene(), m)); },
    space_transform_report);

extern const Operation kTransform = with_examples(
    with_variants(transform_operation(
                      ValueKind::Mesh, space_transform_fields(same),
                      [](const Value& value, const TransformOptions& options) {
                        return space_transform(options, center_of(bounds(*value.mesh())));
                      },
                      [](const Value& value, const glm::dmat4& m, const Run& run) {
                        return Value(transform(*value.mesh(), m, run));
                      },
                      space_transform_report),
                  {&kTransformScene, &kTransformDrawing, &kTransformImage}),
    {{"photo.png transform:rotate_deg=20,about=center", "Counter-clockwise around its middle; corners are cut off."},
     {"photo.png transform:shear=0.4,0,rotate_deg=15,scale=0.8,size=fit,border=clamp",
      "Sheared, then turned, then made smaller; all of it is shown."},
     {"primitive:kind=teapot transform:scale=1,2,1,rotate_deg=-30,axis=0,0,1 render",
      "A model twice as high, then tilted."}});

}  // namespace azulejo
