#pragma once

#include <cstdint>

#include "azulejo/data/array.h"
#include "azulejo/engine/operation.h"
#include "azulejo/modelling/classify_points.h"

namespace azulejo {

/// The variant of `classify_points` for surfaces.
extern const Operation kClassifyInMesh;

/// The points with an attribute `class`, and how many there are of each.
ClassifiedPoints with_classes(const Mesh& points, Array<std::uint32_t> classes);

}  // namespace azulejo
