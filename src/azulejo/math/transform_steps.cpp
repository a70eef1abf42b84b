#include "azulejo/math/transform_steps.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "azulejo/core/error.h"
#include "azulejo/math/transform2d.h"
#include "azulejo/math/transform3d.h"

namespace azulejo {
namespace {

/// Throws unless the step has as many numbers as one of `counts`.
void check_numbers(const TransformStep& step, const char* name, std::initializer_list<std::size_t> counts) {
  if (std::ranges::find(counts, step.numbers.size()) != counts.end()) return;
  throw Error(Error::Argument,
              fmt::format("{}: {} numbers, expected {}", name, step.numbers.size(), fmt::join(counts, " or ")));
}

double number(const TransformStep& step, std::size_t index) {
  return index < step.numbers.size() ? static_cast<double>(step.numbers[index]) : 0.0;
}

/// Of a scaling: one factor stands for all.
double factor(const TransformStep& step, std::size_t index) {
  return number(step, step.numbers.size() == 1 ? 0 : index);
}

/// The matrix in a grid of size − 1 or size rows, with or without displacements.
template <glm::length_t N>
glm::mat<N, N, double> matrix_of(const NumberGrid& grid, MatrixConvention convention) {
  const bool by_rows = convention == MatrixConvention::Row;
  const int rows = by_rows ? grid.columns : grid.rows;
  const int columns = by_rows ? grid.rows : grid.columns;
  const bool fits = (rows == N - 1 && (columns == N - 1 || columns == N)) || (rows == N && columns == N);
  if (!fits) {
    throw Error(Error::Argument,
                fmt::format("matrix: {} rows of {} numbers, expected {}×{}, {}×{} or {}×{}", grid.rows, grid.columns,
                            N - 1, N - 1, by_rows ? N : N - 1, by_rows ? N - 1 : N, N, N));
  }
  glm::mat<N, N, double> m(1);
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const int at = by_rows ? c * grid.columns + r : r * grid.columns + c;
      m[c][r] = static_cast<double>(grid.values[static_cast<std::size_t>(at)]);
    }
  }
  return m;
}

glm::dmat3 picture_step(const TransformStep& step, MatrixConvention convention) {
  switch (step.kind) {
    case StepKind::Nothing: break;
    case StepKind::Translate: check_numbers(step, "translate", {2}); break;
    case StepKind::Rotate: check_numbers(step, "rotate_deg", {1}); break;
    case StepKind::Scale: check_numbers(step, "scale", {1, 2}); break;
    case StepKind::Shear: check_numbers(step, "shear", {2}); break;
    case StepKind::Reflect: check_numbers(step, "reflect", {2}); break;
    case StepKind::Matrix: return matrix_of<3>(step.matrix, convention);
  }
  const glm::dvec2 two{number(step, 0), number(step, 1)};
  switch (step.kind) {
    case StepKind::Translate: return Translation2d{two}.matrix();
    case StepKind::Rotate: return Rotation2d(turn_of_degrees(-two.x)).matrix();
    case StepKind::Scale: return Scaling2d{{factor(step, 0), factor(step, 1)}, {}}.matrix();
    case StepKind::Shear: return Shear2d{two, {}}.matrix();
    case StepKind::Reflect: return Reflection2d{{}, two}.matrix();
    default: return glm::dmat3(1);
  }
}

glm::dmat4 space_step(const TransformStep& step, MatrixConvention convention) {
  switch (step.kind) {
    case StepKind::Nothing: break;
    case StepKind::Translate: check_numbers(step, "translate", {2, 3}); break;
    case StepKind::Rotate: check_numbers(step, "rotate_deg", {1}); break;
    case StepKind::Scale: check_numbers(step, "scale", {1, 3}); break;
    case StepKind::Shear: check_numbers(step, "shear", {6}); break;
    case StepKind::Reflect: check_numbers(step, "reflect", {3}); break;
    case StepKind::Matrix: return matrix_of<4>(step.matrix, convention);
  }
  const glm::dvec3 three{number(step, 0), number(step, 1), number(step, 2)};
  switch (step.kind) {
    case StepKind::Translate: return Translation3d{three}.matrix();
    case StepKind::Rotate:
      return Rotation3d(turn_of_degrees(three.x), glm::dvec3(step.axis.value_or(glm::vec3(0, 0, 1)))).matrix();
    case StepKind::Scale: return Scaling3d{{factor(step, 0), factor(step, 1), factor(step, 2)}, {}}.matrix();
    case StepKind::Shear:
      return Shear3d{.x = {three.x, three.y}, .y = {three.z, number(step, 3)}, .z = {number(step, 4), number(step, 5)}}
          .matrix();
    case StepKind::Reflect: return Reflection3d{{}, three}.matrix();
    default: return glm::dmat4(1);
  }
}

/// All steps as one: `of_step` gives each around the origin, `moved` where a point has come to.
template <class Matrix, class Point, class OfStep, class Moved>
Matrix concatenated(const TransformOptions& options, const Point& center, OfStep of_step, Moved moved) {
  Matrix m(1);
  for (const TransformStep& step : options.steps) {
    Matrix next = of_step(step);
    if (step.about_center) {
      next = about(moved(m, center), next);
    } else if (step.about) {
      next = about(Point(*step.about), next);
    }
    m = next * m;
  }
  for (glm::length_t column = 0; column < Matrix::length(); ++column) {
    for (glm::length_t row = 0; row < Matrix::length(); ++row) {
      if (!std::isfinite(m[column][row]))
        throw Error(Error::Argument, "the transformation's numbers overflow, expected finite ones");
    }
  }
  if (!options.inverse) return m;
  const std::optional<Matrix> inverted = inverse(m);
  if (!inverted) throw Error(Error::Argument, "inverse: the transformation is singular, expected one with an inverse");
  return *inverted;
}

}  // namespace

glm::dmat3 picture_transform(const TransformOptions& options, const glm::dvec2& center) {
  return concatenated<glm::dmat3>(
      options, center, [&](const TransformStep& step) { return picture_step(step, options.convention); },
      [](const glm::dmat3& m, const glm::dvec2& p) {
        const glm::dvec3 moved = m * glm::dvec3(p, 1);
        return glm::dvec2(moved) / moved.z;
      });
}

glm::dmat4 space_transform(const TransformOptions& options, const glm::dvec3& center) {
  return concatenated<glm::dmat4>(
      options, center, [&](const TransformStep& step) { return space_step(step, options.convention); },
      [](const glm::dmat4& m, const glm::dvec3& p) {
        const glm::dvec4 moved = m * glm::dvec4(p, 1);
        return glm::dvec3(moved) / moved.w;
      });
}

}  // namespace azulejo
