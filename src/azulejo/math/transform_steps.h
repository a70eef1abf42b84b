#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "azulejo/core/export.h"
#include "azulejo/math/number_grid.h"

namespace azulejo {

enum class StepKind : std::uint8_t { Nothing, Translate, Rotate, Scale, Shear, Reflect, Matrix };

/// One of the steps that make up a transformation, as options name it. What it takes, of pictures and of space:
struct TransformStep {
  StepKind kind = StepKind::Nothing;
  /// Translate: 2, of space 2 or 3. Rotate: degrees. Scale: one for all axes, or 2, of space 3. Shear: what is added to
  /// x for each unit of y, and to y of x; of space x by y, x by z, y by x, y by z, z by x, z by y. Reflect: the
  /// direction of the mirror line; of space the normal of the mirror plane.
  std::vector<float> numbers = {};
  NumberGrid matrix = {};               ///< of Matrix: 2×2, 2×3 or 3×3, of space 3×3, 3×4 or 4×4
  std::optional<glm::vec3> axis = {};   ///< of Rotate in space; none: z
  std::optional<glm::vec3> about = {};  ///< what stays where it is; none: the origin
  bool about_center = false;            ///< the source's center, where the steps before have moved it, instead
};

/// Which vectors the matrices that are given multiply.
enum class MatrixConvention : std::uint8_t {
  Column,  ///< M · p: displacements are in the last column
  Row,     ///< p · M: displacements are in the last row
};
constexpr auto enum_names(MatrixConvention) { return std::array<std::string_view, 2>{"column", "row"}; }

struct TransformOptions {
  std::vector<TransformStep> steps = {};  ///< the first is done first; none: nothing moves
  bool inverse = false;                   ///< what undoes all of them
  MatrixConvention convention = MatrixConvention::Column;
};

/// The steps as one matrix for pictures: y points down, and positive angles turn counter-clockwise as seen.
/// Throws Error(Argument) for a step with too few or many numbers, a direction of length 0, the inverse of what has
/// none, and numbers that are not finite.
AZULEJO_EXPORT glm::dmat3 picture_transform(const TransformOptions& options, const glm::dvec2& center);
/// The same for space: right-handed, positive angles turn counter-clockwise for those who look against the axis.
AZULEJO_EXPORT glm::dmat4 space_transform(const TransformOptions& options, const glm::dvec3& center);

}  // namespace azulejo
