#pragma once

#include <glm/mat4x4.hpp>
#include <optional>
#include <string>

#include "azulejo/data/scene.h"

namespace azulejo {

/// A camera of a scene, where a node places it.
struct FileCamera {
  const Camera* camera = nullptr;
  glm::mat4 world_from_node{1.0F};
  std::string name;  ///< its own, else its node's, else its number
};

/// The first of the file that stands somewhere; where several nodes place it, at the first of them.
std::optional<FileCamera> first_camera(const Scene& scene);
/// By the name of a camera, else of its node, else by its number from 0. Throws Error(Argument) with a suggestion.
FileCamera find_camera(const Scene& scene, const std::string& wanted);

}  // namespace azulejo
