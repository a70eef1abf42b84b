#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <vector>

#include "azulejo/data/mesh.h"
#include "azulejo/data/scene.h"

namespace azulejo {

/// World from node, of all nodes, those that no root leads to as well: as if what has no parent stood at the origin.
std::vector<glm::mat4> world_of_all_nodes(const Scene& scene);

/// World from mesh, as each joint would have it.
std::vector<glm::mat4> joint_matrices(const Skin& skin, const std::vector<glm::mat4>& world_from_node);

/// How the vertices of a mesh hang on its joints: JOINTS_n and WEIGHTS_n, any number of them.
class SkinWeights {
 public:
  /// Keeps what it needs of the mesh. Throws Error(Data) where a joint is not one of `joints`, or an attribute is of
  /// another type.
  SkinWeights(const Mesh& mesh, std::size_t joints);

  /// The weighted mean of the joints' matrices; identity without weights.
  glm::mat4 blend(std::size_t vertex, const std::vector<glm::mat4>& joints) const;

 private:
  struct Set {
    Array<std::uint32_t> joints;
    Array<float> weights;
  };
  std::vector<Set> sets_;
};

void remove_skin_weights(Mesh& mesh);

}  // namespace azulejo
