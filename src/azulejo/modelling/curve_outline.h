#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "azulejo/data/drawing.h"
#include "azulejo/modelling/curve.h"

namespace azulejo {

/// The points of the options. Throws Error(Argument) where a coordinate is left over.
std::vector<glm::dvec2> control_points(const CurveOptions& options);

/// Whether the kind is made of `points`.
bool has_points(CurveKind kind);

/// The path of curve(), with options in range. Throws Error(Argument).
Path curve_outline(const CurveOptions& options);

}  // namespace azulejo
