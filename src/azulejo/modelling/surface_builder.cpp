#include "azulejo/modelling/surface_builder.h"

#include <glm/geometric.hpp>

#include "azulejo/modelling/corners_of_vertices.h"
#include "azulejo/modelling/normals.h"

namespace azulejo {
namespace {

template <class Vector>
Attribute attribute_of(const char* name, Domain domain, const std::vector<Vector>& vectors) {
  constexpr int kComponents = Vector::length();
  Array<float> values;
  values.reserve(vectors.size() * kComponents);
  for (const Vector& each : vectors) {
    for (int k = 0; k < kComponents; ++k) values.push_back(each[k]);
  }
  return {name, domain, kComponents, std::move(values)};
}

}  // namespace

void SurfaceBuilder::add_corner(std::uint32_t vertex, const glm::dvec3& normal, const glm::dvec2& uv) {
  mesh_.corners.push_back(vertex);
  normals_.emplace_back(normal);
  uvs_.emplace_back(uv);
}

void SurfaceBuilder::drop_corner(std::size_t corner) {
  const auto at = static_cast<std::ptrdiff_t>(corner);
  mesh_.corners.erase(mesh_.corners.begin() + at);
  normals_.erase(normals_.begin() + at);
  uvs_.erase(uvs_.begin() + at);
}

void SurfaceBuilder::end_face() {
  const std::size_t begin = face_offsets_.back();
  for (std::size_t i = begin; i < mesh_.corners.size();) {
    const std::size_t before = i > begin ? i - 1 : mesh_.corners.size() - 1;
    if (before != i && mesh_.corners[before] == mesh_.corners[i]) {
      drop_corner(i);
    } else {
      ++i;
    }
  }
  while (mesh_.corners.size() - begin < 3 && mesh_.corners.size() > begin) drop_corner(mesh_.corners.size() - 1);
  const std::size_t size = mesh_.corners.size() - begin;
  if (size == 0) return;
  all_triangles_ = all_triangles_ && size == 3;
  face_offsets_.push_back(static_cast<std::uint32_t>(mesh_.corners.size()));
}

void SurfaceBuilder::use_face_normals() {
  const Array<glm::vec3> faces = face_normals(mesh_);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (std::size_t c = mesh_.face_begin(f); c < mesh_.face_end(f); ++c) normals_[c] = faces[f];
  }
}

/// Makes equal what differs at a vertex by rounding only. Whether each vertex has one normal then.
bool SurfaceBuilder::unite_normals() {
  constexpr float kNear = 1e-4F;
  const VertexCorners around = corners_of_vertices(mesh_, {.threads = 1});
  bool one_each = true;
  std::vector<glm::vec3> known;
  for (std::size_t v = 0; v < mesh_.vertex_count(); ++v) {
    known.clear();
    for (std::uint32_t i = around.first[v]; i < around.first[v + 1]; ++i) {
      glm::vec3& normal = normals_[around.corners[i]];
      std::size_t k = 0;
      while (k < known.size() && glm::distance(known[k], normal) > kNear) ++k;
      if (k == known.size()) known.push_back(normal);
      normal = known[k];
    }
    one_each = one_each && known.size() <= 1;
  }
  return one_each;
}

Mesh SurfaceBuilder::finish(bool smooth) {
  if (!all_triangles_) mesh_.face_offsets.assign(face_offsets_.begin(), face_offsets_.end());
  if (!smooth) use_face_normals();
  if (unite_normals()) {
    std::vector<glm::vec3> of_vertices(mesh_.vertex_count(), glm::vec3(0));
    for (std::size_t c = 0; c < normals_.size(); ++c) of_vertices[mesh_.corners[c]] = normals_[c];
    mesh_.attributes.push_back(attribute_of("NORMAL", Domain::Vertex, of_vertices));
  } else {
    mesh_.attributes.push_back(attribute_of("NORMAL", Domain::Corner, normals_));
  }
  mesh_.attributes.push_back(attribute_of("TEXCOORD_0", Domain::Corner, uvs_));
  return std::move(mesh_);
}

}  // namespace azulejo
