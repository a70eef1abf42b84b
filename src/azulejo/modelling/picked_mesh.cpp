#include "azulejo/modelling/picked_mesh.h"

#include <utility>

#include "azulejo/data/scene.h"
#include "azulejo/modelling/picked_attribute.h"

namespace azulejo {
namespace {

template <class T>
Array<T> picked(const Array<T>& values, const Array<std::uint32_t>& elements, const T& otherwise) {
  Array<T> chosen(values.empty() ? 0 : elements.size());
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    chosen[i] = elements[i] == 0xFFFFFFFF ? otherwise : values[elements[i]];
  }
  return chosen;
}

}  // namespace

Mesh picked(const Mesh& mesh, MeshPick pick) {
  Mesh result;
  result.name = mesh.name;
  result.space = mesh.space;
  result.positions = picked(mesh.positions, pick.vertices, glm::vec3(0));
  result.material = picked(mesh.material, pick.faces, MaterialId::kNone);
  for (const Attribute& each : mesh.attributes) {
    result.attributes.push_back(picked(each, each.domain == Domain::Vertex   ? pick.vertices
                                             : each.domain == Domain::Corner ? pick.corner_of
                                                                             : pick.faces));
  }
  for (const MorphTarget& each : mesh.morph_targets) {
    result.morph_targets.push_back({each.name, picked(each.positions, pick.vertices, glm::vec3(0)),
                                    picked(each.normals, pick.vertices, glm::vec3(0))});
  }
  result.corners = std::move(pick.corners);
  result.face_offsets = std::move(pick.face_offsets);
  result.lines = std::move(pick.lines);
  return result;
}

}  // namespace azulejo
