#pragma once

#include <glm/vec3.hpp>

#include "azulejo/core/run.h"
#include "azulejo/data/array.h"
#include "azulejo/data/mesh.h"
#include "azulejo/modelling/normals.h"

namespace azulejo {

/// What faces give to the normals of their vertices.
struct FaceWeights {
  Array<glm::vec3> normals;  ///< of the faces: unit, or 0
  Array<float> corners;      ///< the weight of each corner; any where the face has no normal
};

FaceWeights face_weights(const Mesh& mesh, NormalWeight weight, const Run& run);

}  // namespace azulejo
