#include "azulejo/modelling/subdivision_source.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "azulejo/core/parallel.h"
#include "azulejo/modelling/picked_attribute.h"
#include "azulejo/modelling/tessellate.h"
#include "azulejo/modelling/triangulate.h"

namespace azulejo::subdivision {
namespace {

constexpr std::size_t kChunk = 4096;  // faces

/// Faces over corners of a mesh that has other ones.
struct NewFaces {
  Array<std::uint32_t> corners;
  Array<std::uint32_t> offsets = {0};
  Array<std::uint32_t> parents;

  void end_face(std::size_t parent) {
    offsets.push_back(static_cast<std::uint32_t>(corners.size()));
    parents.push_back(static_cast<std::uint32_t>(parent));
  }
};

void replace_faces(Mesh& mesh, NewFaces faces) {
  for (Attribute& each : mesh.attributes) {
    if (each.domain == Domain::Corner) each = picked(each, faces.corners);
    if (each.domain == Domain::Face) each = picked(each, faces.parents);
  }
  if (!mesh.material.empty()) {
    for (std::uint32_t& parent : faces.parents) parent = mesh.material[parent];
    mesh.material = std::move(faces.parents);
  }
  for (std::uint32_t& corner : faces.corners) corner = mesh.corners[corner];
  mesh.corners = std::move(faces.corners);
  mesh.face_offsets = std::move(faces.offsets);
}

/// Whether each of the faces holds; at once for all.
template <class Holds>
Array<std::uint8_t> faces_where(const Mesh& mesh, const Run& run, Holds holds) {
  Array<std::uint8_t> result(mesh.face_count());
  parallel_for(mesh.face_count(), kChunk, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) result[f] = holds(f) ? 1 : 0;
  });
  return result;
}

bool any(const Array<std::uint8_t>& faces) { return std::find(faces.begin(), faces.end(), 1) != faces.end(); }

void drop_degenerate(Mesh& mesh, const Run& run) {
  const Array<std::uint8_t> wrong = faces_where(mesh, run, [&](std::size_t face) {
    const std::size_t begin = mesh.face_begin(face);
    const std::size_t end = mesh.face_end(face);
    if (end - begin < 3) return true;
    for (std::size_t c = begin; c < end; ++c) {
      if (mesh.corners[c] == mesh.corners[c + 1 == end ? begin : c + 1]) return true;
    }
    return false;
  });
  if (!any(wrong)) return;
  NewFaces kept;
  for (std::size_t f = 0; f < wrong.size(); ++f) {
    const std::size_t begin = mesh.face_begin(f);
    const std::size_t end = mesh.face_end(f);
    const std::size_t before = kept.corners.size();
    for (std::size_t c = begin; c < end; ++c) {
      if (mesh.corners[c] == mesh.corners[c == begin ? end - 1 : c - 1]) continue;
      kept.corners.push_back(static_cast<std::uint32_t>(c));
    }
    if (kept.corners.size() - before < 3) {
      kept.corners.resize(before);
    } else {
      kept.end_face(f);
    }
  }
  replace_faces(mesh, std::move(kept));
}

/// Whether the triangles between the mean of a face's corners and its sides all turn as the face does.
bool is_covered_from_mean(const Mesh& mesh, std::size_t face) {
  const std::size_t begin = mesh.face_begin(face);
  const std::size_t end = mesh.face_end(face);
  const auto point = [&](std::size_t corner) { return glm::dvec3(mesh.positions[mesh.corners[corner]]); };
  glm::dvec3 mean(0);
  for (std::size_t c = begin; c < end; ++c) mean += point(c);
  mean /= static_cast<double>(end - begin);
  glm::dvec3 normal(0);
  for (std::size_t c = begin; c < end; ++c) {
    normal += glm::cross(point(c) - mean, point(c + 1 == end ? begin : c + 1) - mean);
  }
  for (std::size_t c = begin; c < end; ++c) {
    if (glm::dot(normal, glm::cross(point(c) - mean, point(c + 1 == end ? begin : c + 1) - mean)) < 0) return false;
  }
  return true;
}

