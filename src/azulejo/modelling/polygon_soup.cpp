#include "azulejo/modelling/polygon_soup.h"

#include "azulejo/core/parallel.h"
#include "azulejo/modelling/picked_attribute.h"

namespace azulejo {

Mesh polygon_soup(const Mesh& mesh, const Run& run) {
  Mesh soup;
  soup.name = mesh.name;
  soup.space = mesh.space;
  soup.face_offsets = mesh.face_offsets;
  soup.material = mesh.material;
  soup.corners.resize(mesh.corner_count());
  soup.positions.resize(mesh.corner_count());
  parallel_for(mesh.corner_count(), 1U << 14, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      soup.corners[c] = static_cast<std::uint32_t>(c);
      soup.positions[c] = mesh.positions[mesh.corners[c]];
    }
  });
  for (const Attribute& each : mesh.attributes) {
    soup.attributes.push_back(each.domain == Domain::Vertex ? picked(each, mesh.corners) : each);
  }
  for (const MorphTarget& target : mesh.morph_targets) soup.morph_targets.push_back(picked(target, mesh.corners));
  return soup;
}

std::size_t polygon_soup_bytes(const Mesh& mesh) {
  return mesh.corner_count() * sizeof(glm::vec3) + mesh.face_offsets.size() * sizeof(std::uint32_t);
}

std::size_t vertex_list_bytes(const Mesh& mesh) {
  return mesh.vertex_count() * sizeof(glm::vec3) +
         (mesh.corner_count() + mesh.face_offsets.size()) * sizeof(std::uint32_t);
}

}  // namespace azulejo