void cut_uncovered(Mesh& mesh, const Run& run) {
  const Array<std::uint8_t> cut =
      faces_where(mesh, run, [&](std::size_t face) { return !is_covered_from_mean(mesh, face); });
  if (!any(cut)) return;
  const Triangulation triangles = triangulate(mesh, run);
  NewFaces faces;
  std::size_t t = 0;
  for (std::size_t f = 0; f < cut.size(); ++f) {
    for (; t < triangles.face.size() && triangles.face[t] == f; ++t) {
      if (cut[f] == 0) continue;
      for (std::size_t k = 3 * t; k < 3 * t + 3; ++k) faces.corners.push_back(triangles.corners[k]);
      faces.end_face(f);
    }
    if (cut[f] != 0) continue;
    for (std::size_t c = mesh.face_begin(f); c < mesh.face_end(f); ++c) {
      faces.corners.push_back(static_cast<std::uint32_t>(c));
    }
    faces.end_face(f);
  }
  replace_faces(mesh, std::move(faces));
}

void forget_offsets_of_triangles(Mesh& mesh, const Run& run) {
  const Array<std::uint8_t> other =
      faces_where(mesh, run, [&](std::size_t face) { return mesh.face_end(face) - mesh.face_begin(face) != 3; });
  if (!any(other)) mesh.face_offsets.clear();
}

/// A value of each vertex, where all its corners have the same.
std::optional<Attribute> as_of_vertices(const Mesh& mesh, const Attribute& attribute) {
  Array<std::uint32_t> corner_of(mesh.vertex_count(), 0xFFFFFFFF);
  const auto count = static_cast<std::size_t>(attribute.components);
  const bool same = std::visit(
      [&](const auto& values) {
        for (std::size_t c = 0; c < mesh.corner_count(); ++c) {
          std::uint32_t& first = corner_of[mesh.corners[c]];
          if (first == 0xFFFFFFFF) first = static_cast<std::uint32_t>(c);
          const auto* const own = values.data() + count * c;
          if (!std::equal(own, own + count, values.data() + count * first)) return false;
        }
        return true;
      },
      attribute.values);
  if (!same) return std::nullopt;
  Attribute result = picked(attribute, corner_of);
  result.domain = Domain::Vertex;
  return result;
}

bool is_dropped(const std::string& name, SubdivisionScheme scheme) {
  return name == "TANGENT" || name.rfind("JOINTS_", 0) == 0 || name.rfind("WEIGHTS_", 0) == 0 ||
         (name == "NORMAL" && scheme != SubdivisionScheme::Midpoint);
}

void choose_attributes(Mesh& mesh, SubdivisionScheme scheme, const Run& run) {
  std::vector<Attribute> kept;
  for (Attribute& each : mesh.attributes) {
    if (is_dropped(each.name, scheme)) continue;
    if (scheme == SubdivisionScheme::Sqrt3 && each.domain == Domain::Corner) {
      std::optional<Attribute> of_vertices = as_of_vertices(mesh, each);
      if (!of_vertices) {
        warn(run, fmt::format("subdivide: sqrt3 turns edges: {}, which has seams, is left out", each.name));
        continue;
      }
      each = std::move(*of_vertices);
    }
    kept.push_back(std::move(each));
  }
  mesh.attributes = std::move(kept);
  for (MorphTarget& each : mesh.morph_targets) each.normals.clear();
}

}  // namespace

Mesh source_of(const Mesh& mesh, SubdivisionScheme scheme, const Run& run) {
  const bool wants_triangles = scheme == SubdivisionScheme::Loop || scheme == SubdivisionScheme::Sqrt3;
  Mesh source = wants_triangles && !mesh.all_triangles() ? tessellate(mesh, run) : mesh.clone();
  choose_attributes(source, scheme, run);
  drop_degenerate(source, run);
  if (scheme == SubdivisionScheme::Midpoint && !source.all_triangles()) {
    cut_uncovered(source, run);
    drop_degenerate(source, run);
  }
  if (!source.all_triangles()) forget_offsets_of_triangles(source, run);
  return source;
}

}  // namespace azulejo::subdivision
